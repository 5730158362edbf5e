#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/telemetry_messages.hpp"
#include "ponte/sim/telemetry_row.hpp"

#include <array>

/// What PX4 sends, unasked and at rates of its own.
namespace ponte::sim {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

std::uint32_t custom_mode(const Snapshot& snapshot) {
  return flight_mode_info(snapshot.kind, snapshot.mode).custom_mode;
}

std::uint8_t base_mode(const Snapshot& snapshot) {
  const auto mode = snapshot.mode;
  const bool has_pilot = mode == FlightMode::manual || mode == FlightMode::stabilize ||
                         mode == FlightMode::altitude_hold || mode == FlightMode::position_hold;
  unsigned flags = messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | messages::MAV_MODE_FLAG_STABILIZE_ENABLED;
  flags |= has_pilot ? messages::MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
                     : messages::MAV_MODE_FLAG_AUTO_ENABLED | messages::MAV_MODE_FLAG_GUIDED_ENABLED;
  if (snapshot.armed) flags |= messages::MAV_MODE_FLAG_SAFETY_ARMED;
  return static_cast<std::uint8_t>(flags);
}

/// Unlike ArduPilot's: before the checks pass it is uninitialised, and armed on the ground it is active.
std::uint8_t system_status(const Snapshot& snapshot) {
  if (snapshot.is_in_trouble) return messages::MAV_STATE_CRITICAL;
  if (snapshot.armed) return messages::MAV_STATE_ACTIVE;
  return snapshot.has_position ? messages::MAV_STATE_STANDBY : messages::MAV_STATE_UNINIT;
}

std::uint8_t standard_mode(FlightMode mode) {
  switch (mode) {
    case FlightMode::automatic: return messages::MAV_STANDARD_MODE_MISSION;
    case FlightMode::rtl: return messages::MAV_STANDARD_MODE_SAFE_RECOVERY;
    case FlightMode::land: return messages::MAV_STANDARD_MODE_LAND;
    case FlightMode::take_off: return messages::MAV_STANDARD_MODE_TAKEOFF;
    default: return messages::MAV_STANDARD_MODE_NON_STANDARD;
  }
}

constexpr Rate every(std::int64_t ms) { return {Stream::none, std::chrono::milliseconds{ms}}; }

constexpr std::array rows{
    telemetry_row<heartbeat_px4>(every(1000)),
    telemetry_row<attitude_message>(every(20)),
    telemetry_row<attitude_quaternion>(every(20)),
    telemetry_row<attitude_target>(every(20)),
    telemetry_row<global_position>(every(20)),
    telemetry_row<local_position>(every(20)),
    telemetry_row<position_target_local>(every(20)),
    telemetry_row<servo_output>(every(20)),
    telemetry_row<gps_raw>(every(200)),
    telemetry_row<vfr_hud>(every(250)),
    telemetry_row<sys_status>(every(1000)),
    telemetry_row<altitude>(every(1000)),
    telemetry_row<extended_sys_state>(every(1000)),
    telemetry_row<scaled_pressure>(every(1000)),
    telemetry_row<mission_current_px4>(every(1000)),
    telemetry_row<mission_item_reached_px4>(every(1000)),
    telemetry_row<position_target>(every(1000)),
    telemetry_row<home_position>(every(2000)),
    telemetry_row<battery_status>(every(2000)),
    telemetry_row<current_mode>(every(2000)),
    telemetry_row<estimator_status>(every(2000)),
    telemetry_row<vibration>(every(10'000)),
    telemetry_row<gimbal_attitude>(every(200)),
    telemetry_row<gimbal_manager_status>(every(5000)),
    telemetry_row<gimbal_manager_information>({}),
    telemetry_row<gimbal_device_information>({}),
    telemetry_row<mount_orientation>({}),
    telemetry_row<rc_channels>({}),
    telemetry_row<raw_imu>({}),
    telemetry_row<scaled_imu>({}),
    telemetry_row<system_time>({}),
    telemetry_row<gps_global_origin>({}),
    telemetry_row<autopilot_version_px4>({}),
    telemetry_row<protocol_version>({}),
};
static_assert(rows.size() <= MessageRates::capacity);

}  // namespace

std::span<const TelemetryRow> telemetry_rows_px4() { return rows; }

messages::Heartbeat heartbeat_px4(const Snapshot& snapshot) {
  return {
      .type = vehicle_type(snapshot),
      .autopilot = messages::MAV_AUTOPILOT_PX4,
      .base_mode = base_mode(snapshot),
      .custom_mode = custom_mode(snapshot),
      .system_status = system_status(snapshot),
  };
}

messages::MissionCurrent mission_current_px4(const Snapshot& snapshot) {
  constexpr std::uint16_t no_mission = 65535;
  const auto& mission = snapshot.mission;
  return {
      .seq = mission.current,
      .total = mission.items == 0 ? no_mission : mission.items,
      .mission_state = mission.state,
      .mission_mode = static_cast<std::uint8_t>(mission.is_flown ? 1 : 2),
      .mission_id = mission.ids[0],
      .fence_id = mission.ids[1],
      .rally_points_id = mission.ids[2],
  };
}

/// Again and again for a while, in case somebody has missed it.
std::optional<messages::MissionItemReached> mission_item_reached_px4(const Snapshot& snapshot) {
  constexpr Duration told_for = std::chrono::seconds{10};
  if (!snapshot.reached || snapshot.since_boot - snapshot.reached->at > told_for) return std::nullopt;
  return mission_item_reached(snapshot);
}

messages::AutopilotVersion autopilot_version_px4(const Snapshot& snapshot) {
  return {
      .capabilities = messages::MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT | messages::MAV_PROTOCOL_CAPABILITY_MISSION_INT |
                      messages::MAV_PROTOCOL_CAPABILITY_COMMAND_INT |
                      messages::MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE |
                      messages::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED |
                      messages::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT |
                      messages::MAV_PROTOCOL_CAPABILITY_MAVLINK2 | messages::MAV_PROTOCOL_CAPABILITY_MISSION_FENCE |
                      messages::MAV_PROTOCOL_CAPABILITY_MISSION_RALLY,
      .flight_sw_version = 0x0112'0000,  // 1.18.0, a development version
      .flight_custom_version = {'p', 'o', 'n', 't', 'e', '-', 's', 'i'},
      .uid = snapshot.system.value,
  };
}

/// In hundredths, and as it was recorded.
messages::ProtocolVersion protocol_version(const Snapshot& /*snapshot*/) {
  return {.version = 200, .min_version = 100, .max_version = 203};
}

messages::CurrentMode current_mode(const Snapshot& snapshot) {
  return {.standard_mode = standard_mode(snapshot.mode),
          .custom_mode = custom_mode(snapshot),
          .intended_custom_mode = custom_mode(snapshot)};
}

messages::Altitude altitude(const Snapshot& snapshot) {
  const auto above_sea = static_cast<float>(snapshot.readings.position.altitude_msl.value);
  const auto above = [&](const Position& place) { return above_sea - static_cast<float>(place.altitude_msl.value); };
  return {
      .time_usec = microseconds(snapshot.since_boot),
      .altitude_monotonic = above_sea,
      .altitude_amsl = above_sea,
      .altitude_local = snapshot.has_position ? above(snapshot.origin) : unknown,
      .altitude_relative = snapshot.has_position ? above(snapshot.home) : unknown,
      .altitude_terrain = unknown,
      .bottom_clearance = unknown,
  };
}

/// What the controllers want is what the vehicle does: here nothing lags behind.
messages::AttitudeTarget attitude_target(const Snapshot& snapshot) {
  const auto now = attitude_quaternion(snapshot);
  return {
      .time_boot_ms = now.time_boot_ms,
      .q = {now.q1, now.q2, now.q3, now.q4},
      .body_roll_rate = now.rollspeed,
      .body_pitch_rate = now.pitchspeed,
      .body_yaw_rate = now.yawspeed,
      .thrust = static_cast<float>(snapshot.throttle),
  };
}

messages::PositionTargetLocalNed position_target_local(const Snapshot& snapshot) {
  messages::PositionTargetLocalNed message{
      .time_boot_ms = boot_ms(snapshot),
      .coordinate_frame = messages::MAV_FRAME_LOCAL_NED,
      .x = unknown,
      .y = unknown,
      .z = unknown,
      .vx = unknown,
      .vy = unknown,
      .vz = unknown,
      .yaw = static_cast<float>(snapshot.readings.attitude.heading.value),
  };
  if (!snapshot.target) return message;
  const auto offset = offset_between(snapshot.origin, *snapshot.target);
  message.x = static_cast<float>(offset.north);
  message.y = static_cast<float>(offset.east);
  message.z = static_cast<float>(offset.down);
  return message;
}

messages::EstimatorStatus estimator_status(const Snapshot& snapshot) {
  constexpr unsigned without_position = messages::ESTIMATOR_ATTITUDE | messages::ESTIMATOR_VELOCITY_VERT |
                                        messages::ESTIMATOR_POS_VERT_ABS | messages::ESTIMATOR_POS_VERT_AGL;
  constexpr unsigned with_position = without_position | messages::ESTIMATOR_VELOCITY_HORIZ |
                                     messages::ESTIMATOR_POS_HORIZ_REL | messages::ESTIMATOR_POS_HORIZ_ABS |
                                     messages::ESTIMATOR_PRED_POS_HORIZ_REL | messages::ESTIMATOR_PRED_POS_HORIZ_ABS;
  const bool known = snapshot.has_position;
  return {
      .time_usec = microseconds(snapshot.since_boot),
      .flags = static_cast<std::uint16_t>(known ? with_position : without_position),
      .vel_ratio = known ? 0.05F : unknown,
      .pos_horiz_ratio = known ? 0.02F : unknown,
      .pos_vert_ratio = 0.02F,
      .mag_ratio = 0.04F,
      .hagl_ratio = unknown,
      .tas_ratio = unknown,
      .pos_horiz_accuracy = known ? 0.3F : unknown,
      .pos_vert_accuracy = 0.3F,
  };
}

}  // namespace ponte::sim
