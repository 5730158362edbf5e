#include "ponte/sim/attitude.hpp"

#include "ponte/core/degrees.hpp"

#include <cmath>

namespace ponte::sim {

BodyVector to_body(const Attitude& attitude, const NorthEastDown& vector) {
  const double cos_heading = std::cos(attitude.heading.value);
  const double sin_heading = std::sin(attitude.heading.value);
  const double ahead = vector.north * cos_heading + vector.east * sin_heading;
  const double right = vector.east * cos_heading - vector.north * sin_heading;

  const double cos_pitch = std::cos(attitude.pitch.value);
  const double sin_pitch = std::sin(attitude.pitch.value);
  const double x = ahead * cos_pitch - vector.down * sin_pitch;
  const double below = ahead * sin_pitch + vector.down * cos_pitch;

  const double cos_roll = std::cos(attitude.roll.value);
  const double sin_roll = std::sin(attitude.roll.value);
  return {x, right * cos_roll + below * sin_roll, below * cos_roll - right * sin_roll};
}

Attitude attitude_for_thrust(const NorthEastDown& thrust, Radians heading) {
  const double cos_heading = std::cos(heading.value);
  const double sin_heading = std::sin(heading.value);
  const double ahead = thrust.north * cos_heading + thrust.east * sin_heading;
  const double right = thrust.east * cos_heading - thrust.north * sin_heading;
  const double up = -thrust.down;
  return {Radians{std::atan2(right, std::sqrt(ahead * ahead + up * up))}, Radians{std::atan2(-ahead, up)}, heading};
}

Radians heading_after_turn(Radians heading, double degrees, double side, bool is_relative) {
  const double angle = radians_from_degrees(degrees).value;
  return Radians{wrapped(is_relative ? heading.value + (side < 0 ? -angle : angle) : angle)};
}

BodyVector body_rates(const Attitude& before, const Attitude& after, double seconds) {
  const double roll_rate = wrapped(after.roll.value - before.roll.value) / seconds;
  const double pitch_rate = wrapped(after.pitch.value - before.pitch.value) / seconds;
  const double turn_rate = wrapped(after.heading.value - before.heading.value) / seconds;
  const double roll = (before.roll.value + after.roll.value) / 2;
  const double pitch = (before.pitch.value + after.pitch.value) / 2;
  return {roll_rate - turn_rate * std::sin(pitch),
          pitch_rate * std::cos(roll) + turn_rate * std::sin(roll) * std::cos(pitch),
          turn_rate * std::cos(roll) * std::cos(pitch) - pitch_rate * std::sin(roll)};
}

}  // namespace ponte::sim
