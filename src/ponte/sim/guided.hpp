#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/sim/geodesy.hpp"

#include <optional>

namespace ponte::sim {

/// What a station or a companion computer asks for in a guided mode (SET_POSITION_TARGET_*, DO_REPOSITION,
/// GUIDED_CHANGE_*), in the Earth's axes and SI units; what it leaves open is absent. A position comes before a
/// velocity.
struct GuidedTarget {
  std::optional<Position> position{};
  std::optional<NorthEastDown> velocity{};      ///< m/s over ground
  std::optional<Radians> heading{};             ///< where the nose points; copters only
  std::optional<RadiansPerSecond> turn_rate{};  ///< clockwise; copters only, and a heading comes before it
  std::optional<MetresPerSecond> speed{};       ///< on the way to the position
  std::optional<Metres>
      radius{};  ///< of a circle round the position, clockwise if positive; a plane has one of its own
  friend bool operator==(const GuidedTarget&, const GuidedTarget&) = default;
};

}  // namespace ponte::sim
