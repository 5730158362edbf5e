#include "ponte/sim/message_rates.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>

namespace ponte::sim {

void MessageRates::add(const Rate& rate) {
  PONTE_ASSERT(count_ < capacity);
  auto& entry = entries_[count_++];
  entry.stream = rate.stream;
  entry.stream_interval = rate.unasked;
  start(entry, rate.unasked, Duration{});
}

void MessageRates::request_stream(Stream stream, std::uint32_t per_second, Duration now) {
  constexpr Duration second = std::chrono::seconds{1};
  const auto interval = per_second == 0 ? Duration{} : std::max(shortest_interval, second / std::int64_t{per_second});
  for (auto& entry : std::span{entries_}.first(count_)) {
    if (entry.stream == Stream::none) continue;
    if (stream != Stream::all && stream != entry.stream) continue;
    entry.stream_interval = interval;
    start(entry, interval, now);
  }
}

void MessageRates::set_interval(std::size_t message, std::optional<Duration> interval, Duration now) {
  PONTE_ASSERT(message < count_);
  start(entries_[message], interval.value_or(Duration{}), now);
}

void MessageRates::reset_interval(std::size_t message, Duration now) {
  PONTE_ASSERT(message < count_);
  start(entries_[message], entries_[message].stream_interval, now);
}

/// The first one comes after one interval. Asking again for what is already so does not make it wait anew.
void MessageRates::start(Entry& entry, Duration interval, Duration now) {
  if (entry.interval == interval) return;
  entry.interval = interval;
  entry.due = now + interval;
}

bool MessageRates::take_due(std::size_t message, Duration now) {
  PONTE_ASSERT(message < count_);
  auto& entry = entries_[message];
  if (entry.interval == Duration{} || now < entry.due) return false;
  entry.due += entry.interval;
  if (entry.due <= now) entry.due = now + entry.interval;  // it was late: what was missed is not made up for
  return true;
}

}  // namespace ponte::sim
