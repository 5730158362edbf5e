#pragma once

#include "ponte/mavlink/autopilots/ahrs.hpp"
#include "ponte/mavlink/autopilots/altitude.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/attitude_quaternion.hpp"
#include "ponte/mavlink/autopilots/attitude_target.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/current_mode.hpp"
#include "ponte/mavlink/autopilots/ekf_status_report.hpp"
#include "ponte/mavlink/autopilots/estimator_status.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/gimbal_device_attitude_status.hpp"
#include "ponte/mavlink/autopilots/gimbal_device_information.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_information.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_status.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_global_origin.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/local_position_ned.hpp"
#include "ponte/mavlink/autopilots/meminfo.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"
#include "ponte/mavlink/autopilots/mount_orientation.hpp"
#include "ponte/mavlink/autopilots/nav_controller_output.hpp"
#include "ponte/mavlink/autopilots/position_target_global_int.hpp"
#include "ponte/mavlink/autopilots/position_target_local_ned.hpp"
#include "ponte/mavlink/autopilots/power_status.hpp"
#include "ponte/mavlink/autopilots/protocol_version.hpp"
#include "ponte/mavlink/autopilots/raw_imu.hpp"
#include "ponte/mavlink/autopilots/rc_channels.hpp"
#include "ponte/mavlink/autopilots/scaled_imu.hpp"
#include "ponte/mavlink/autopilots/scaled_pressure.hpp"
#include "ponte/mavlink/autopilots/servo_output_raw.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"
#include "ponte/mavlink/autopilots/vibration.hpp"
#include "ponte/mavlink/autopilots/wind.hpp"
#include "ponte/sim/telemetry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

/// The messages of one step, as ArduCopter fills them. An optional one is not sent before there is something to tell.
namespace ponte::sim {

namespace messages = mavlink::autopilots;

// How it moves and what it feels.
[[nodiscard]] messages::Attitude attitude_message(const Snapshot& snapshot);
[[nodiscard]] messages::AttitudeQuaternion attitude_quaternion(const Snapshot& snapshot);
[[nodiscard]] messages::GlobalPositionInt global_position(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::LocalPositionNed> local_position(const Snapshot& snapshot);
[[nodiscard]] messages::VfrHud vfr_hud(const Snapshot& snapshot);
[[nodiscard]] messages::GpsRawInt gps_raw(const Snapshot& snapshot);
[[nodiscard]] messages::RawImu raw_imu(const Snapshot& snapshot);
[[nodiscard]] messages::ScaledImu scaled_imu(const Snapshot& snapshot);
[[nodiscard]] messages::ScaledPressure scaled_pressure(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::Wind> wind(const Snapshot& snapshot);

// What state it is in, and what it wants.
[[nodiscard]] messages::Heartbeat heartbeat(const Snapshot& snapshot);
[[nodiscard]] messages::SysStatus sys_status(const Snapshot& snapshot);
[[nodiscard]] messages::SystemTime system_time(const Snapshot& snapshot);
[[nodiscard]] messages::BatteryStatus battery_status(const Snapshot& snapshot);
[[nodiscard]] messages::NavControllerOutput nav_controller_output(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::PositionTargetGlobalInt> position_target(const Snapshot& snapshot);
[[nodiscard]] messages::MissionCurrent mission_current(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::MissionItemReached> mission_item_reached(const Snapshot& snapshot);
[[nodiscard]] messages::ServoOutputRaw servo_output(const Snapshot& snapshot);
[[nodiscard]] messages::RcChannels rc_channels(const Snapshot& snapshot);
[[nodiscard]] messages::ExtendedSysState extended_sys_state(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::HomePosition> home_position(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::GpsGlobalOrigin> gps_global_origin(const Snapshot& snapshot);
[[nodiscard]] messages::AutopilotVersion autopilot_version(const Snapshot& snapshot);
[[nodiscard]] messages::PowerStatus power_status(const Snapshot& snapshot);
[[nodiscard]] messages::Meminfo meminfo(const Snapshot& snapshot);
[[nodiscard]] messages::Ahrs ahrs(const Snapshot& snapshot);
[[nodiscard]] messages::EkfStatusReport ekf_status_report(const Snapshot& snapshot);
[[nodiscard]] messages::Vibration vibration(const Snapshot& snapshot);

// The gimbal.
[[nodiscard]] std::optional<messages::GimbalManagerInformation> gimbal_manager_information(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::GimbalDeviceInformation> gimbal_device_information(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::GimbalManagerStatus> gimbal_manager_status(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::GimbalDeviceAttitudeStatus> gimbal_attitude(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::MountOrientation> mount_orientation(const Snapshot& snapshot);

// What PX4 sends besides, or fills in another way.
[[nodiscard]] messages::ProtocolVersion protocol_version(const Snapshot& snapshot);
[[nodiscard]] messages::Heartbeat heartbeat_px4(const Snapshot& snapshot);
[[nodiscard]] messages::MissionCurrent mission_current_px4(const Snapshot& snapshot);
[[nodiscard]] std::optional<messages::MissionItemReached> mission_item_reached_px4(const Snapshot& snapshot);
[[nodiscard]] messages::AutopilotVersion autopilot_version_px4(const Snapshot& snapshot);
[[nodiscard]] messages::CurrentMode current_mode(const Snapshot& snapshot);
[[nodiscard]] messages::Altitude altitude(const Snapshot& snapshot);
[[nodiscard]] messages::AttitudeTarget attitude_target(const Snapshot& snapshot);
[[nodiscard]] messages::PositionTargetLocalNed position_target_local(const Snapshot& snapshot);
[[nodiscard]] messages::EstimatorStatus estimator_status(const Snapshot& snapshot);

/// MAV_TYPE
[[nodiscard]] std::uint8_t vehicle_type(const Snapshot& snapshot);

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// `value` in units of which `per_unit` make one, to the nearest; what does not fit becomes the nearest that does.
template <std::integral Wire>
[[nodiscard]] Wire scaled(double value, double per_unit) {
  using Limits = std::numeric_limits<Wire>;
  const double nearest = std::floor(value * per_unit + 0.5);
  return static_cast<Wire>(std::clamp(nearest, static_cast<double>(Limits::min()), static_cast<double>(Limits::max())));
}

/// Latitude or longitude.
[[nodiscard]] inline std::int32_t degrees_e7(Radians angle) {
  return scaled<std::int32_t>(angle.value, degrees_per_radian * 1e7);
}

[[nodiscard]] inline std::uint32_t boot_ms(const Snapshot& snapshot) {
  return static_cast<std::uint32_t>(snapshot.since_boot / std::chrono::milliseconds{1});
}

[[nodiscard]] inline std::uint64_t microseconds(Duration since_boot) {
  return static_cast<std::uint64_t>(since_boot / std::chrono::microseconds{1});
}

/// Clockwise from north, 0 to before 360.
[[nodiscard]] inline double compass_degrees(double radians) {
  const double degrees = radians * degrees_per_radian;
  return degrees < 0 ? degrees + 360 : degrees;
}

}  // namespace ponte::sim
