#include "ponte/mavlink/v09/attitude.hpp"
#include "ponte/mavlink/v09/enums.hpp"
#include "ponte/mavlink/v09/global_position_int.hpp"
#include "ponte/mavlink/v09/gps_raw_int.hpp"
#include "ponte/mavlink/v09/heartbeat.hpp"
#include "ponte/mavlink/v09/nav_controller_output.hpp"
#include "ponte/mavlink/v09/raw_imu.hpp"
#include "ponte/mavlink/v09/rc_channels_raw.hpp"
#include "ponte/mavlink/v09/scaled_imu.hpp"
#include "ponte/mavlink/v09/scaled_pressure.hpp"
#include "ponte/mavlink/v09/servo_output_raw.hpp"
#include "ponte/mavlink/v09/sys_status.hpp"
#include "ponte/mavlink/v09/vfr_hud.hpp"
#include "ponte/sim/telemetry_messages.hpp"
#include "ponte/sim/telemetry_row.hpp"

#include <array>

/// What the same step looks like in MAVLink 0.9: most messages were other layouts of those of today.
namespace ponte::sim {
namespace {

namespace v09 = mavlink::v09;

constexpr std::uint16_t us_per_ms = 1000;

std::uint8_t mode_of(const Snapshot& snapshot) {
  if (!snapshot.is_ready) return v09::MAV_MODE_UNINIT;
  switch (snapshot.mode) {
    case FlightMode::manual:
    case FlightMode::stabilize:
    case FlightMode::altitude_hold: return v09::MAV_MODE_MANUAL;
    case FlightMode::guided: return v09::MAV_MODE_GUIDED;
    default: return v09::MAV_MODE_AUTO;
  }
}

std::uint8_t nav_mode_of(const Snapshot& snapshot) {
  if (snapshot.landed_state == LandedState::on_ground) return v09::MAV_NAV_GROUNDED;
  if (snapshot.landed_state == LandedState::taking_off) return v09::MAV_NAV_LIFTOFF;
  switch (snapshot.mode) {
    case FlightMode::automatic: return v09::MAV_NAV_WAYPOINT;
    case FlightMode::rtl: return v09::MAV_NAV_RETURNING;
    case FlightMode::land: return v09::MAV_NAV_LANDING;
    case FlightMode::guided: return v09::MAV_NAV_VECTOR;
    default: return v09::MAV_NAV_LOITER;
  }
}

std::uint8_t status_of(const Snapshot& snapshot) {
  if (!snapshot.is_ready) return v09::MAV_STATE_BOOT;
  return snapshot.armed ? v09::MAV_STATE_ACTIVE : v09::MAV_STATE_STANDBY;
}

v09::Heartbeat heartbeat_v09(const Snapshot& /*snapshot*/) {
  return {.type = v09::MAV_QUADROTOR, .autopilot = v09::MAV_AUTOPILOT_ARDUPILOTMEGA};
}

v09::SysStatus sys_status_v09(const Snapshot& snapshot) {
  const auto now = sys_status(snapshot);
  return {
      .mode = mode_of(snapshot),
      .nav_mode = nav_mode_of(snapshot),
      .status = status_of(snapshot),
      .load = now.load,
      .vbat = now.voltage_battery,
      .battery_remaining = scaled<std::uint16_t>(snapshot.battery.remaining, 1000),
  };
}

v09::Attitude attitude_v09(const Snapshot& snapshot) {
  const auto now = attitude_message(snapshot);
  return {
      .usec = microseconds(snapshot.since_boot),
      .roll = now.roll,
      .pitch = now.pitch,
      .yaw = now.yaw,
      .rollspeed = now.rollspeed,
      .pitchspeed = now.pitchspeed,
      .yawspeed = now.yawspeed,
  };
}

/// Its z axis points up.
v09::GlobalPositionInt global_position_v09(const Snapshot& snapshot) {
  const auto now = global_position(snapshot);
  return {
      .lat = now.lat,
      .lon = now.lon,
      .alt = now.alt,
      .vx = now.vx,
      .vy = now.vy,
      .vz = static_cast<std::int16_t>(-now.vz),
  };
}

v09::VfrHud vfr_hud_v09(const Snapshot& snapshot) {
  const auto now = vfr_hud(snapshot);
  return {
      .airspeed = now.airspeed,
      .groundspeed = now.groundspeed,
      .heading = now.heading,
      .throttle = now.throttle,
      .alt = now.alt,
      .climb = now.climb,
  };
}

v09::NavControllerOutput nav_controller_output_v09(const Snapshot& snapshot) {
  const auto now = nav_controller_output(snapshot);
  return {
      .nav_roll = now.nav_roll,
      .nav_pitch = now.nav_pitch,
      .nav_bearing = now.nav_bearing,
      .target_bearing = now.target_bearing,
      .wp_dist = now.wp_dist,
      .alt_error = now.alt_error,
      .aspd_error = now.aspd_error,
      .xtrack_error = now.xtrack_error,
  };
}

v09::GpsRawInt gps_raw_v09(const Snapshot& snapshot) {
  const auto now = gps_raw(snapshot);
  constexpr float hundredths = 100;
  return {
      .usec = now.time_usec,
      .fix_type = now.fix_type,
      .lat = now.lat,
      .lon = now.lon,
      .alt = now.alt,
      .eph = static_cast<float>(now.eph) / hundredths,
      .epv = static_cast<float>(now.epv) / hundredths,
      .v = static_cast<float>(now.vel) / hundredths,
      .hdg = static_cast<float>(now.cog) / hundredths,
  };
}

template <class Imu>
Imu imu_v09(const Snapshot& snapshot) {
  const auto now = scaled_imu(snapshot);
  return {
      .usec = microseconds(snapshot.since_boot),
      .xacc = now.xacc,
      .yacc = now.yacc,
      .zacc = now.zacc,
      .xgyro = now.xgyro,
      .ygyro = now.ygyro,
      .zgyro = now.zgyro,
      .xmag = now.xmag,
      .ymag = now.ymag,
      .zmag = now.zmag,
  };
}

v09::ScaledPressure scaled_pressure_v09(const Snapshot& snapshot) {
  const auto now = scaled_pressure(snapshot);
  return {
      .usec = std::uint64_t{now.time_boot_ms} * us_per_ms,
      .press_abs = now.press_abs,
      .press_diff = now.press_diff,
      .temperature = now.temperature,
  };
}

v09::ServoOutputRaw servo_output_v09(const Snapshot& snapshot) {
  const auto now = servo_output(snapshot);
  return {
      .servo1_raw = now.servo1_raw,
      .servo2_raw = now.servo2_raw,
      .servo3_raw = now.servo3_raw,
      .servo4_raw = now.servo4_raw,
  };
}

v09::RcChannelsRaw rc_channels_v09(const Snapshot& snapshot) {
  const auto now = rc_channels(snapshot);
  return {
      .chan1_raw = now.chan1_raw,
      .chan2_raw = now.chan2_raw,
      .chan3_raw = now.chan3_raw,
      .chan4_raw = now.chan4_raw,
      .chan5_raw = now.chan5_raw,
      .chan6_raw = now.chan6_raw,
      .chan7_raw = now.chan7_raw,
      .chan8_raw = now.chan8_raw,
      .rssi = now.rssi,
  };
}

constexpr std::array rows{
    telemetry_row<heartbeat_v09>({Stream::none, std::chrono::seconds{1}}),
    telemetry_row<attitude_v09>({Stream::extra1}),
    telemetry_row<global_position_v09>({Stream::position}),
    telemetry_row<vfr_hud_v09>({Stream::extra2}),
    telemetry_row<sys_status_v09>({Stream::extended_status}),
    telemetry_row<nav_controller_output_v09>({Stream::extended_status}),
    telemetry_row<gps_raw_v09>({Stream::extended_status}),
    telemetry_row<servo_output_v09>({Stream::rc_channels}),
    telemetry_row<rc_channels_v09>({Stream::rc_channels}),
    telemetry_row<imu_v09<v09::RawImu>>({Stream::raw_sensors}),
    telemetry_row<imu_v09<v09::ScaledImu>>({Stream::raw_sensors}),
    telemetry_row<scaled_pressure_v09>({Stream::raw_sensors}),
};
static_assert(rows.size() <= MessageRates::capacity);

}  // namespace

std::span<const TelemetryRow> telemetry_rows_v09() { return rows; }

}  // namespace ponte::sim
