#include "vsm/recording_side.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"

namespace ponte::app {

RecordingSide::RecordingSide(LiveVsm& owner, const transport::FileEndpoint& endpoint)
    : owner_{owner},
      name_{transport::to_text(transport::Endpoint{endpoint})},
      recording_{endpoint.path},
      vsm_{owner.config_.telemetry},
      replay_{owner.loop_, recording_.replay(), endpoint.speed, *this} {
  if (!recording_.first_damage().empty())
    owner_.log_->warn("{}: damaged at {}", endpoint.path, recording_.first_damage());
}

void RecordingSide::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) { on_datagram(now, bytes, peer); }

void RecordingSide::on_datagram(Timestamp now, Bytes bytes, transport::PeerId) {
  const auto frame = mavlink::parse_frame(bytes);
  PONTE_ASSERT(frame.has_value());
  ++frames_;
  const auto* message = mavlink::autopilots::dialect.find(frame->message);
  owner_.begin(name_, replay_.record_time(), now);
  owner_.on_decoded(*frame, message);
  if (message != nullptr && owner_.converts())
    vsm_.on_frame(replay_.record_time(), *frame, *message, owner_.bridge_.messages);
  owner_.on_translated(*frame, message);
}

void RecordingSide::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  owner_.log_->info("{}: {}", name_, reason);
  if (state != transport::LinkState::down) return;
  if (owner_.converts()) vsm_.finish(owner_.bridge_.messages);
  owner_.pump();
  is_finished_ = true;
  owner_.finish_if_all_have();
}

void RecordingSide::log_counters() const { owner_.log_->info("{}: {} frames", name_, frames_); }

}  // namespace ponte::app
