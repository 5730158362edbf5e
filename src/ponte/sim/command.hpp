#pragma once

#include "ponte/mavlink/autopilots/command_int.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"

#include <cstdint>
#include <optional>

namespace ponte::sim {

/// COMMAND_LONG or COMMAND_INT. A place is in degrees.
struct Command {
  std::uint16_t number{};
  float param1{};
  float param2{};
  float param3{};
  float param4{};
  double x{};                           ///< parameter 5: latitude, or a number
  double y{};                           ///< parameter 6: longitude, or a number
  float z{};                            ///< parameter 7: altitude, or a number
  std::optional<std::uint8_t> frame{};  ///< MAV_FRAME of a COMMAND_INT
};

[[nodiscard]] Command to_command(const mavlink::autopilots::CommandLong& message);
[[nodiscard]] Command to_command(const mavlink::autopilots::CommandInt& message);

/// The whole number that a parameter carries, from 0 to `most`, or nothing.
[[nodiscard]] std::optional<std::uint32_t> whole_number(float parameter, std::uint32_t most);

}  // namespace ponte::sim
