#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/telemetry_messages.hpp"

/// The gimbal and its manager, which is the autopilot. Without a gimbal there is nothing to tell.
namespace ponte::sim {
namespace {

constexpr std::uint8_t device = 1;  // it has no component id of its own

constexpr auto limit(Radians angle) { return static_cast<float>(angle.value); }

}  // namespace

std::optional<messages::GimbalManagerInformation> gimbal_manager_information(const Snapshot& snapshot) {
  if (!snapshot.gimbal.is_fitted) return std::nullopt;
  return messages::GimbalManagerInformation{
      .time_boot_ms = boot_ms(snapshot),
      .cap_flags = messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_RETRACT | messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_NEUTRAL |
                   messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_PITCH_AXIS |
                   messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_PITCH_LOCK | messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_YAW_AXIS |
                   messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_YAW_FOLLOW | messages::GIMBAL_MANAGER_CAP_FLAGS_HAS_YAW_LOCK |
                   messages::GIMBAL_MANAGER_CAP_FLAGS_SUPPORTS_YAW_IN_EARTH_FRAME |
                   messages::GIMBAL_MANAGER_CAP_FLAGS_CAN_POINT_LOCATION_GLOBAL,
      .gimbal_device_id = device,
      .pitch_min = limit(Gimbal::lowest),
      .pitch_max = limit(Gimbal::highest),
      .yaw_min = -limit(Gimbal::farthest),
      .yaw_max = limit(Gimbal::farthest),
  };
}

std::optional<messages::GimbalDeviceInformation> gimbal_device_information(const Snapshot& snapshot) {
  if (!snapshot.gimbal.is_fitted) return std::nullopt;
  return messages::GimbalDeviceInformation{
      .time_boot_ms = boot_ms(snapshot),
      .vendor_name = std::string_view{"Ponte"},
      .model_name = std::string_view{"simulated"},
      .cap_flags = messages::GIMBAL_DEVICE_CAP_FLAGS_HAS_PITCH_AXIS | messages::GIMBAL_DEVICE_CAP_FLAGS_HAS_PITCH_LOCK |
                   messages::GIMBAL_DEVICE_CAP_FLAGS_HAS_YAW_AXIS | messages::GIMBAL_DEVICE_CAP_FLAGS_HAS_YAW_FOLLOW |
                   messages::GIMBAL_DEVICE_CAP_FLAGS_HAS_YAW_LOCK,
      .pitch_min = limit(Gimbal::lowest),
      .pitch_max = limit(Gimbal::highest),
      .yaw_min = -limit(Gimbal::farthest),
      .yaw_max = limit(Gimbal::farthest),
      .gimbal_device_id = device,
  };
}

std::optional<messages::GimbalManagerStatus> gimbal_manager_status(const Snapshot& snapshot) {
  const auto& gimbal = snapshot.gimbal;
  if (!gimbal.is_fitted) return std::nullopt;
  return messages::GimbalManagerStatus{.time_boot_ms = boot_ms(snapshot),
                                       .flags = gimbal.flags,
                                       .gimbal_device_id = device,
                                       .primary_control_sysid = gimbal.controller.system.value,
                                       .primary_control_compid = gimbal.controller.component.value};
}

/// In the frame that the flags name, with the other one's difference beside it.
std::optional<messages::GimbalDeviceAttitudeStatus> gimbal_attitude(const Snapshot& snapshot) {
  const auto& gimbal = snapshot.gimbal;
  if (!gimbal.is_fitted) return std::nullopt;
  const bool from_north = (gimbal.flags & messages::GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME) != 0;
  const double yaw = gimbal.yaw.value + (from_north ? gimbal.heading.value : 0);
  const double cp = std::cos(gimbal.pitch.value / 2);
  const double sp = std::sin(gimbal.pitch.value / 2);
  const double cy = std::cos(yaw / 2);
  const double sy = std::sin(yaw / 2);
  return messages::GimbalDeviceAttitudeStatus{
      .time_boot_ms = boot_ms(snapshot),
      .flags = gimbal.flags,
      .q = {static_cast<float>(cp * cy), static_cast<float>(-sp * sy), static_cast<float>(sp * cy),
            static_cast<float>(cp * sy)},
      .angular_velocity_y = static_cast<float>(gimbal.pitch_rate.value),
      .angular_velocity_z = static_cast<float>(gimbal.yaw_rate.value),
      .delta_yaw = static_cast<float>(gimbal.heading.value),
      .gimbal_device_id = device,
  };
}

std::optional<messages::MountOrientation> mount_orientation(const Snapshot& snapshot) {
  const auto& gimbal = snapshot.gimbal;
  if (!gimbal.is_fitted) return std::nullopt;
  return messages::MountOrientation{
      .time_boot_ms = boot_ms(snapshot),
      .pitch = static_cast<float>(gimbal.pitch.value * degrees_per_radian),
      .yaw = static_cast<float>(gimbal.yaw.value * degrees_per_radian),
      .yaw_absolute = static_cast<float>(wrapped(gimbal.yaw.value + gimbal.heading.value) * degrees_per_radian)};
}

}  // namespace ponte::sim
