#include "ponte/autopilot/time_sync.hpp"

#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

/// More is no time since a boot, and would make sums overflow: 146 years.
constexpr std::int64_t latest_ns = std::int64_t{1} << 62U;

}  // namespace

void TimeSync::on_tick(Timestamp now, Voice& voice) {
  if (now < next_question_) return;
  next_question_ = now + (size_ < readings_at_first ? interval_at_first : interval);
  const auto ours = now.time_since_epoch().count();
  std::ranges::rotate(questions_, questions_.begin() + 1);
  questions_.back() = ours;
  ++asked_;
  voice.send(
      messages::Timesync{.ts1 = ours, .target_system = peer_.system.value, .target_component = peer_.component.value});
}

/// An answer mirrors our time, to the nanosecond; so another station's is not taken for it. Each counts once.
void TimeSync::on_message(Timestamp now, const mavlink::FrameView& frame) {
  if (frame.system != peer_.system || frame.component != peer_.component) return;
  if (!mavlink::carries<messages::Timesync>(frame)) return;
  const auto answer = mavlink::decode<messages::Timesync>(frame);
  const auto question = std::ranges::find(questions_, answer.ts1);
  if (answer.tc1 <= 0 || answer.tc1 > latest_ns || answer.ts1 == 0 || question == questions_.end()) return;
  *question = 0;
  const Duration sent{answer.ts1};
  const auto round_trip = now.time_since_epoch() - sent;
  if (round_trip < Duration{} || round_trip > longest_round_trip) return;
  ++answered_;
  round_trip_ = round_trip_ ? *round_trip_ * 7 / 8 + round_trip / 8 : round_trip;
  keep({.offset = Duration{answer.tc1} - (sent + round_trip / 2), .round_trip = round_trip});
}

void TimeSync::keep(const ClockReading& reading) {
  if (const auto before = best()) {
    const auto difference = std::chrono::abs(reading.offset - before->offset);
    if (difference > (reading.round_trip + before->round_trip) / 2 + drift) size_ = next_reading_ = 0;
  }
  readings_[next_reading_] = reading;
  next_reading_ = (next_reading_ + 1) % window;
  size_ = std::min(size_ + 1, window);
}

std::optional<ClockReading> TimeSync::best() const {
  if (size_ == 0) return std::nullopt;
  return *std::ranges::min_element(readings_.begin(), readings_.begin() + static_cast<std::ptrdiff_t>(size_), {},
                                   &ClockReading::round_trip);
}

std::optional<Duration> TimeSync::round_trip() const { return round_trip_; }

std::optional<Duration> TimeSync::vehicle_time(Timestamp now) const {
  const auto reading = best();
  if (!reading) return std::nullopt;
  return now.time_since_epoch() + reading->offset;
}

void TimeSync::forget() {
  size_ = next_reading_ = 0;
  round_trip_.reset();
  questions_ = {};
}

}  // namespace ponte::autopilot
