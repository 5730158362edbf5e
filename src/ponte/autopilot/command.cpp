#include "ponte/autopilot/command.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

constexpr double deg_e7 = 1e7;

bool is_above_sea(std::uint8_t frame) {
  return frame == messages::MAV_FRAME_GLOBAL || frame == messages::MAV_FRAME_GLOBAL_INT;
}

bool is_above_home(std::uint8_t frame) {
  return frame == messages::MAV_FRAME_GLOBAL_RELATIVE_ALT || frame == messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT;
}

bool is_whole(double number) {
  return std::floor(number) == number && std::abs(number) <= std::numeric_limits<std::int32_t>::max();
}

std::int32_t whole(double number) { return static_cast<std::int32_t>(std::llround(number)); }

}  // namespace

Carrier carrier_for(const Command& command) {
  const bool is_place = command.frame && std::isfinite(command.x) && std::isfinite(command.y);
  return is_place ? Carrier::command_int : Carrier::command_long;
}

std::optional<Command> recast(const Command& command, Carrier carrier, std::optional<Metres> home_altitude_msl) {
  if (carrier == Carrier::command_int) {
    if (command.frame || !is_whole(command.x) || !is_whole(command.y)) return std::nullopt;
    return command;
  }
  if (!command.frame) return command;
  if (!is_above_sea(*command.frame) && std::isfinite(command.z)) {
    const auto above_sea = is_above_home(*command.frame) ? reframed(command, home_altitude_msl) : std::nullopt;
    return above_sea;
  }
  return command;
}

std::optional<Command> reframed(const Command& command, std::optional<Metres> home_altitude_msl) {
  if (!command.frame || !home_altitude_msl) return std::nullopt;
  auto result = command;
  const auto home = static_cast<float>(home_altitude_msl->value);
  if (is_above_sea(*command.frame)) {
    result.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT;
    result.z -= home;
  } else if (is_above_home(*command.frame)) {
    result.frame = messages::MAV_FRAME_GLOBAL;
    result.z += home;
  } else {
    return std::nullopt;
  }
  return result;
}

bool may_be_repeated(const Command& command, Stack stack) {
  switch (command.number) {
    case messages::MAV_CMD_NAV_LOITER_UNLIM:
    case messages::MAV_CMD_NAV_RETURN_TO_LAUNCH:
    case messages::MAV_CMD_NAV_LAND:
    case messages::MAV_CMD_NAV_TAKEOFF:
    case messages::MAV_CMD_DO_ORBIT:
    case messages::MAV_CMD_DO_SET_MODE:
    case messages::MAV_CMD_DO_CHANGE_SPEED:
    case messages::MAV_CMD_DO_SET_RELAY:
    case messages::MAV_CMD_DO_SET_SERVO:
    case messages::MAV_CMD_DO_CHANGE_ALTITUDE:
    case messages::MAV_CMD_DO_REPOSITION:
    case messages::MAV_CMD_DO_PAUSE_CONTINUE:
    case messages::MAV_CMD_DO_SET_MISSION_CURRENT:
    case messages::MAV_CMD_DO_SET_ROI:
    case messages::MAV_CMD_DO_SET_ROI_LOCATION:
    case messages::MAV_CMD_DO_SET_ROI_NONE:
    case messages::MAV_CMD_DO_MOUNT_CONFIGURE:
    case messages::MAV_CMD_DO_MOUNT_CONTROL:
    case messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW:
    case messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE:
    case messages::MAV_CMD_DO_FENCE_ENABLE:
    case messages::MAV_CMD_RUN_PREARM_CHECKS:
    case messages::MAV_CMD_GET_HOME_POSITION:
    case messages::MAV_CMD_GET_MESSAGE_INTERVAL:
    case messages::MAV_CMD_SET_MESSAGE_INTERVAL:
    case messages::MAV_CMD_REQUEST_MESSAGE:
    case messages::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES:
    case messages::MAV_CMD_IMAGE_STOP_CAPTURE:
    case messages::MAV_CMD_VIDEO_STOP_CAPTURE: return true;
    case messages::MAV_CMD_COMPONENT_ARM_DISARM: return command.param2 == 0;  // not past the checks
    case messages::MAV_CMD_CONDITION_YAW: return command.param4 == 0;         // not by a difference
    case messages::MAV_CMD_DO_SET_HOME: return command.param1 != 1;           // not where it happens to be
    case messages::MAV_CMD_MISSION_START: return stack != Stack::px4;         // which begins anew
    default: return false;
  }
}

messages::CommandLong to_command_long(const Command& command) {
  return {.command = command.number,
          .param1 = command.param1,
          .param2 = command.param2,
          .param3 = command.param3,
          .param4 = command.param4,
          .param5 = static_cast<float>(command.x),
          .param6 = static_cast<float>(command.y),
          .param7 = command.z};
}

messages::CommandInt to_command_int(const Command& command) {
  const double unit = command.frame ? deg_e7 : 1;
  return {.frame = command.frame.value_or(messages::MAV_FRAME_MISSION),
          .command = command.number,
          .param1 = command.param1,
          .param2 = command.param2,
          .param3 = command.param3,
          .param4 = command.param4,
          .x = whole(command.x * unit),
          .y = whole(command.y * unit),
          .z = command.z};
}

}  // namespace ponte::autopilot
