#pragma once

#include "ponte/autopilot/command.hpp"
#include "ponte/core/quantity.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// A height, and what it counts from.
struct Height {
  Metres value{};
  enum class Above : std::uint8_t { home, sea } above{};
};

/// Where to fly, or to look.
struct Target {
  Radians latitude{};
  Radians longitude{};
  Height height{};
};

/// Whether it is a place on Earth.
[[nodiscard]] bool is_valid(const Target& target);
/// The same place with its height above mean sea level; nothing if that of home, which it counts from, is not known.
[[nodiscard]] std::optional<Target> above_sea(const Target& target, std::optional<Metres> home_altitude_msl);
/// Makes it the place of the command, with its frame.
void set_place(Command& command, const Target& target);

}  // namespace ponte::autopilot
