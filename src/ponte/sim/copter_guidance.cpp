#include "ponte/sim/copter.hpp"

#include <algorithm>
#include <cmath>

/// How a copter steers: the velocities that lead to a place, round it and down to it, and stops that are gentle.
namespace ponte::sim {
namespace {

constexpr double velocity_per_offset = 0.7;  // 1/s
constexpr double deceleration_share = 0.6;   // of the acceleration, so that a stop never asks for all of it
constexpr double nearly_stopped = 0.3;       // m/s
constexpr double stopping_speed = 1.0;       // m/s, at least, back to the place where it stops
constexpr double above_landing_place = 0.5;  // m
constexpr double smallest_circle = 0.01;     // m

/// The speed at which a stop at the end of this distance is still gentle: in proportion to the distance when near, by
/// constant deceleration when far.
double approach_speed(double distance, double limit, double deceleration) {
  const double near = deceleration / (velocity_per_offset * velocity_per_offset);
  const double speed =
      distance < near ? velocity_per_offset * distance : std::sqrt(2 * deceleration * (distance - near / 2));
  return std::min(speed, limit);
}

/// The distance whose `approach_speed` is this speed.
double stopping_distance(double speed, double deceleration) {
  const double near = deceleration / (velocity_per_offset * velocity_per_offset);
  if (speed < velocity_per_offset * near) return speed / velocity_per_offset;
  return speed * speed / (2 * deceleration) + near / 2;
}

}  // namespace

/// The target becomes the place where it can stand still soonest without haste.
void Copter::stop_at(Metres altitude_msl) {
  const double speed = horizontal(state_.velocity);
  const double distance = stopping_distance(speed, config_.acceleration.value * deceleration_share);
  const double seconds = speed > 0 ? distance / speed : 0;
  target_ = displaced(known_position(), {state_.velocity.north * seconds, state_.velocity.east * seconds, 0});
  target_.altitude_msl = altitude_msl;
  speed_limit_ = std::max(speed, stopping_speed);
}

Copter::Demand Copter::demand(const NorthEastDown& offset) {
  switch (goal_) {
    case Goal::rest: return {};
    case Goal::circle: return on_circle(offset);
    case Goal::move: return {.velocity = allowed(velocity_wanted_)};
    case Goal::drift:
    case Goal::sink: return {.velocity = {0, 0, wanted_sink_rate(offset)}};
    case Goal::reach:
    case Goal::land: break;
  }
  const double distance = horizontal(offset);
  const double speed = approach_speed(distance, std::min(speed_limit_, handling_.most_speed.value),
                                      config_.acceleration.value * deceleration_share);
  const double share = distance > 0 ? speed / distance : 0;
  return {.velocity = {offset.north * share, offset.east * share, wanted_sink_rate(offset)}};
}

/// Along the circle and towards it, no faster than its acceleration bends the way.
Copter::Demand Copter::on_circle(const NorthEastDown& offset) const {
  const double distance = horizontal(offset);
  const double radius = std::abs(radius_);
  const double most = std::min(speed_limit_, handling_.most_speed.value);
  const double speed = std::min(most, std::sqrt(config_.acceleration.value * deceleration_share * radius));
  const auto inwards =
      distance > 0 ? NorthEastDown{offset.north, offset.east, 0} * (1 / distance) : NorthEastDown{1, 0, 0};
  const double clockwise = radius_ < 0 ? -1 : 1;
  const NorthEastDown along{inwards.east * clockwise, -inwards.north * clockwise, 0};
  const double correction = std::clamp(velocity_per_offset * (distance - radius), -speed, speed);
  const double rest = std::sqrt(speed * speed - correction * correction);
  Demand result{.velocity = along * rest + inwards * correction,
                .acceleration = inwards * (rest * rest / std::max({distance, radius, smallest_circle}))};
  result.velocity.down = reaching_sink_rate(offset.down);
  return result;
}

double Copter::wanted_sink_rate(const NorthEastDown& offset) {
  if (goal_ != Goal::land && goal_ != Goal::sink) return reaching_sink_rate(offset.down);
  sinks_ = sinks_ || goal_ == Goal::sink ||
           (horizontal(offset) < above_landing_place && horizontal(state_.velocity) < nearly_stopped);
  if (!sinks_) return 0;
  const double above = state_.position.altitude_msl.value - ground_ - handling_.landing_height.value;
  const double deceleration = config_.vertical_acceleration.value * deceleration_share;
  const double rate = approach_speed(std::max(above, 0.0), handling_.descent_rate.value, deceleration);
  return std::max(rate, handling_.landing_rate.value);
}

double Copter::reaching_sink_rate(double offset_down) const {
  const double deceleration = config_.vertical_acceleration.value * deceleration_share;
  const auto climb_rate = takes_off_ ? handling_.take_off_rate : handling_.climb_rate;
  if (offset_down < 0) return -approach_speed(-offset_down, climb_rate.value, deceleration);
  return approach_speed(offset_down, handling_.descent_rate.value, deceleration);
}

}  // namespace ponte::sim
