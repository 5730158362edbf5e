#include "vsm/recording_side.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"

namespace ponte::app {
namespace {

/// A recording is one link, and has no time in which a vehicle could fall silent.
constexpr autopilot::LinkId only_link{1};
constexpr Timestamp no_time{};

}  // namespace

RecordingSide::RecordingSide(LiveVsm& owner, vsm::VehicleLinkId id, const transport::FileEndpoint& endpoint)
    : owner_{owner},
      id_{id},
      name_{transport::to_text(transport::Endpoint{endpoint})},
      recording_{endpoint.path, *owner.config_.dialect},
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
  const auto* message = find_message(*owner_.config_.dialect, *frame);
  owner_.begin(id_, name_, replay_.record_time(), now);
  owner_.on_decoded(*frame, message);
  const auto* ours = message != nullptr ? autopilot::ours(*frame, *message) : nullptr;
  if (ours != nullptr && owner_.converts())
    vsm_.on_frame(replay_.record_time(), *frame, *ours, owner_.bridge_.messages);
  owner_.on_translated(*frame, message);
  if (ours == nullptr) return;
  Outbox<autopilot::OutgoingFrame> unanswered{1};
  fleet_.on_frame(no_time, only_link, *frame, unanswered, facts_);
  tell_facts();
}

void RecordingSide::tell_facts() {
  facts_.drain([&](const autopilot::FleetFact& fact) { owner_.tell_fact(id_, name_, fact); });
}

vsm::view::VehicleLink RecordingSide::status() const {
  return {.id = id_, .endpoint = name_, .is_up = !is_finished_, .detail = is_finished_ ? "end of file" : ""};
}

void RecordingSide::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  owner_.log_->info("{}: {}", name_, reason);
  if (state != transport::LinkState::down) return;
  if (owner_.converts()) vsm_.finish(owner_.bridge_.messages);
  owner_.pump();
  is_finished_ = true;
  fleet_.on_link_down(only_link, facts_);
  tell_facts();
  owner_.tell(&VsmWatcher::on_link, status());
  owner_.finish_if_all_have();
}

void RecordingSide::log_counters() const { owner_.log_->info("{}: {} frames", name_, frames_); }

}  // namespace ponte::app
