#include "demo/two_sides.hpp"

#include "common/outgoing.hpp"
#include "ponte/dli/codec.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ponte::app {
namespace {

using dli::messages::InertialStates;
using mavlink::autopilots::Attitude;

/// The distance in units, the short way round. More than a unit when one is there and the other is not.
int difference(float radians, std::optional<std::int16_t> bam) {
  constexpr int turn = 65'536;
  constexpr int absent = turn;
  if (std::isfinite(radians) != bam.has_value()) return absent;
  if (!bam) return 0;
  const auto wanted =
      std::lround(std::remainder(double{radians}, 2 * std::numbers::pi) / std::numbers::pi * (turn / 2));
  const auto apart = static_cast<int>(std::abs(wanted - *bam)) % turn;
  return std::min(apart, turn - apart);
}

bool has_attitude(const vsm::OutgoingMessage& message, const dli::Profile& profile) {
  const auto view = view_of(message, profile);
  if (view.number != InertialStates::info.number) return false;
  const auto states = dli::decode<InertialStates>(view.data, profile);
  return states && (states->roll || states->pitch || states->heading);
}

}  // namespace

void TwoSides::on_crossing(const vsm::Crossing& crossing) {
  ++counts_.frames;
  if (!mavlink::carries<Attitude>(crossing.frame)) return;
  ++counts_.attitudes;
  const auto attitude = mavlink::decode<Attitude>(crossing.frame);
  AttitudePair pair{.frame = {crossing.frame.whole.begin(), crossing.frame.whole.end()},
                    .radians = {attitude.roll, attitude.pitch, attitude.yaw},
                    .decoded = crossing.decoded - crossing.received,
                    .translated = crossing.translated - crossing.received,
                    .sent = crossing.sent - crossing.received};
  const auto sent =
      std::ranges::find_if(crossing.messages, [&](const auto& message) { return has_attitude(message, profile_); });
  if (sent == crossing.messages.end()) {
    shown_ = std::move(pair);
    return;
  }
  pair.message.assign(sent->bytes().begin(), sent->bytes().end());
  if (waiting_.size() == waiting_limit) {
    waiting_.pop_front();
    ++counts_.not_heard;
  }
  waiting_.push_back(std::move(pair));
}

void TwoSides::on_datagram(Bytes datagram) {
  dli::DatagramCounters counters;
  dli::DatagramReader reader{datagram, profile_, counters};
  while (const auto message = reader.next()) {
    if (!*message) continue;
    ++counts_.messages;
    const auto same = std::ranges::find_if(
        waiting_, [&](const auto& pair) { return std::ranges::equal(pair.message, (*message)->whole); });
    if (same == waiting_.end()) continue;
    counts_.not_heard += static_cast<std::uint64_t>(same - waiting_.begin());
    compare(*same, **message);
    shown_ = std::move(*same);
    waiting_.erase(waiting_.begin(), same + 1);
  }
}

void TwoSides::compare(AttitudePair& pair, const dli::WrapperView& message) {
  const auto states = dli::decode<InertialStates>(message.data, profile_);
  if (!states) return;
  pair.bam = {states->roll, states->pitch, states->heading};
  int largest = 0;
  for (std::size_t i = 0; i < pair.bam.size(); ++i)
    largest = std::max(largest, difference(pair.radians[i], pair.bam[i]));
  ++counts_.compared;
  if (largest > 1) ++counts_.different;
  counts_.largest_difference = std::max(counts_.largest_difference, largest);
  counts_.delay_sum += pair.sent - pair.decoded;
  counts_.delay_max = std::max(counts_.delay_max, pair.sent - pair.decoded);
}

}  // namespace ponte::app
