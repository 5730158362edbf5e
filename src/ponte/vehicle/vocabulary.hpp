#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/core/text.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

/// What both worlds mean, in SI units and in no protocol's numbers.
namespace ponte::vehicle {

/// Who decides where the vehicle goes.
enum class ModeKind : std::uint8_t {
  none,     ///< initialising, or not known
  manual,   ///< a pilot's sticks
  mission,  ///< the uploaded mission
  hold,     ///< a position or circle is held
  guided,   ///< a station steers through the autopilot
  land,
  take_off,
  return_home,   ///< to launch or rally point
  smart_return,  ///< home along the path flown
  vtol_return,
  other,  ///< the autopilot's own; `variant` tells which
};

struct Mode {
  ModeKind kind{};
  std::uint8_t variant{};  ///< number of an `other` mode, unique per autopilot type
  Text<32> name;           ///< as the autopilot's users call it, e.g. "AUTO.LOITER"
  friend bool operator==(const Mode&, const Mode&) = default;
};

/// Where in its life cycle the vehicle is.
enum class Phase : std::uint8_t {
  unknown,
  power_up,    ///< booting or calibrating
  pre_start,   ///< disarmed on the ground
  pre_launch,  ///< armed on the ground
  taking_off,
  in_flight,
  landing,
  critical,  ///< in the air with a failsafe or emergency
};

enum class Subsystem : std::uint8_t {
  engine,
  mechanical,
  electrical,
  comms,
  propulsion_energy,
  navigation,
  payload,
  recovery,
  environmental,
  vsm,
};
inline constexpr std::size_t subsystem_count = 10;

enum class Condition : std::uint8_t { no_status, nominal, caution, warning, emergency, failed };

/// Something that an operator should read.
struct Alert {
  Condition severity{};  ///< `no_status` clears an alert of the same text class
  Subsystem subsystem{};
  Text<79> text;
  friend bool operator==(const Alert&, const Alert&) = default;
};

struct Waypoint {
  std::uint16_t number{};  ///< 1 to 65534, home is none
  std::optional<Radians> latitude{};
  std::optional<Radians> longitude{};
  std::optional<Metres> altitude_msl{};
  std::optional<WallTime> reached{};
  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

/// The leg of the mission that is being flown.
struct Leg {
  std::optional<Waypoint> from{};
  std::optional<Waypoint> to{};
  std::optional<Waypoint> next{};
  friend bool operator==(const Leg&, const Leg&) = default;
};

/// What the vehicle says it is.
struct Identity {
  std::uint8_t autopilot{};  ///< MAV_AUTOPILOT number, for the operator's information only
  std::uint8_t airframe{};   ///< MAV_TYPE number, likewise
  Text<15> serial;           ///< of the autopilot hardware; empty: not told
  friend bool operator==(const Identity&, const Identity&) = default;
};

/// "mission", "take_off", ... for logs and tables.
[[nodiscard]] std::string_view name_of(ModeKind kind);
[[nodiscard]] std::string_view name_of(Phase phase);
[[nodiscard]] std::string_view name_of(Subsystem subsystem);
[[nodiscard]] std::string_view name_of(Condition condition);

}  // namespace ponte::vehicle
