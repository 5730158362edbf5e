#include "support/world/transfer_node.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"

#include <algorithm>
#include <utility>

namespace ponte::world {

namespace messages = mavlink::autopilots;

TransferNode::TransferNode(const autopilot::Peer& peer, mavlink::SystemId us, mavlink::Version version)
    : parser_{autopilot::dialect}, sender_{version, us, mavlink::ComponentId{190}}, missions_{peer} {}

void TransferNode::reboot() {
  ask([this](Timestamp now, autopilot::Voice& voice) { missions_.on_reboot(now, voice); });
}

void TransferNode::on_piece(Timestamp now, Port /*port*/, Bytes piece, Sender& out) {
  now_ = now;
  parser_.on_bytes(now, piece, *this);
  speak(out);
}

void TransferNode::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  if (message != nullptr) missions_.on_message(now_, frame, voice_, facts_);
}

void TransferNode::on_tick(Timestamp now, Sender& out) {
  now_ = now;
  parser_.on_tick(now, *this);
  for (const auto& work : std::exchange(work_, {})) work(now, voice_);
  missions_.on_tick(now, voice_, facts_);
  if (now >= next_heartbeat_) {
    voice_.send(messages::Heartbeat{.type = messages::MAV_TYPE_GCS, .autopilot = messages::MAV_AUTOPILOT_INVALID});
    next_heartbeat_ = now + std::chrono::seconds{1};
  }
  speak(out);
}

std::optional<Timestamp> TransferNode::next_deadline() const {
  if (!work_.empty()) return now_;
  return std::min(next_heartbeat_, missions_.next_deadline().value_or(Timestamp::max()));
}

void TransferNode::speak(Sender& out) {
  PONTE_ASSERT(outbox_.overwritten() == 0 && facts_.overwritten() == 0);
  outbox_.drain([&](const autopilot::OutgoingFrame& frame) { out.send(0, frame.bytes()); });
  facts_.drain([&](const autopilot::MissionFact& fact) {
    if (fact.kind != autopilot::MissionFact::Kind::progress) mission_facts_.push_back(fact);
  });
}

}  // namespace ponte::world
