#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/telemetry_messages.hpp"

namespace ponte::sim {
namespace {

constexpr std::uint16_t position_only = 0xFDF8;  // POSITION_TARGET_TYPEMASK, as ArduCopter sends it
constexpr std::uint8_t unknown_rssi = 255;

// The sensors and controllers that this vehicle has; all of them are healthy as soon as they are in use.
constexpr std::uint32_t always_in_use =
    messages::MAV_SYS_STATUS_SENSOR_3D_GYRO | messages::MAV_SYS_STATUS_SENSOR_3D_ACCEL |
    messages::MAV_SYS_STATUS_SENSOR_3D_MAG | messages::MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE |
    messages::MAV_SYS_STATUS_SENSOR_GPS | messages::MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL |
    messages::MAV_SYS_STATUS_SENSOR_Z_ALTITUDE_CONTROL | messages::MAV_SYS_STATUS_SENSOR_RC_RECEIVER |
    messages::MAV_SYS_STATUS_AHRS | messages::MAV_SYS_STATUS_SENSOR_BATTERY | messages::MAV_SYS_STATUS_PREARM_CHECK |
    messages::MAV_SYS_STATUS_SENSOR_PROPULSION;
constexpr std::uint32_t in_use_when_armed =
    messages::MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION | messages::MAV_SYS_STATUS_SENSOR_YAW_POSITION |
    messages::MAV_SYS_STATUS_SENSOR_XY_POSITION_CONTROL | messages::MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS;

std::uint16_t millivolts(const BatteryState& battery) { return scaled<std::uint16_t>(battery.volts, 1e3); }
std::int16_t centiamperes(const BatteryState& battery) { return scaled<std::int16_t>(battery.amperes, 1e2); }
std::int8_t percent(const BatteryState& battery) { return scaled<std::int8_t>(battery.remaining, 100); }

std::uint8_t base_mode(const Snapshot& snapshot) {
  unsigned mode = messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | messages::MAV_MODE_FLAG_STABILIZE_ENABLED |
                  messages::MAV_MODE_FLAG_MANUAL_INPUT_ENABLED;
  if (!snapshot.is_ready || snapshot.mode != FlightMode::stabilize) mode |= messages::MAV_MODE_FLAG_GUIDED_ENABLED;
  if (snapshot.armed) mode |= messages::MAV_MODE_FLAG_SAFETY_ARMED;
  return static_cast<std::uint8_t>(mode);
}

std::uint8_t system_status(const Snapshot& snapshot) {
  if (!snapshot.is_ready) return messages::MAV_STATE_BOOT;
  if (snapshot.is_in_trouble) return messages::MAV_STATE_CRITICAL;
  return snapshot.landed_state == LandedState::on_ground ? messages::MAV_STATE_STANDBY : messages::MAV_STATE_ACTIVE;
}

}  // namespace

std::uint8_t vehicle_type(const Snapshot& snapshot) {
  const bool is_plane = snapshot.kind.type == AirframeType::plane;
  return is_plane ? messages::MAV_TYPE_FIXED_WING : messages::MAV_TYPE_QUADROTOR;
}

messages::Heartbeat heartbeat(const Snapshot& snapshot) {
  return {
      .type = vehicle_type(snapshot),
      .autopilot = messages::MAV_AUTOPILOT_ARDUPILOTMEGA,
      .base_mode = base_mode(snapshot),
      .custom_mode = flight_mode_info(snapshot.kind, snapshot.mode).custom_mode,
      .system_status = system_status(snapshot),
  };
}

messages::SysStatus sys_status(const Snapshot& snapshot) {
  const auto enabled = always_in_use | (snapshot.armed ? in_use_when_armed : 0);
  auto healthy = always_in_use | in_use_when_armed;
  if (snapshot.satellites.fix < SatelliteFix::full) healthy &= ~std::uint32_t{messages::MAV_SYS_STATUS_SENSOR_GPS};
  if (!snapshot.is_ready) healthy &= ~std::uint32_t{messages::MAV_SYS_STATUS_AHRS};
  if (!snapshot.has_position) healthy &= ~std::uint32_t{messages::MAV_SYS_STATUS_PREARM_CHECK};
  return {
      .onboard_control_sensors_present = always_in_use | in_use_when_armed,
      .onboard_control_sensors_enabled = enabled,
      .onboard_control_sensors_health = healthy,
      .load = 150,  // tenths of a percent
      .voltage_battery = millivolts(snapshot.battery),
      .current_battery = centiamperes(snapshot.battery),
      .battery_remaining = percent(snapshot.battery),
  };
}

messages::SystemTime system_time(const Snapshot& snapshot) {
  const auto utc = snapshot.utc ? static_cast<std::uint64_t>(unix_us(*snapshot.utc)) : 0;
  return {.time_unix_usec = utc, .time_boot_ms = boot_ms(snapshot)};
}

messages::BatteryStatus battery_status(const Snapshot& snapshot) {
  constexpr std::uint16_t no_cell = 65535;
  constexpr std::int16_t unknown_temperature = 32767;
  messages::BatteryStatus message{
      .temperature = unknown_temperature,
      .current_battery = centiamperes(snapshot.battery),
      .current_consumed = scaled<std::int32_t>(snapshot.battery.consumed_ampere_hours, 1e3),
      .energy_consumed = scaled<std::int32_t>(snapshot.battery.consumed_joules, 1e-2),
      .battery_remaining = percent(snapshot.battery),
      .charge_state =
          static_cast<std::uint8_t>(messages::MAV_BATTERY_CHARGE_STATE_OK + static_cast<unsigned>(snapshot.charge)),
  };
  message.voltages.fill(no_cell);
  message.voltages[0] = millivolts(snapshot.battery);  // of the whole pack: the cells are not measured
  return message;
}

messages::NavControllerOutput nav_controller_output(const Snapshot& snapshot) {
  const auto& attitude = snapshot.readings.attitude;
  messages::NavControllerOutput message{
      .nav_roll = static_cast<float>(attitude.roll.value * degrees_per_radian),
      .nav_pitch = static_cast<float>(attitude.pitch.value * degrees_per_radian),
      .nav_bearing = scaled<std::int16_t>(attitude.heading.value, degrees_per_radian),
  };
  if (!snapshot.target) return message;
  const auto offset = offset_between(snapshot.readings.position, *snapshot.target);
  const double bearing = std::atan2(offset.east, offset.north);
  message.nav_bearing = scaled<std::int16_t>(bearing, degrees_per_radian);
  message.target_bearing = static_cast<std::int16_t>(compass_degrees(bearing));
  message.wp_dist = scaled<std::uint16_t>(horizontal(offset), 1);
  message.alt_error = static_cast<float>(-offset.down);
  return message;
}

std::optional<messages::PositionTargetGlobalInt> position_target(const Snapshot& snapshot) {
  if (!snapshot.target) return std::nullopt;
  return messages::PositionTargetGlobalInt{
      .time_boot_ms = boot_ms(snapshot),
      .coordinate_frame = messages::MAV_FRAME_GLOBAL,
      .type_mask = position_only,
      .lat_int = degrees_e7(snapshot.target->latitude),
      .lon_int = degrees_e7(snapshot.target->longitude),
      .alt = static_cast<float>(snapshot.target->altitude_msl.value),
  };
}

std::optional<messages::MissionItemReached> mission_item_reached(const Snapshot& snapshot) {
  if (!snapshot.reached) return std::nullopt;
  return messages::MissionItemReached{.seq = snapshot.reached->item};
}

/// Home is an item, but is not counted.
messages::MissionCurrent mission_current(const Snapshot& snapshot) {
  const auto& mission = snapshot.mission;
  return {
      .seq = mission.current,
      .total = static_cast<std::uint16_t>(mission.items == 0 ? 0 : mission.items - 1),
      .mission_state = mission.state,
      .mission_mode = static_cast<std::uint8_t>(mission.is_flown    ? 1
                                                : mission.items > 1 ? 2
                                                                    : 0),
  };
}

messages::ServoOutputRaw servo_output(const Snapshot& snapshot) {
  const auto pulse = static_cast<std::uint16_t>(1000 + scaled<std::uint16_t>(snapshot.throttle, 1000));
  return {
      .time_usec = static_cast<std::uint32_t>(microseconds(snapshot.since_boot)),
      .servo1_raw = pulse,
      .servo2_raw = pulse,
      .servo3_raw = pulse,
      .servo4_raw = pulse,
  };
}

/// A pilot's transmitter that nobody touches: sticks in the middle, throttle down.
messages::RcChannels rc_channels(const Snapshot& snapshot) {
  return {
      .time_boot_ms = boot_ms(snapshot),
      .chancount = 8,
      .chan1_raw = 1500,
      .chan2_raw = 1500,
      .chan3_raw = 1000,
      .chan4_raw = 1500,
      .chan5_raw = 1800,
      .chan6_raw = 1000,
      .chan7_raw = 1000,
      .chan8_raw = 1800,
      .rssi = unknown_rssi,
  };
}

messages::ExtendedSysState extended_sys_state(const Snapshot& snapshot) {
  const auto landed_state = [&] {
    switch (snapshot.landed_state) {
      case LandedState::on_ground: return messages::MAV_LANDED_STATE_ON_GROUND;
      case LandedState::in_air: return messages::MAV_LANDED_STATE_IN_AIR;
      case LandedState::taking_off: return messages::MAV_LANDED_STATE_TAKEOFF;
      case LandedState::landing: return messages::MAV_LANDED_STATE_LANDING;
    }
    return messages::MAV_LANDED_STATE_UNDEFINED;
  }();
  return {.vtol_state = messages::MAV_VTOL_STATE_MC, .landed_state = landed_state};
}

std::optional<messages::HomePosition> home_position(const Snapshot& snapshot) {
  if (!snapshot.has_position) return std::nullopt;
  const auto offset = offset_between(snapshot.origin, snapshot.home);
  messages::HomePosition message{
      .latitude = degrees_e7(snapshot.home.latitude),
      .longitude = degrees_e7(snapshot.home.longitude),
      .altitude = scaled<std::int32_t>(snapshot.home.altitude_msl.value, 1e3),
      .x = static_cast<float>(offset.north),
      .y = static_cast<float>(offset.east),
      .z = static_cast<float>(offset.down),
      .time_usec = microseconds(snapshot.since_boot),
  };
  message.q.fill(std::numeric_limits<float>::quiet_NaN());
  return message;
}

std::optional<messages::GpsGlobalOrigin> gps_global_origin(const Snapshot& snapshot) {
  if (!snapshot.has_position) return std::nullopt;
  return messages::GpsGlobalOrigin{
      .latitude = degrees_e7(snapshot.origin.latitude),
      .longitude = degrees_e7(snapshot.origin.longitude),
      .altitude = scaled<std::int32_t>(snapshot.origin.altitude_msl.value, 1e3),
      .time_usec = microseconds(snapshot.since_boot),
  };
}

messages::AutopilotVersion autopilot_version(const Snapshot& snapshot) {
  return {
      .capabilities = messages::MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT | messages::MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT |
                      messages::MAV_PROTOCOL_CAPABILITY_MISSION_INT | messages::MAV_PROTOCOL_CAPABILITY_COMMAND_INT |
                      messages::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED |
                      messages::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT |
                      messages::MAV_PROTOCOL_CAPABILITY_FTP | messages::MAV_PROTOCOL_CAPABILITY_MAVLINK2 |
                      messages::MAV_PROTOCOL_CAPABILITY_MISSION_FENCE | messages::MAV_PROTOCOL_CAPABILITY_MISSION_RALLY,
      .flight_sw_version = 0x0407'0000,  // 4.7.0, a development version
      .flight_custom_version = {'p', 'o', 'n', 't', 'e', '-', 's', 'i'},
      .uid = snapshot.system.value,
  };
}

}  // namespace ponte::sim
