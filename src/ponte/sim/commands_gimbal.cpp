#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_set_attitude.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_set_pitchyaw.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_status.hpp"
#include "ponte/sim/autopilot.hpp"
#include "ponte/sim/telemetry_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// The gimbal manager, version 2, and the commands of the mounts before it.
namespace ponte::sim {
namespace {

float radians(float degrees) { return static_cast<float>(double{degrees} / degrees_per_radian); }

}  // namespace

std::uint8_t Autopilot::point_gimbal(const Command& command, Call& call) {
  if (!gimbal_.state().is_fitted) return not_there();
  constexpr std::uint32_t all_flags = 0xFFFF;
  switch (command.number) {
    case messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW: {
      const auto flags = whole_number(static_cast<float>(command.x), all_flags).value_or(0);
      gimbal_.point(radians(command.param1), radians(command.param2), radians(command.param3), radians(command.param4),
                    flags);
      return messages::MAV_RESULT_ACCEPTED;
    }
    case messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE:
      gimbal_.configure(command.param1, command.param2, call.requester);
      snapshot_.gimbal = gimbal_.state();
      send_row(messages::GimbalManagerStatus::info.id, call.speaker);
      return messages::MAV_RESULT_ACCEPTED;
    case messages::MAV_CMD_DO_MOUNT_CONFIGURE: return messages::MAV_RESULT_ACCEPTED;  // stabilised in any case
    case messages::MAV_CMD_DO_MOUNT_CONTROL: {
      const bool ahead = command.z <= static_cast<float>(messages::MAV_MOUNT_MODE_NEUTRAL);  // retracted or neutral
      gimbal_.point(ahead ? 0 : radians(command.param1), ahead ? 0 : radians(command.param3), 0, 0, 0);
      return messages::MAV_RESULT_ACCEPTED;
    }
    default: return messages::MAV_RESULT_UNSUPPORTED;
  }
}

/// ArduPilot accepts it without a gimbal, too: a copter turns its nose.
std::uint8_t Autopilot::look_at(const Command& command) {
  const bool ends = command.number == messages::MAV_CMD_DO_SET_ROI_NONE || (command.x == 0 && command.y == 0);
  if (ends) {
    gimbal_.look_at(std::nullopt);
    return messages::MAV_RESULT_ACCEPTED;
  }
  const auto altitude =
      altitude_in_frame(command.frame.value_or(messages::MAV_FRAME_GLOBAL), double{command.z}, flight_.home());
  if (!altitude || !(std::abs(altitude->value) < 1e6) || !(std::abs(command.x) <= 90) || !(std::abs(command.y) <= 180))
    return messages::MAV_RESULT_DENIED;
  gimbal_.look_at(Position{radians_from_degrees(command.x), radians_from_degrees(command.y), *altitude});
  return messages::MAV_RESULT_ACCEPTED;
}

/// What an autopilot without a gimbal answers to commands for one.
std::uint8_t Autopilot::not_there() const {
  return is_px4() ? messages::MAV_RESULT_UNSUPPORTED : messages::MAV_RESULT_FAILED;
}

void Autopilot::on_gimbal_message(const messages::GimbalManagerSetPitchyaw& wish) {
  gimbal_.point(wish.pitch, wish.yaw, wish.pitch_rate, wish.yaw_rate, wish.flags);
}

void Autopilot::on_gimbal_message(const messages::GimbalManagerSetAttitude& wish) {
  const auto [w, x, y, z] = wish.q;
  const double sine = std::clamp(2.0 * (double{w} * y - double{z} * x), -1.0, 1.0);
  const double yaw = std::atan2(2.0 * (double{w} * z + double{x} * y), 1 - 2.0 * (double{y} * y + double{z} * z));
  const bool has_angles = std::isfinite(w) && std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  const float none = std::numeric_limits<float>::quiet_NaN();
  gimbal_.point(has_angles ? static_cast<float>(std::asin(sine)) : none, has_angles ? static_cast<float>(yaw) : none,
                wish.angular_velocity_y, wish.angular_velocity_z, wish.flags);
}

}  // namespace ponte::sim
