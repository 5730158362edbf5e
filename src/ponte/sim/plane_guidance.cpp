#include "ponte/sim/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

/// How a plane steers: courses that lead to a line or a circle, as in Beard and McLain, "Small Unmanned Aircraft"
/// (2012), chapter 10, and the bank that turns the course.
namespace ponte::sim {
namespace {

constexpr double turn_rate_per_course = 0.8;        // 1/s
constexpr double steepest_to_line = 1.0;            // rad: between the line and the course that leads back to it
constexpr double bend_to_line = 0.02;               // 1/m
constexpr double bend_to_circle = 2.0;              // per radius
constexpr double climb_per_height = 0.5;            // 1/s
constexpr double steepest_slope = 0.12;             // of a landing
constexpr double glide_ratio = 12.0;                // without the motor
constexpr double flare_height = 3.0;                // m
constexpr double flare_sink_rate = 0.6;             // m/s
constexpr double least_airspeed_of_approach = 1.3;  // times the least of all

}  // namespace

Plane::Demand Plane::demand(bool motor_runs) {
  const auto to_target = offset_between(known_position(), target_);
  if (goal_ == Goal::reach) {
    const auto line = offset_between(from_, target_);
    if (to_target.north * line.north + to_target.east * line.east <= 0) {
      goal_ = Goal::circle;
      radius_ = handling_.loiter_radius.value;
    }
  }
  Demand result{.airspeed = std::clamp(airspeed_wanted_, config_.least_airspeed.value, handling_.most_speed.value)};
  switch (goal_) {
    case Goal::circle: result.bank = bank_round_circle(); break;
    case Goal::take_off:
    case Goal::reach:
    case Goal::land: result.bank = bank_along_line(); break;
    case Goal::rest:
    case Goal::drift:
    case Goal::sink: break;
  }
  if (goal_ == Goal::land || goal_ == Goal::sink) {
    result.airspeed = config_.least_airspeed.value * least_airspeed_of_approach;
    result.climb = height() < flare_height ? -flare_sink_rate : climb_on_slope();
  } else {
    result.climb = climb_to_target();
  }
  if (motor_runs) return result;
  result.airspeed = config_.least_airspeed.value * least_airspeed_of_approach;
  result.climb = std::min(result.climb, height() < flare_height ? -flare_sink_rate : -result.airspeed / glide_ratio);
  return result;
}

/// Turns the course at this rate (rad/s, clockwise) once it is the right one.
double Plane::bank_for(double course_wanted, double turn_rate) const {
  const double rate = turn_rate_per_course * wrapped(course_wanted - course()) + turn_rate;
  const double bank = std::atan(horizontal(state_.velocity) * rate / standard_gravity);
  return std::clamp(bank, -config_.bank.value, config_.bank.value);
}

double Plane::bank_along_line() const {
  const auto line = offset_between(from_, target_);
  const double along = std::atan2(line.east, line.north);
  const auto here = offset_between(from_, known_position());
  const double to_the_right = here.east * std::cos(along) - here.north * std::sin(along);
  return bank_for(along - steepest_to_line * std::atan(bend_to_line * to_the_right) / (std::numbers::pi / 2), 0);
}

double Plane::bank_round_circle() const {
  const auto here = offset_between(target_, known_position());
  const double radius = std::abs(radius_);
  const double clockwise = radius_ < 0 ? -1 : 1;
  const double outside = (horizontal(here) - radius) / radius;
  const double bearing = std::atan2(here.east, here.north);
  const double inwards = std::atan(bend_to_circle * outside);
  const double share = std::max(0.0, 1 - std::abs(outside));  // far away the way there is straight
  return bank_for(bearing + clockwise * (std::numbers::pi / 2 + inwards),
                  clockwise * share * horizontal(state_.velocity) / radius);
}

double Plane::climb_to_target() const {
  const double above = (target_.altitude_msl - known_position().altitude_msl).value;
  return std::clamp(climb_per_height * above, -handling_.descent_rate.value, handling_.climb_rate.value);
}

/// Down the straight slope to the place.
double Plane::climb_on_slope() const {
  if (goal_ == Goal::sink) return -handling_.descent_rate.value / 2;
  const auto line = offset_between(from_, target_);
  const auto rest = offset_between(known_position(), target_);
  const double slope = std::min(line.down / std::max(horizontal(line), 1.0), steepest_slope);
  const double ahead = rest.north * line.north + rest.east * line.east;
  const double to_go = ahead > 0 ? horizontal(rest) : 0;
  const double above = ground_ + slope * to_go - known_position().altitude_msl.value;
  const double sinking = slope * horizontal(state_.velocity);
  return std::clamp(climb_per_height * above - sinking, -handling_.descent_rate.value, 0.0);
}

}  // namespace ponte::sim
