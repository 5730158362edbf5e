#pragma once

#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/autopilot/vehicle_client.hpp"
#include "ponte/mavlink/parser.hpp"
#include "support/world/world.hpp"

#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace ponte::world {

/// A ground station with all services, for the one vehicle at the other end of its one link.
class StationNode final : public Participant, private mavlink::FrameSink {
 public:
  explicit StationNode(const autopilot::FleetConfig& config = {});

  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override;
  void on_tick(Timestamp now, Sender& out) override;
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override;

  /// The services of the vehicle; nothing until it is heard.
  [[nodiscard]] autopilot::VehicleClient* client() { return client_.get(); }
  /// For requests, which are sent with the next event.
  [[nodiscard]] autopilot::Voice voice() { return session_.voice(link, outbox_).value(); }

  struct TimedFact {
    Timestamp time{};
    autopilot::VehicleFact fact;
  };
  /// All that the services have told.
  [[nodiscard]] const std::vector<TimedFact>& facts() const { return facts_; }
  /// Those of one kind.
  template <class Fact>
  [[nodiscard]] std::vector<Fact> facts_of() const {
    std::vector<Fact> result;
    for (const auto& each : facts_)
      if (const auto* fact = std::get_if<Fact>(&each.fact)) result.push_back(*fact);
    return result;
  }
  /// How often the vehicle was seen to start anew.
  [[nodiscard]] int reboots() const { return reboots_; }

 private:
  static constexpr autopilot::LinkId link{0};

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void on_fleet_facts();
  void tell_of_streams();
  void speak(Sender& out);

  autopilot::FleetSession session_;
  std::unique_ptr<autopilot::VehicleClient> client_;
  mavlink::Parser parser_;
  Outbox<autopilot::OutgoingFrame> outbox_{256};
  Outbox<autopilot::FleetFact> fleet_facts_{16};
  Outbox<autopilot::VehicleFact> vehicle_facts_{256};
  std::vector<TimedFact> facts_;
  int reboots_{};
  Timestamp streams_asked_{};
  Timestamp now_{};
};

}  // namespace ponte::world
