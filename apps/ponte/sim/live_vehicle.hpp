#pragma once

#include "ponte/mavlink/link_guard.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/mavlink/signer.hpp"
#include "ponte/sim/vehicle.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"

#include <map>
#include <memory>
#include <optional>

namespace ponte::app {

/// What a vehicle signs and demands of its link.
struct VehicleSecurity {
  mavlink::LinkPolicy policy{};
  mavlink::Signer* signer{};  ///< outlives the vehicle; nothing: nothing is signed
  /// Nobody else can listen on the link, so the vehicle takes its key from there, by SETUP_SIGNING.
  bool is_local{};
};

/// A simulated vehicle on a link, in real time (or `speedup` times as fast).
class LiveVehicle final : public transport::LinkHandler {
 public:
  LiveVehicle(transport::Loop& loop, const sim::VehicleConfig& config, double speedup,
              const VehicleSecurity& security = {});

  /// The link that was opened with this object, or the fleet that it is in, as its handler.
  void attach(std::shared_ptr<transport::Link> link) { link_ = std::move(link); }
  [[nodiscard]] const sim::Vehicle& vehicle() const { return vehicle_; }

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;

  /// Arms the vehicle after so long, as a pilot would by command.
  void arm_after(Duration wait);
  /// Something goes wrong: at once, or at the time that the text names (see `sim::parse_fault`). The error is the
  /// text's.
  [[nodiscard]] Result<sim::Fault, std::string> inject(std::string_view fault);
  [[nodiscard]] mavlink::SystemId system() const { return system_; }
  /// What came and was not taken.
  [[nodiscard]] const mavlink::Refusals& refused() const { return refused_; }

 private:
  class Receiver;
  struct Peer {
    explicit Peer(const mavlink::LinkPolicy& policy);

    mavlink::Parser parser;
    mavlink::LinkGuard guard;
  };

  Timestamp simulated(Timestamp now) const;
  void arm(Timestamp now);
  Peer& find(transport::PeerId peer);
  void set_up_signing(const mavlink::FrameView& frame);
  void catch_up(Timestamp simulated_now);
  void flush();
  void send();

  transport::Loop& loop_;
  mavlink::SystemId system_;
  mavlink::Version version_;
  sim::Vehicle vehicle_;
  double speedup_;
  Timestamp power_on_;
  std::shared_ptr<transport::Link> link_;  ///< of this vehicle, or of a fleet
  std::map<transport::PeerId, std::unique_ptr<Peer>> peers_;
  VehicleSecurity security_;
  std::optional<mavlink::Signer> set_up_;  ///< with the key of SETUP_SIGNING
  mavlink::Refusals refused_{};
  Outbox<mavlink::FrameBuffer> out_{4 * sim::Vehicle::frames_per_step};
  transport::Timer timer_;
  transport::Timer arm_timer_;
};

}  // namespace ponte::app
