#pragma once

#include "ponte/vehicle/mission.hpp"

#include <cmath>

namespace ponte::planning {

struct Wind {
  MetresPerSecond speed{};
  Radians from{};  ///< where it comes from, from north, clockwise
};

/// Over ground, of a vehicle with this airspeed that holds this course; 0 when the wind does not let it.
[[nodiscard]] inline MetresPerSecond ground_speed(MetresPerSecond airspeed, Radians course, const Wind& wind) {
  const auto angle = wind.from.value - course.value;
  const auto across = wind.speed.value * std::sin(angle);
  if (std::abs(across) >= airspeed.value) return MetresPerSecond{0};
  const auto along = std::sqrt(airspeed.value * airspeed.value - across * across) - wind.speed.value * std::cos(angle);
  return MetresPerSecond{std::max(along, 0.0)};
}

}  // namespace ponte::planning
