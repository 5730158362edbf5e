#include "support/world/channel.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>

namespace ponte::world {

Channel::Fate Channel::send(Timestamp now, Bytes piece) {
  ++counters_.sent;
  if (now < cut_until_) {
    ++counters_.cut_off;
    return Fate::cut_off;
  }
  const auto left = leave(now, piece.size());
  if (!left) {
    ++counters_.overflowed;
    return Fate::overflowed;
  }
  if (is_lost()) {
    ++counters_.lost;
    return Fate::lost;
  }

  auto arrival = *left + config_.delay;
  if (config_.jitter > Duration{})
    arrival += Duration{static_cast<std::int64_t>(random_.unit() * static_cast<double>(config_.jitter.count()))};
  if (chance(config_.reordering)) {
    ++counters_.reordered;
    arrival += config_.held_back;
  } else {
    arrival = std::max(arrival, last_arrival_);
    last_arrival_ = arrival;
  }
  put(arrival, piece);
  if (chance(config_.duplication)) {
    ++counters_.duplicated;
    put(arrival, piece);
  }
  return Fate::on_its_way;
}

bool Channel::is_lost() {
  if (in_burst_)
    in_burst_ = !chance(config_.burst_ends);
  else
    in_burst_ = chance(config_.burst_begins);
  return in_burst_ || chance(config_.loss);
}

/// When its last byte has left; nothing if too much waits already.
std::optional<Timestamp> Channel::leave(Timestamp now, std::size_t size) {
  if (config_.bytes_per_second == 0) return now;
  const auto time_for = [&](std::size_t bytes) {
    return Duration{std::chrono::seconds{static_cast<std::int64_t>(bytes)}} / config_.bytes_per_second;
  };
  idle_from_ = std::max(idle_from_, now);
  if (idle_from_ - now + time_for(size) > time_for(config_.fifo_bytes)) return {};
  idle_from_ += time_for(size);
  return idle_from_;
}

void Channel::put(Timestamp arrival, Bytes piece) {
  std::vector<std::byte> copy(piece.begin(), piece.end());
  bool is_changed = false;
  for (auto& byte : copy) {
    if (!chance(config_.bit_flips)) continue;
    byte ^= static_cast<std::byte>(1U << random_.below(8));
    is_changed = true;
  }
  if (is_changed) ++counters_.changed;
  underway_.emplace(Place{arrival, number_++}, std::move(copy));
}

std::optional<Timestamp> Channel::next_arrival() const {
  return underway_.empty() ? std::nullopt : std::optional{underway_.begin()->first.first};
}

std::vector<std::byte> Channel::take_arrival() {
  PONTE_ASSERT(!underway_.empty());
  ++counters_.delivered;
  return std::move(underway_.extract(underway_.begin()).mapped());
}

std::string_view name_of(Channel::Fate fate) {
  switch (fate) {
    case Channel::Fate::on_its_way: return "on its way";
    case Channel::Fate::lost: return "lost";
    case Channel::Fate::cut_off: return "cut off";
    case Channel::Fate::overflowed: return "no room";
  }
  return {};
}

}  // namespace ponte::world
