#pragma once

#include "common/recorded_vsm.hpp"
#include "common/recording.hpp"
#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/transport/replay.hpp"
#include "vsm/live_vsm.hpp"

#include <string>

namespace ponte::app {

/// A recording in place of vehicles. It is replayed at its pace and translated in its own time, so that the DLI
/// messages are those of `ponte translate`.
class RecordingSide final : public transport::LinkHandler {
 public:
  /// Throws `Failure`. The owner outlives it.
  RecordingSide(LiveVsm& owner, vsm::VehicleLinkId id, const transport::FileEndpoint& endpoint);

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes frame, transport::PeerId peer) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;

  [[nodiscard]] bool is_finished() const { return is_finished_; }
  [[nodiscard]] vsm::VehicleLinkId id() const { return id_; }
  [[nodiscard]] vsm::view::VehicleLink status() const;
  /// Those that have been heard of so far.
  [[nodiscard]] const std::vector<autopilot::FleetSession::Vehicle>& vehicles() const { return fleet_.vehicles(); }
  void log_counters() const;

 private:
  void tell_facts();

  LiveVsm& owner_;
  vsm::VehicleLinkId id_;
  std::string name_;
  Recording recording_;
  RecordedVsm vsm_;
  autopilot::FleetSession fleet_{{.ask_for_streams = false}};
  Outbox<autopilot::FleetFact> facts_{16};
  std::uint64_t frames_{};
  bool is_finished_{};
  transport::Replay replay_;
};

}  // namespace ponte::app
