#include "latency/latency_probe.hpp"

#include "common/outgoing.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/json.hpp"

#include <algorithm>
#include <utility>

namespace ponte::app {

LatencyProbe::LatencyProbe(transport::Loop& loop, const dli::Profile& profile, OnSample on_sample)
    : loop_{loop},
      profile_{profile},
      on_sample_{std::move(on_sample)},
      timer_{loop, [this](Timestamp) { present_all(); }} {}

void LatencyProbe::take(const vsm::Crossing& crossing) {
  if (!mavlink::carries<mavlink::autopilots::Attitude>(crossing.frame)) return;
  const auto inertial_states = std::ranges::find_if(crossing.messages, [&](const vsm::OutgoingMessage& message) {
    return view_of(message, profile_).number == dli::messages::InertialStates::info.number;
  });
  if (inertial_states == crossing.messages.end()) return;
  waiting_.push_back({.sample = {.time = crossing.time,
                                 .sequence = crossing.frame.sequence,
                                 .received = crossing.received,
                                 .decoded = crossing.decoded,
                                 .translated = crossing.translated,
                                 .sent = crossing.sent},
                      .frame = {crossing.frame.whole.begin(), crossing.frame.whole.end()},
                      .message = crossing.message,
                      .inertial_states = *inertial_states});
  timer_.set(loop_.now());
}

void LatencyProbe::present_all() {
  for (auto& waiting : std::exchange(waiting_, {})) {
    present(waiting);
    on_sample_(waiting.sample);
  }
}

void LatencyProbe::present(Waiting& waiting) {
  const auto frame = mavlink::parse_frame(waiting.frame);
  PONTE_ASSERT(frame.has_value());
  const auto time_of = [&](auto write) {
    json_.clear();
    const auto begin = loop_.now();
    write();
    return loop_.now() - begin;
  };
  const auto direct = [&] { mavlink::append_frame(json_, waiting.sample.time, *frame, waiting.message); };
  const auto converted = [&] { append_json(json_, waiting.inertial_states, profile_); };
  // Whichever came first would warm the caches for the other, so each has a run before the one that counts.
  (void)time_of(direct);
  (void)time_of(converted);
  waiting.sample.present_direct = time_of(direct);
  waiting.sample.present_converted = time_of(converted);
}

}  // namespace ponte::app
