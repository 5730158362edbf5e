#include "ponte/vsm/telemetry.hpp"

#include "ponte/dli/codec.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dlisession/status_messages.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/highres_imu.hpp"
#include "ponte/mavlink/autopilots/scaled_imu.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/v09/attitude.hpp"
#include "ponte/mavlink/v09/enums.hpp"
#include "ponte/mavlink/v09/global_position.hpp"
#include "ponte/mavlink/v09/global_position_int.hpp"
#include "ponte/mavlink/v09/heartbeat.hpp"
#include "ponte/mavlink/v09/scaled_imu.hpp"
#include "ponte/mavlink/v09/vfr_hud.hpp"
#include "ponte/vsm/changes.hpp"

#include <algorithm>
#include <tuple>

namespace ponte::vsm {
namespace {

namespace from = mavlink::autopilots;
namespace from_v09 = mavlink::v09;
namespace to = dli::messages;
using vehicle::Revision;
using vehicle::State;

constexpr std::size_t alerts_at_once = 16;
constexpr mavlink::ComponentId usual_autopilot{1};

/// Whether it is one of these messages.
template <mavlink::Message... M>
bool carries_any(const mavlink::FrameView& frame) {
  return (mavlink::carries<M>(frame) || ...);
}

/// The `target_system` of a message that has one.
std::optional<mavlink::SystemId> target_of(const mavlink::FrameView& frame, const mavlink::MessageInfo& message) {
  const auto field = std::ranges::find(message.fields, std::string_view{"target_system"}, &mavlink::FieldInfo::name);
  if (field == message.fields.end()) return std::nullopt;
  return mavlink::SystemId{field->offset < frame.payload.size() ? u8(frame.payload, field->offset) : std::uint8_t{0}};
}

}  // namespace

/// One vehicle, and what has been said of it.
struct Telemetry::Vehicle {
  Vehicle(mavlink::SystemId id, const TelemetryConfig& config) : system{id}, description{config.description} {
    description.vsm = config.vsm;
    description.vehicle = dli::EntityId{config.vsm.owning_code(), dli::EntityType::vehicle, id.value};
  }

  mavlink::SystemId system;
  mavlink::ComponentId autopilot{usual_autopilot};
  bool is_none{};  ///< its HEARTBEAT says that it is no autopilot: a ground station, a camera, ...
  dlisession::VehicleDescription description;
  autopilot::VehicleMonitor monitor;
  Outbox<vehicle::Alert> alerts{alerts_at_once};
  dlisession::AlertIds alert_ids;

  template <class M>
  struct Stream {
    Revision told{};                      ///< up to which revision a message has told what is known
    M values{};                           ///< what each field last said
    Timestamp allowed{Timestamp::min()};  ///< the next message, not before
    Timestamp refresh{Timestamp::min()};  ///< when every field is told again
  };
  std::tuple<Stream<to::InertialStates>, Stream<to::AirAndGroundRelativeStates>, Stream<to::BodyRelativeSensedStates>,
             Stream<to::VehicleOperatingStates>>
      streams;
  template <class M>
  Stream<M>& stream() {
    return std::get<Stream<M>>(streams);
  }
  Revision leg_told{};
  Revision mode_told{};
  Revision identity_told{};
  std::array<Revision, vehicle::subsystem_count> subsystem_told{};

  // When the next message is due even if nothing calls for it; nothing: it has nothing to say yet.
  std::optional<Timestamp> inertial_due{};
  std::optional<Timestamp> air_due{};
  std::optional<Timestamp> operating_due{};
  std::optional<Timestamp> leg_due{};
  std::optional<Timestamp> mode_due{};
  std::optional<Timestamp> identity_due{};

  /// When a message is due or a time-out runs out.
  [[nodiscard]] Timestamp next_deadline() const {
    auto deadline = Timestamp::max();
    for (const auto& due :
         {inertial_due, air_due, operating_due, leg_due, mode_due, identity_due, monitor.next_deadline()})
      if (due) deadline = std::min(deadline, *due);
    return deadline;
  }
};

Telemetry::Telemetry(TelemetryConfig config, TelemetryRates rates) : config_{std::move(config)}, rates_{rates} {
  vehicles_.reserve(vehicle_limit);
}
Telemetry::~Telemetry() = default;
Telemetry::Telemetry(Telemetry&&) noexcept = default;
Telemetry& Telemetry::operator=(Telemetry&&) noexcept = default;

template <class M>
void Telemetry::send(dli::EntityId source, const M& message, WallTime wall, Outbox<OutgoingMessage>& out) {
  OutgoingMessage outgoing{.time = wall, .size = 0, .buffer = {}};
  dli::DatagramWriter writer{outgoing.buffer, config_.profile};
  const auto written = dli::add_message(writer, {.source = source, .destination = dli::broadcast_id}, message);
  PONTE_ASSERT(written.has_value());
  outgoing.size = written->size();
  out.push(outgoing);
}

template <class M>
bool Telemetry::send_news(Vehicle& vehicle, Revision since, WallTime wall, Outbox<OutgoingMessage>& out) {
  const dlisession::MappingContext context{config_.profile, vehicle.description};
  const auto built = dlisession::status_message<M>(vehicle.monitor.state(), since, context);
  if (built) send(vehicle.description.vehicle, built->message, wall, out);
  return built.has_value();
}

/// The next message of a stream: what is new, and if changes are all that is wanted, what has another value.
template <class M>
bool Telemetry::send_stream(Vehicle& vehicle, Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out) {
  auto& stream = vehicle.stream<M>();
  const dlisession::MappingContext context{config_.profile, vehicle.description};
  const auto& state = vehicle.monitor.state();
  const bool refresh = rates_.full_refresh && stream.refresh <= now;
  auto built = dlisession::status_message<M>(state, refresh ? 0 : stream.told, context);
  stream.told = state.revision;
  if (!built) return false;
  if (refresh) {
    stream.refresh = now + *rates_.full_refresh;
    stream.values = built->message;
  } else if (rates_.full_refresh && !keep_changes(built->message, stream.values)) {
    return false;
  }
  send(vehicle.description.vehicle, built->message, wall, out);
  return true;
}

Telemetry::Vehicle* Telemetry::vehicle_that_sent(const mavlink::FrameView& frame) {
  const auto place =
      std::ranges::lower_bound(vehicles_, frame.system, {}, [](const auto& entry) { return entry->system; });
  const bool is_known = place != vehicles_.end() && (*place)->system == frame.system;
  std::optional<bool> says_autopilot;
  if (mavlink::carries<from::Heartbeat>(frame)) {
    const auto heartbeat = mavlink::decode<from::Heartbeat>(frame);
    says_autopilot = heartbeat.autopilot != from::MAV_AUTOPILOT_INVALID && heartbeat.type != from::MAV_TYPE_GCS;
  } else if (mavlink::carries<from_v09::Heartbeat>(frame)) {
    const auto heartbeat = mavlink::decode<from_v09::Heartbeat>(frame);
    says_autopilot = heartbeat.autopilot != from_v09::MAV_AUTOPILOT_NONE && heartbeat.type != from_v09::OCU;
  }

  if (!is_known) {
    // A recording may begin with telemetry before the first HEARTBEAT; component 1 is the autopilot by convention.
    const bool is_vehicle = says_autopilot.value_or(frame.component == usual_autopilot);
    if (!is_vehicle || frame.system.value == 0 || vehicles_.size() == vehicle_limit) return nullptr;
    auto vehicle = std::make_unique<Vehicle>(frame.system, config_);
    vehicle->autopilot = frame.component;
    return vehicles_.insert(place, std::move(vehicle))->get();
  }
  auto& vehicle = **place;
  if (says_autopilot && *says_autopilot) {
    if (vehicle.is_none || frame.component == usual_autopilot) vehicle.autopilot = frame.component;
    vehicle.is_none = false;
  } else if (says_autopilot && frame.component == vehicle.autopilot) {
    vehicle.is_none = true;
  }
  return !vehicle.is_none && frame.component == vehicle.autopilot ? &vehicle : nullptr;
}

void Telemetry::on_frame(Timestamp now, WallTime received, const mavlink::FrameView& frame,
                         const mavlink::MessageInfo& message, Outbox<OutgoingMessage>& out) {
  if (next_deadline_ <= now) on_tick(now, received, out);
  auto* sender = vehicle_that_sent(frame);
  if (sender == nullptr) {
    on_station_frame(frame, message);
    return;
  }
  auto& vehicle = *sender;

  // A position that no message has carried yet goes out before the next one replaces it.
  auto& inertial = vehicle.stream<to::InertialStates>();
  if (carries_any<from::GlobalPositionInt, from_v09::GlobalPositionInt, from_v09::GlobalPosition>(frame) &&
      rates_.inertial_pause == Duration{} && vehicle.monitor.state().latitude.newer_than(inertial.told))
    send_stream<to::InertialStates>(vehicle, now, received, out);
  vehicle.monitor.on_message(now, received, frame, vehicle.alerts);

  if (carries_any<from::Attitude, from_v09::Attitude>(frame)) vehicle.inertial_due = std::max(now, inertial.allowed);
  if (carries_any<from::VfrHud, from_v09::VfrHud>(frame))
    vehicle.air_due = std::max(now, vehicle.stream<to::AirAndGroundRelativeStates>().allowed);
  auto& body = vehicle.stream<to::BodyRelativeSensedStates>();
  if (carries_any<from::HighresImu, from::ScaledImu, from_v09::ScaledImu>(frame) && body.allowed <= now &&
      send_stream<to::BodyRelativeSensedStates>(vehicle, now, received, out))
    body.allowed = now + rates_.body_pause;
  const auto wait_for = [&](std::optional<Timestamp>& due, Duration longest) {
    if (!due) due = now + longest;
  };
  wait_for(vehicle.inertial_due, rates_.inertial_wait);
  wait_for(vehicle.air_due, rates_.air_wait);
  wait_for(vehicle.operating_due, Duration{});
  wait_for(vehicle.leg_due, Duration{});
  send_changes(vehicle, now, received, out);
  send_due(vehicle, now, received, out);
  next_deadline_ = std::min(next_deadline_, vehicle.next_deadline());
}

void Telemetry::on_station_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo& message) {
  const auto target = target_of(frame, message);
  for (const auto& vehicle : vehicles_)
    if (target == vehicle->system) vehicle->monitor.on_station_message(frame);
}

void Telemetry::raise(mavlink::SystemId system, const vehicle::Alert& alert, WallTime wall,
                      Outbox<OutgoingMessage>& out) {
  for (const auto& vehicle : vehicles_) {
    if (vehicle->system != system || vehicle->is_none) continue;
    vehicle->alerts.push(alert);
    send_alerts(*vehicle, wall, out);
  }
}

/// What is told at once when it changes.
void Telemetry::send_changes(Vehicle& vehicle, Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out) {
  const dlisession::MappingContext context{config_.profile, vehicle.description};
  const auto& state = vehicle.monitor.state();
  if (state.identity.changed_since(vehicle.identity_told) || state.mission_id.changed_since(vehicle.identity_told))
    vehicle.identity_due = now;
  if (state.mode.changed_since(vehicle.mode_told)) vehicle.mode_due = now;
  if (state.phase.changed_since(vehicle.stream<to::VehicleOperatingStates>().told)) vehicle.operating_due = now;
  if (state.leg.changed_since(vehicle.leg_told)) vehicle.leg_due = now;
  for (std::size_t i = 0; i < state.subsystems.size(); ++i) {
    const auto& condition = state.subsystems[i];
    if (!condition.changed_since(vehicle.subsystem_told[i])) continue;
    const dlisession::SubsystemReport report{static_cast<vehicle::Subsystem>(i), condition.value()};
    send(vehicle.description.vehicle, dlisession::subsystem_message(report, condition.at(), context), wall, out);
    vehicle.subsystem_told[i] = state.revision;
  }
  send_alerts(vehicle, wall, out);
}

void Telemetry::send_alerts(Vehicle& vehicle, WallTime wall, Outbox<OutgoingMessage>& out) {
  const dlisession::MappingContext context{config_.profile, vehicle.description};
  vehicle.alerts.drain([&](const vehicle::Alert& alert) {
    const dlisession::AlertReport report{alert.severity, alert.subsystem, alert.text,
                                         vehicle.alert_ids.id_for(alert.text.view())};
    send(vehicle.description.vehicle, dlisession::alert_message(report, wall, context), wall, out);
  });
}

/// What has waited long enough, or is due again.
void Telemetry::send_due(Vehicle& vehicle, Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out) {
  const auto& state = vehicle.monitor.state();
  const auto is_due = [&](const std::optional<Timestamp>& due) { return due && *due <= now; };
  if (is_due(vehicle.identity_due)) {
    send_news<to::VehicleId>(vehicle, 0, wall, out);
    vehicle.identity_told = state.revision;
    vehicle.identity_due = now + rates_.vehicle_id;
  }
  if (is_due(vehicle.mode_due)) {
    send_news<to::VehicleOperatingModeReport>(vehicle, 0, wall, out);
    vehicle.mode_told = state.revision;
    vehicle.mode_due = now + rates_.operating_mode;
  }
  if (is_due(vehicle.operating_due)) {
    send_stream<to::VehicleOperatingStates>(vehicle, now, wall, out);
    vehicle.operating_due = now + rates_.operating_states;
  }
  if (is_due(vehicle.inertial_due)) {
    if (send_stream<to::InertialStates>(vehicle, now, wall, out))
      vehicle.stream<to::InertialStates>().allowed = now + rates_.inertial_pause;
    vehicle.inertial_due.reset();
  }
  if (is_due(vehicle.air_due)) {
    if (send_stream<to::AirAndGroundRelativeStates>(vehicle, now, wall, out))
      vehicle.stream<to::AirAndGroundRelativeStates>().allowed = now + rates_.air_pause;
    vehicle.air_due.reset();
  }
  if (is_due(vehicle.leg_due)) {
    send_news<to::FromToNextWaypointStates>(vehicle, vehicle.leg_told, wall, out);
    vehicle.leg_told = state.revision;
    vehicle.leg_due = now + rates_.leg;
  }
}

void Telemetry::on_tick(Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out) {
  if (next_heartbeat_ <= now) {
    // The heartbeat proves the VSM, whatever the vehicles do.
    send(config_.vsm, dlisession::heartbeat_message(wall), wall, out);
    next_heartbeat_ = now + rates_.heartbeat;
  }
  next_deadline_ = next_heartbeat_;
  for (const auto& vehicle : vehicles_) {
    if (vehicle->is_none) continue;
    vehicle->monitor.on_tick(now, wall, vehicle->alerts);
    send_changes(*vehicle, now, wall, out);
    send_due(*vehicle, now, wall, out);
    next_deadline_ = std::min(next_deadline_, vehicle->next_deadline());
  }
}

void Telemetry::finish(Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out) {
  for (const auto& vehicle : vehicles_) {
    if (vehicle->is_none) continue;
    vehicle->monitor.finish(vehicle->alerts);
    vehicle->inertial_due = vehicle->air_due = vehicle->operating_due = vehicle->leg_due = now;
    send_changes(*vehicle, now, wall, out);
    send_due(*vehicle, now, wall, out);
  }
}

std::size_t Telemetry::vehicle_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(vehicles_, [](const auto& vehicle) { return !vehicle->is_none; }));
}

const vehicle::State* Telemetry::state_of(mavlink::SystemId system) const {
  for (const auto& vehicle : vehicles_)
    if (vehicle->system == system && !vehicle->is_none) return &vehicle->monitor.state();
  return nullptr;
}

}  // namespace ponte::vsm
