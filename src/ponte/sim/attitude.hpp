#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/sim/geodesy.hpp"

namespace ponte::sim {

inline constexpr double standard_gravity = 9.80665;  ///< m/s^2

/// A vector along the axes of the body: nose, right side, belly.
struct BodyVector {
  double x{};
  double y{};
  double z{};
  friend bool operator==(const BodyVector&, const BodyVector&) = default;
};

/// How the body lies in the Earth's axes: turned by heading, then pitch (nose up), then roll (right side down).
struct Attitude {
  Radians roll{};
  Radians pitch{};
  Radians heading{};  ///< -pi to pi
  friend bool operator==(const Attitude&, const Attitude&) = default;
};

/// The same vector, along the body's axes.
[[nodiscard]] BodyVector to_body(const Attitude& attitude, const NorthEastDown& vector);

/// How a body with this heading has to lie for its rotors, which push along its z axis alone, to push in this
/// direction.
[[nodiscard]] Attitude attitude_for_thrust(const NorthEastDown& thrust, Radians heading);

/// The heading that CONDITION_YAW asks for: an angle in degrees from north, or, if it is relative, from where the nose
/// points to the left (`side` is negative) or the right.
[[nodiscard]] Radians heading_after_turn(Radians heading, double degrees, double side, bool is_relative);

/// Angular rates (rad/s) about the body's axes that turn `before` into `after`, a short time later.
[[nodiscard]] BodyVector body_rates(const Attitude& before, const Attitude& after, double seconds);

}  // namespace ponte::sim
