#include "support/world/bridge_node.hpp"

namespace ponte::world {

void BridgeNode::on_piece(Timestamp now, Port port, Bytes piece, Sender& out) {
  if (known_.insert(port).second) bridge_.on_link_up(now, link(port));
  bridge_.on_bytes(now, wall(now), link(port), piece);
  speak(out);
}

void BridgeNode::on_tick(Timestamp now, Sender& out) {
  bridge_.on_tick(now, wall(now));
  speak(out);
}

void BridgeNode::speak(Sender& out) {
  bridge_.frames.drain([&](const autopilot::OutgoingFrame& frame) { out.send(frame.link.value, frame.bytes()); });
  bridge_.messages.drain([&](const vsm::OutgoingMessage&) { ++messages_; });
  bridge_.facts.drain([&](const autopilot::FleetFact& fact) { facts_.push_back(fact); });
}

}  // namespace ponte::world
