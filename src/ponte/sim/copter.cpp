#include "ponte/sim/copter.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::sim {
namespace {

constexpr double dt = std::chrono::duration<double>{Copter::step_length}.count();

// How the flight controller answers to errors, and how fast the airframe follows it.
constexpr double velocity_per_offset = 0.7;        // 1/s
constexpr double acceleration_per_velocity = 3.0;  // 1/s
constexpr double acceleration_lag = 0.12;          // s
constexpr double jerk_limit = 8.0;                 // m/s^3
constexpr double turn_rate_per_heading = 1.5;      // 1/s
constexpr double turn_acceleration = 2.0;          // rad/s^2
constexpr double deceleration_share = 0.6;         // of the acceleration, so that a stop never asks for all of it
constexpr double nearly_stopped = 0.3;             // m/s
constexpr double turns_beyond = 2.0;               // m to the target: nearer, the heading stays
constexpr double final_descent_height = 10.0;      // m

constexpr double drag = 0.25;  // 1/s: deceleration in m/s^2 per m/s of airspeed
constexpr double hover_throttle = 0.39;
constexpr double idle_throttle = 0.1;
constexpr double electronics_amperes = 0.4;
constexpr double idle_amperes = 1.5;
constexpr double hover_amperes = 18.0;

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

BodyVector specific_force(const CopterState& state) {
  return to_body(state.attitude, state.acceleration - NorthEastDown{0, 0, standard_gravity});
}

Copter::Copter(const CopterConfig& config, const Position& place, Radians heading)
    : config_{config}, ground_{place.altitude_msl.value}, battery_{config.battery}, target_{place} {
  state_.position = place;
  state_.attitude.heading = Radians{wrapped(heading.value)};
  heading_wanted_ = state_.attitude.heading.value;
  state_.battery = battery_.state();
}

void Copter::arm() {
  if (state_.armed) return;
  state_.armed = true;
  goal_ = Goal::rest;
}

void Copter::disarm() {
  PONTE_ASSERT(!state_.airborne);
  state_.armed = false;
  goal_ = Goal::rest;
}

void Copter::climb_to(Metres altitude_msl) {
  PONTE_ASSERT(state_.armed);
  stop_at(altitude_msl);
  goal_ = Goal::reach;
}

void Copter::fly_to(const Position& target, MetresPerSecond speed) {
  PONTE_ASSERT(state_.armed);
  goal_ = Goal::reach;
  target_ = target;
  speed_limit_ = speed.value;
}

void Copter::hold() {
  if (!state_.airborne) {
    goal_ = Goal::rest;
    return;
  }
  stop_at(state_.position.altitude_msl);
  goal_ = Goal::reach;
}

void Copter::land() {
  if (!state_.airborne) return;
  stop_at(state_.position.altitude_msl);
  goal_ = Goal::land;
}

/// The target becomes the place where it can stand still soonest without haste.
void Copter::stop_at(Metres altitude_msl) {
  const double speed = horizontal(state_.velocity);
  const double distance = stopping_distance(speed, config_.acceleration.value * deceleration_share);
  const double seconds = speed > 0 ? distance / speed : 0;
  target_ = displaced(state_.position, {state_.velocity.north * seconds, state_.velocity.east * seconds, 0});
  target_.altitude_msl = altitude_msl;
  speed_limit_ = std::max(speed, 1.0);
}

void Copter::step() {
  const auto before = state_.attitude;
  const auto offset = offset_between(state_.position, target_);
  const auto wanted = goal_ == Goal::rest ? NorthEastDown{} : wanted_velocity(offset);
  if (state_.airborne || wanted.down < 0) {
    state_.airborne = true;
    accelerate(wanted);
    turn(offset);
    tilt(before);
    if (state_.position.altitude_msl.value <= ground_ && state_.velocity.down >= 0) touch_down();
  }
  use_energy();
}

NorthEastDown Copter::wanted_velocity(const NorthEastDown& offset) const {
  const double distance = horizontal(offset);
  const double speed = approach_speed(distance, speed_limit_, config_.acceleration.value * deceleration_share);
  const double share = distance > 0 ? speed / distance : 0;
  return {offset.north * share, offset.east * share, wanted_sink_rate(offset.down)};
}

double Copter::wanted_sink_rate(double offset_down) const {
  const double deceleration = config_.vertical_acceleration.value * deceleration_share;
  if (goal_ == Goal::land) {
    if (horizontal(state_.velocity) > nearly_stopped) return 0;
    const double above = state_.position.altitude_msl.value - ground_ - final_descent_height;
    const double rate = approach_speed(std::max(above, 0.0), config_.descent_rate.value, deceleration);
    return std::max(rate, config_.landing_rate.value);
  }
  if (offset_down < 0) return -approach_speed(-offset_down, config_.climb_rate.value, deceleration);
  return approach_speed(offset_down, config_.descent_rate.value, deceleration);
}

/// One step of velocity and position. The acceleration follows what is wanted with a lag, since the body has to tilt
/// first.
void Copter::accelerate(const NorthEastDown& wanted) {
  auto demand = (wanted - state_.velocity) * acceleration_per_velocity;
  const double size = horizontal(demand);
  const double scale = size > config_.acceleration.value ? config_.acceleration.value / size : 1;
  const double vertical = config_.vertical_acceleration.value;
  demand = {demand.north * scale, demand.east * scale, std::clamp(demand.down, -vertical, vertical)};

  auto& acceleration = state_.acceleration;
  const auto change = (demand - acceleration) * (dt / acceleration_lag);
  const double most = jerk_limit * dt;
  acceleration.north += std::clamp(change.north, -most, most);
  acceleration.east += std::clamp(change.east, -most, most);
  acceleration.down += std::clamp(change.down, -most, most);

  const auto velocity = state_.velocity + acceleration * dt;
  state_.position = displaced(state_.position, (state_.velocity + velocity) * (dt / 2));
  state_.velocity = velocity;
}

/// One step of the heading, towards the target.
void Copter::turn(const NorthEastDown& offset) {
  if (horizontal(offset) > turns_beyond) heading_wanted_ = std::atan2(offset.east, offset.north);
  const double heading = state_.attitude.heading.value;
  const double limit = config_.turn_rate.value;
  const double wanted = std::clamp(turn_rate_per_heading * wrapped(heading_wanted_ - heading), -limit, limit);
  turn_rate_ += std::clamp(wanted - turn_rate_, -turn_acceleration * dt, turn_acceleration * dt);
  state_.attitude.heading = Radians{wrapped(heading + turn_rate_ * dt)};
}

/// The rotors have to push against gravity and drag, and give the acceleration.
void Copter::tilt(const Attitude& before) {
  const auto thrust = state_.acceleration + state_.velocity * drag - NorthEastDown{0, 0, standard_gravity};
  state_.attitude = attitude_for_thrust(thrust, state_.attitude.heading);
  state_.rates = body_rates(before, state_.attitude, dt);
  const double size = std::sqrt(thrust.north * thrust.north + thrust.east * thrust.east + thrust.down * thrust.down);
  state_.throttle = std::min(1.0, hover_throttle * size / standard_gravity);
}

void Copter::touch_down() {
  state_.airborne = false;
  state_.position.altitude_msl = Metres{ground_};
  state_.velocity = {};
  state_.acceleration = {};
  state_.attitude = {Radians{}, Radians{}, state_.attitude.heading};
  state_.rates = {};
  heading_wanted_ = state_.attitude.heading.value;
  turn_rate_ = 0;
  goal_ = Goal::rest;
  target_ = state_.position;
}

void Copter::use_energy() {
  double amperes = electronics_amperes;
  if (!state_.airborne) {
    state_.throttle = state_.armed ? idle_throttle : 0;
    if (state_.armed) amperes += idle_amperes;
  } else {
    const double load = state_.throttle / hover_throttle;
    amperes += hover_amperes * load * std::sqrt(load);
  }
  battery_.drain(amperes, dt);
  state_.battery = battery_.state();
}

}  // namespace ponte::sim
