#pragma once

#include "ponte/mavlink/link_guard.hpp"
#include "ponte/transport/link.hpp"
#include "sim/live_vehicle.hpp"

#include <memory>
#include <vector>

namespace ponte::app {

/// Vehicles that share one link: what comes is for all of them, as on a radio channel.
class Fleet final : public transport::LinkHandler {
 public:
  void add(std::unique_ptr<LiveVehicle> vehicle) { vehicles_.push_back(std::move(vehicle)); }
  /// The link that was opened with this object as its handler.
  void attach(const std::shared_ptr<transport::Link>& link);
  [[nodiscard]] const std::vector<std::unique_ptr<LiveVehicle>>& vehicles() const { return vehicles_; }

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;

 private:
  std::vector<std::unique_ptr<LiveVehicle>> vehicles_;
};

}  // namespace ponte::app
