#pragma once

#include "ponte/autopilot/camera_client.hpp"
#include "ponte/autopilot/command_client.hpp"
#include "ponte/autopilot/file_client.hpp"
#include "ponte/autopilot/gimbal_client.hpp"
#include "ponte/autopilot/guided_flight.hpp"
#include "ponte/autopilot/health.hpp"
#include "ponte/autopilot/link_quality.hpp"
#include "ponte/autopilot/mission_client.hpp"
#include "ponte/autopilot/mode_client.hpp"
#include "ponte/autopilot/parameter_client.hpp"
#include "ponte/autopilot/setpoint_stream.hpp"
#include "ponte/autopilot/time_sync.hpp"

#include <cstdint>
#include <optional>
#include <variant>

namespace ponte::autopilot {

/// What the services of one vehicle have to tell.
using VehicleFact = std::variant<CommandFact, ModeFact, GuidedFact, StreamFact, GimbalFact, CameraFact, MissionFact,
                                 ParameterFact, FileFact>;

/// All services of one vehicle, so that they need not be called one by one. Requests are made of each service itself;
/// what becomes of them is told here. Give it every frame of its link, for radios speak there too, and the time.
class VehicleClient {
 public:
  explicit VehicleClient(const Peer& peer);
  VehicleClient(const VehicleClient&) = delete;  // the services know one another
  VehicleClient& operator=(const VehicleClient&) = delete;

  /// Any frame with the right checksum; those of others are passed over. `voice` is of the link to the vehicle.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<VehicleFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts);
  /// The session has asked for streams (`FleetSession::Vehicle::last_request`), by commands whose answers are not ours.
  void on_streams_asked(Timestamp now);
  /// When `on_tick` next has something to do.
  [[nodiscard]] Timestamp next_deadline() const;
  /// The vehicle has started anew: what it was asked is over, and what was known of it is known no more.
  void on_reboot(Timestamp now, Outbox<VehicleFact>& facts);

  [[nodiscard]] const Peer& peer() const { return commands_.peer(); }
  /// MAV_PROTOCOL_CAPABILITY, as AUTOPILOT_VERSION has it; nothing until it has come since the vehicle started.
  [[nodiscard]] std::optional<std::uint64_t> capabilities() const { return capabilities_; }
  /// Plans and parameters are to be had as files, which takes a fraction of the time: ArduPilot says so, and only its
  /// files are known.
  [[nodiscard]] bool offers_files() const;
  [[nodiscard]] CommandClient& commands() { return commands_; }
  [[nodiscard]] ModeClient& modes() { return modes_; }
  [[nodiscard]] GuidedFlight& guided() { return guided_; }
  [[nodiscard]] SetpointStream& stream() { return stream_; }
  [[nodiscard]] GimbalClient& gimbal() { return gimbal_; }
  [[nodiscard]] CameraClient& camera() { return camera_; }
  [[nodiscard]] const TimeSync& time_sync() const { return time_sync_; }
  [[nodiscard]] const Health& health() const { return health_; }
  [[nodiscard]] const LinkQuality& link_quality() const { return link_quality_; }
  [[nodiscard]] MissionClient& missions() { return missions_; }
  [[nodiscard]] ParameterClient& parameters() { return parameters_; }
  [[nodiscard]] FileClient& files() { return files_; }

 private:
  void pass_on(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts);
  void tell_the_rest(Outbox<VehicleFact>& facts);

  std::optional<std::uint64_t> capabilities_;
  CommandClient commands_;
  ModeClient modes_;
  GuidedFlight guided_;
  SetpointStream stream_;
  GimbalClient gimbal_;
  CameraClient camera_;
  TimeSync time_sync_;
  LinkQuality link_quality_;
  Health health_;
  MissionClient missions_;
  ParameterClient parameters_;
  FileClient files_;
  // Of one call; empty from one to the next.
  Outbox<CommandFact> command_facts_;
  Outbox<ModeFact> mode_facts_;
  Outbox<GuidedFact> guided_facts_;
  Outbox<StreamFact> stream_facts_;
  Outbox<GimbalFact> gimbal_facts_;
  Outbox<CameraFact> camera_facts_;
  Outbox<MissionFact> mission_facts_;
  Outbox<ParameterFact> parameter_facts_;
  Outbox<FileFact> file_facts_;
};

}  // namespace ponte::autopilot
