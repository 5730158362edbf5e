#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/mavlink/autopilots/command_int.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"

#include <cstdint>
#include <optional>

/// Commands, and the two messages that carry them.
namespace ponte::autopilot {

/// A command in the numbers of MAV_CMD, which says what its parameters mean.
struct Command {
  std::uint16_t number{};
  float param1{};
  float param2{};
  float param3{};
  float param4{};
  double x{};                           ///< parameter 5; with a frame the latitude in degrees
  double y{};                           ///< parameter 6; with a frame the longitude in degrees
  float z{};                            ///< parameter 7; with a frame the altitude in metres
  std::optional<std::uint8_t> frame{};  ///< MAV_FRAME of a place, a global one; nothing: 5 to 7 are numbers
  friend bool operator==(const Command&, const Command&) = default;
};

/// COMMAND_INT says which altitude is meant and has places to the centimetre; COMMAND_LONG has numbers with a fraction
/// and without a value (NaN) as parameters 5 and 6.
enum class Carrier : std::uint8_t { command_long, command_int };

/// COMMAND_INT for a place, COMMAND_LONG for numbers and for a place that is left open.
[[nodiscard]] Carrier carrier_for(const Command& command);

/// The command as the other carrier has it, or nothing if that would change what it means. COMMAND_LONG has no frame:
/// its altitude is above mean sea level. COMMAND_INT has only whole numbers.
[[nodiscard]] std::optional<Command> recast(const Command& command, Carrier carrier,
                                            std::optional<Metres> home_altitude_msl);

/// The same place with its altitude in the other of the two frames, above home and above mean sea level; nothing if it
/// has neither, or if the altitude of home is not known.
[[nodiscard]] std::optional<Command> reframed(const Command& command, std::optional<Metres> home_altitude_msl);

/// Whether this command, done twice, is the same as done once, as far as this is known: only such a command may be sent
/// again when no answer comes. What moves by a difference, toggles, counts, calibrates or starts anew is not.
[[nodiscard]] bool may_be_repeated(const Command& command, Stack stack);

/// As messages; the addressee is left to be filled in. `carrier` is `carrier_for` the command or what it was recast to.
[[nodiscard]] mavlink::autopilots::CommandLong to_command_long(const Command& command);
[[nodiscard]] mavlink::autopilots::CommandInt to_command_int(const Command& command);

}  // namespace ponte::autopilot
