#include "support/world/vehicle_node.hpp"

#include "ponte/autopilot/dialect.hpp"

namespace ponte::world {

void VehicleNode::on_piece(Timestamp now, Port port, Bytes piece, Sender& out) {
  while (parsers_.size() <= port) parsers_.emplace_back(autopilot::dialect);
  now_ = now;
  parsers_[port].on_bytes(now, piece, *this);
  speak(out);
}

void VehicleNode::on_tick(Timestamp now, Sender& out) {
  now_ = now;
  for (auto& parser : parsers_) parser.on_tick(now, *this);
  vehicle_.on_tick(now, outbox_);
  speak(out);
}

void VehicleNode::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  if (message != nullptr) vehicle_.on_frame(now_, frame, *message, outbox_);
}

void VehicleNode::speak(Sender& out) {
  outbox_.drain([&](const mavlink::FrameBuffer& frame) { out.send_to_all(frame.bytes()); });
}

}  // namespace ponte::world
