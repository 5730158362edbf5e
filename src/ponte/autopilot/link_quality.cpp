#include "ponte/autopilot/link_quality.hpp"

#include "ponte/mavlink/autopilots/radio_status.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

std::int64_t second_of(Timestamp time) {
  return std::chrono::floor<std::chrono::seconds>(time.time_since_epoch()).count();
}

/// 255 means that the radio does not know.
std::optional<std::uint8_t> if_known(std::uint8_t value) {
  constexpr std::uint8_t unknown = 255;
  if (value == unknown) return std::nullopt;
  return value;
}

}  // namespace

std::optional<int> RadioReading::margin() const {
  if (!signal || !noise || !remote_signal || !remote_noise) return std::nullopt;
  return std::min(*signal - *noise, *remote_signal - *remote_noise);
}

void LinkQuality::on_message(Timestamp now, const mavlink::FrameView& frame) {
  // Radios have ids of their own, and put this between the frames of the link.
  if (mavlink::carries<messages::RadioStatus>(frame)) {
    const auto status = mavlink::decode<messages::RadioStatus>(frame);
    radio_ = RadioReading{.signal = if_known(status.rssi),
                          .remote_signal = if_known(status.remrssi),
                          .noise = if_known(status.noise),
                          .remote_noise = if_known(status.remnoise),
                          .free_buffer = status.txbuf,
                          .receive_errors = status.rxerrors,
                          .corrected_packets = status.fixed,
                          .heard = now};
  }
  if (frame.system == peer_.system && frame.component == peer_.component) count(now, frame.sequence);
}

void LinkQuality::count(Timestamp now, std::uint8_t sequence) {
  auto& bucket = bucket_at(now);
  if (!sequence_) {
    sequence_ = sequence;
    recent_ = 1;
    ++bucket.received;
    return;
  }
  const unsigned behind = static_cast<std::uint8_t>(*sequence_ - sequence);
  if (behind < late_limit) {
    if ((recent_ >> behind & 1U) != 0) return;  // repeated
    recent_ |= 1U << behind;
    --bucket.missed;  // it was only late
    ++bucket.received;
    return;
  }
  const unsigned step = static_cast<std::uint8_t>(sequence - *sequence_);
  recent_ = (step < late_limit ? recent_ << step : 0) | 1U;
  sequence_ = sequence;
  bucket.missed += static_cast<std::int32_t>(step) - 1;
  ++bucket.received;
}

LinkQuality::Bucket& LinkQuality::bucket_at(Timestamp now) {
  const auto second = second_of(now);
  auto& bucket = buckets_[static_cast<std::size_t>(second) % bucket_count];
  if (bucket.second != second) bucket = {.second = second};
  return bucket;
}

LinkQuality::Bucket LinkQuality::sum(Timestamp now) const {
  const auto second = second_of(now);
  Bucket sum;
  for (const auto& each : buckets_) {
    if (each.second < 0 || each.second <= second - std::int64_t{bucket_count} || each.second > second) continue;
    sum.received += each.received;
    sum.missed += each.missed;
  }
  return sum;
}

std::optional<Percent> LinkQuality::loss(Timestamp now) const {
  const auto all = sum(now);
  if (all.received <= 0) return std::nullopt;
  const auto missed = std::max(all.missed, 0);  // what came late was missed before the window
  return Percent{100.0 * missed / (all.received + missed)};
}

double LinkQuality::frames_per_second(Timestamp now) const {
  return sum(now).received / std::chrono::duration<double>{window}.count();
}

std::optional<RadioReading> LinkQuality::radio(Timestamp now) const {
  if (!radio_ || now - radio_->heard > window) return std::nullopt;
  return radio_;
}

}  // namespace ponte::autopilot
