#pragma once

#include "ponte/mavlink/parser.hpp"
#include "ponte/sim/vehicle.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"

#include <map>
#include <memory>

namespace ponte::app {

/// A simulated vehicle on a link, in real time (or `speedup` times as fast).
class LiveVehicle final : public transport::LinkHandler {
 public:
  LiveVehicle(transport::Loop& loop, const sim::VehicleConfig& config, double speedup);

  /// The link that was opened with this object as its handler.
  void attach(std::unique_ptr<transport::Link> link) { link_ = std::move(link); }
  [[nodiscard]] const sim::Vehicle& vehicle() const { return vehicle_; }

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;

  /// Arms the vehicle after so long, as a pilot would by command.
  void arm_after(Duration wait);

 private:
  class Receiver;

  Timestamp simulated(Timestamp now) const;
  void arm(Timestamp now, mavlink::SystemId target);
  mavlink::Parser& parser_of(transport::PeerId peer);
  void send();

  transport::Loop& loop_;
  sim::Vehicle vehicle_;
  double speedup_;
  Timestamp power_on_;
  std::unique_ptr<transport::Link> link_;
  std::map<transport::PeerId, std::unique_ptr<mavlink::Parser>> parsers_;
  Outbox<sim::Frame> out_{4 * sim::Vehicle::frames_per_step};
  transport::Timer timer_;
  transport::Timer arm_timer_;
};

}  // namespace ponte::app
