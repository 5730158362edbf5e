#include "support/world/world.hpp"

#include "ponte/core/assert.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ponte::world {

/// What one participant says during one event.
class World::Mouth final : public Sender {
 public:
  Mouth(World& world, std::size_t participant) : world_{world}, participant_{participant} {}

  void send(Port port, Bytes piece) override {
    const auto& speaker = world_.inhabitants_[participant_];
    PONTE_ASSERT(port < speaker.directions.size());
    auto& direction = world_.directions_[speaker.directions[port]];
    const std::array<std::uint64_t, 2> stamp{static_cast<std::uint64_t>(world_.now_.time_since_epoch().count()),
                                             speaker.directions[port]};
    world_.mix(std::as_bytes(std::span{stamp}));
    world_.mix(piece);
    const auto fate = direction.channel.send(world_.now_, piece);
    if (world_.timeline_.is_wanted())
      world_.timeline_.sent(world_.now_, speaker.name, world_.inhabitants_[direction.to.participant].name, piece,
                            name_of(fate));
  }

  void send_to_all(Bytes piece) override {
    for (Port port = 0; port < world_.inhabitants_[participant_].directions.size(); ++port) send(port, piece);
  }

  void tell(std::string_view text) override {
    world_.timeline_.happened(world_.now_, world_.inhabitants_[participant_].name, text);
  }

 private:
  World& world_;
  std::size_t participant_;
};

void World::enter(std::string name, std::unique_ptr<Participant> participant) {
  inhabitants_.push_back({std::move(name), std::move(participant), {}});
}

std::size_t World::index_of(const Participant& participant) const {
  const auto found =
      std::ranges::find(inhabitants_, &participant, [](const auto& each) { return each.participant.get(); });
  PONTE_ASSERT(found != inhabitants_.end());
  return static_cast<std::size_t>(found - inhabitants_.begin());
}

std::size_t World::connect(const Participant& one, const Participant& other, const ChannelConfig& config) {
  const auto end_at = [&](const Participant& participant) {
    const auto index = index_of(participant);
    return End{index, inhabitants_[index].directions.size()};
  };
  const auto here = end_at(one);
  const auto there = end_at(other);
  add_direction(here, there, config);
  add_direction(there, here, config);
  return directions_.size() / 2 - 1;
}

void World::add_direction(End from, End to, const ChannelConfig& config) {
  inhabitants_[from.participant].directions.push_back(directions_.size());
  Random seeds{seed_ ^ (directions_.size() + 1) << 32U};
  directions_.push_back({Channel{config, seeds.next()}, from, to});
}

void World::cut(std::size_t link, Timestamp until) {
  for (const auto direction : {2 * link, 2 * link + 1}) directions_.at(direction).channel.cut_until(until);
  timeline_.happened(
      now_, "network",
      fmt::format("link {} is cut for {:.1f} s", link, std::chrono::duration<double>{until - now_}.count()));
}

void World::at(Timestamp time, std::function<void()> work) { agenda_.emplace(std::max(time, now_), std::move(work)); }

void World::require(std::string property, std::function<std::optional<std::string>()> wrong) {
  properties_.emplace_back(std::move(property), std::move(wrong));
}

std::optional<Timestamp> World::next_event() const {
  std::optional<Timestamp> next;
  const auto consider = [&](std::optional<Timestamp> time) {
    if (time && (!next || *time < *next)) next = time;
  };
  if (!agenda_.empty()) consider(agenda_.begin()->first);
  for (const auto& each : inhabitants_) consider(each.participant->next_deadline());
  for (const auto& each : directions_) consider(each.channel.next_arrival());
  return next;
}

/// All that is due at this time: first what was planned, then what arrives, then the participants by themselves.
void World::step(Timestamp time) {
  now_ = std::max(now_, time);
  while (!agenda_.empty() && agenda_.begin()->first <= now_) agenda_.extract(agenda_.begin()).mapped()();
  for (auto& each : directions_) {
    while (each.channel.next_arrival().value_or(Timestamp::max()) <= now_) {
      const auto piece = each.channel.take_arrival();
      Mouth mouth{*this, each.to.participant};
      inhabitants_[each.to.participant].participant->on_piece(now_, each.to.port, piece, mouth);
    }
  }
  for (std::size_t i = 0; i < inhabitants_.size(); ++i) {
    if (inhabitants_[i].participant->next_deadline().value_or(Timestamp::max()) > now_) continue;
    Mouth mouth{*this, i};
    inhabitants_[i].participant->on_tick(now_, mouth);
  }
  check();
}

void World::check() const {
  for (const auto& [property, wrong] : properties_)
    if (const auto reason = wrong())
      throw BrokenProperty{fmt::format(
          "at {:.6f} s: {}: {}", std::chrono::duration<double>{now_.time_since_epoch()}.count(), property, *reason)};
}

void World::run_until(Timestamp end) {
  for (auto next = next_event(); next && *next <= end; next = next_event()) step(*next);
  now_ = std::max(now_, end);
}

bool World::run_until(const std::function<bool()>& condition, Duration limit) {
  const auto end = now_ + limit;
  for (auto next = next_event(); !condition(); next = next_event()) {
    if (!next || *next > end) {
      now_ = std::max(now_, end);
      return false;
    }
    step(*next);
  }
  return true;
}

ChannelCounters World::counters(std::size_t link) const {
  auto sum = directions_.at(2 * link).channel.counters();
  const auto& back = directions_.at(2 * link + 1).channel.counters();
  sum.sent += back.sent;
  sum.delivered += back.delivered;
  sum.lost += back.lost;
  sum.cut_off += back.cut_off;
  sum.overflowed += back.overflowed;
  sum.duplicated += back.duplicated;
  sum.reordered += back.reordered;
  sum.changed += back.changed;
  return sum;
}

void World::mix(Bytes bytes) {
  for (const auto byte : bytes) digest_ = (digest_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001B3;
}

}  // namespace ponte::world
