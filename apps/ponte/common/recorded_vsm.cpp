#include "common/recorded_vsm.hpp"

namespace ponte::app {

void RecordedVsm::on_frame(std::optional<WallTime> time, const mavlink::FrameView& frame,
                           const mavlink::MessageInfo& message, Outbox<vsm::OutgoingMessage>& out) {
  // Calendar time of a recording may step back; the engine's time does not.
  if (time && wall_ && *time > *wall_) now_ += *time - *wall_;
  if (time) wall_ = time;
  telemetry_.on_frame(now_, wall_.value_or(WallTime{}), frame, message, out);
}

void RecordedVsm::finish(Outbox<vsm::OutgoingMessage>& out) {
  telemetry_.finish(now_, wall_.value_or(WallTime{}), out);
}

}  // namespace ponte::app
