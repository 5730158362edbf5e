#include "ponte/sim/command.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <cmath>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

Command to_command(const messages::CommandLong& message) {
  return {.number = message.command,
          .param1 = message.param1,
          .param2 = message.param2,
          .param3 = message.param3,
          .param4 = message.param4,
          .x = message.param5,
          .y = message.param6,
          .z = message.param7};
}

/// Integers are 1e-7 degrees where the frame is a global one; elsewhere they are numbers.
Command to_command(const messages::CommandInt& message) {
  const bool is_local = message.frame == messages::MAV_FRAME_LOCAL_NED || message.frame == messages::MAV_FRAME_MISSION;
  const double unit = is_local ? 1 : 1e-7;
  return {.number = message.command,
          .param1 = message.param1,
          .param2 = message.param2,
          .param3 = message.param3,
          .param4 = message.param4,
          .x = message.x * unit,
          .y = message.y * unit,
          .z = message.z,
          .frame = message.frame};
}

std::optional<std::uint32_t> whole_number(float parameter, std::uint32_t most) {
  if (!(parameter >= 0) || double{parameter} > most || std::floor(parameter) != parameter) return std::nullopt;
  return static_cast<std::uint32_t>(parameter);
}

}  // namespace ponte::sim
