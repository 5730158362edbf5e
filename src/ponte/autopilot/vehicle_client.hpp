#pragma once

#include "ponte/autopilot/command_client.hpp"
#include "ponte/autopilot/file_client.hpp"
#include "ponte/autopilot/guided_flight.hpp"
#include "ponte/autopilot/mission_client.hpp"
#include "ponte/autopilot/mode_client.hpp"
#include "ponte/autopilot/parameter_client.hpp"
#include "ponte/autopilot/setpoint_stream.hpp"

#include <optional>
#include <variant>

namespace ponte::autopilot {

/// What the services of one vehicle have to tell.
using VehicleFact = std::variant<CommandFact, ModeFact, GuidedFact, StreamFact, MissionFact, ParameterFact, FileFact>;

/// All services of one vehicle, so that they need not be called one by one. Requests are made of each service itself;
/// what becomes of them is told here. Give it every frame that comes from the vehicle, and the time.
class VehicleClient {
 public:
  explicit VehicleClient(const Peer& peer);
  VehicleClient(const VehicleClient&) = delete;  // the services know one another
  VehicleClient& operator=(const VehicleClient&) = delete;

  /// Any frame with the right checksum; those of others are passed over. `voice` is of the link to the vehicle.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<VehicleFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts);
  /// When `on_tick` next has something to do.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;
  /// The vehicle has started anew: what it was asked is over, and what was known of it is known no more.
  void on_reboot(Timestamp now, Outbox<VehicleFact>& facts);

  [[nodiscard]] const Peer& peer() const { return commands_.peer(); }
  [[nodiscard]] CommandClient& commands() { return commands_; }
  [[nodiscard]] ModeClient& modes() { return modes_; }
  [[nodiscard]] GuidedFlight& guided() { return guided_; }
  [[nodiscard]] SetpointStream& stream() { return stream_; }
  [[nodiscard]] MissionClient& missions() { return missions_; }
  [[nodiscard]] ParameterClient& parameters() { return parameters_; }
  [[nodiscard]] FileClient& files() { return files_; }

 private:
  void pass_on(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts);

  CommandClient commands_;
  ModeClient modes_;
  GuidedFlight guided_;
  SetpointStream stream_;
  MissionClient missions_;
  ParameterClient parameters_;
  FileClient files_;
  // Of one call; empty from one to the next.
  Outbox<CommandFact> command_facts_;
  Outbox<ModeFact> mode_facts_;
  Outbox<GuidedFact> guided_facts_;
  Outbox<StreamFact> stream_facts_;
  Outbox<MissionFact> mission_facts_;
  Outbox<ParameterFact> parameter_facts_;
  Outbox<FileFact> file_facts_;
};

}  // namespace ponte::autopilot
