#include "sim/fleet.hpp"

namespace ponte::app {

void Fleet::attach(const std::shared_ptr<transport::Link>& link) {
  for (const auto& each : vehicles_) each->attach(link);
}

void Fleet::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) {
  for (const auto& each : vehicles_) each->on_bytes(now, bytes, peer);
}

void Fleet::on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) {
  for (const auto& each : vehicles_) each->on_datagram(now, bytes, peer);
}

void Fleet::on_state(Timestamp now, transport::LinkState state, std::string_view reason) {
  for (const auto& each : vehicles_) each->on_state(now, state, reason);
}

void Fleet::on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) {
  for (const auto& each : vehicles_) each->on_peer(now, peer, change, name);
}

}  // namespace ponte::app
