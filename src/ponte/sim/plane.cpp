#include "ponte/sim/plane.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::sim {
namespace {

constexpr double dt = std::chrono::duration<double>{Airframe::step_length}.count();

constexpr double bank_per_error = 4.0;      // 1/s
constexpr double climb_lag = 0.8;           // s
constexpr double climb_acceleration = 3.0;  // m/s^2
constexpr double slowest_climb = 0.1;       // m/s, up and down
constexpr double speeding_up = 0.5;         // 1/s
constexpr double braking = 2.5;             // m/s^2, on the wheels
constexpr double take_off_margin = 1.1;     // times the least airspeed
constexpr double angle_of_attack = 0.035;   // rad, level and in cruise
constexpr double straight_ahead = 5000;     // m
constexpr double landing_slope = 0.1;       // where no place is given

constexpr double electronics_amperes = 0.4;
constexpr double cruise_amperes = 9.0;
constexpr double amperes_per_climb_rate = 1.7;  // A per m/s: two kilograms, at 11.7 V
constexpr double full_amperes = 30.0;

}  // namespace

Plane::Plane(const PlaneConfig& config, const Position& place, Radians heading)
    : config_{config}, ground_{place.altitude_msl.value}, battery_{config.battery}, target_{place}, from_{place} {
  handle({.cruise_speed = config.cruise_airspeed,
          .most_speed = config.most_airspeed,
          .climb_rate = config.climb_rate,
          .descent_rate = config.descent_rate,
          .loiter_radius = config.loiter_radius});
  state_.position = place;
  state_.attitude.heading = Radians{wrapped(heading.value)};
  state_.battery = battery_.state();
}

void Plane::arm() {
  if (state_.armed) return;
  state_.armed = true;
  goal_ = Goal::rest;
}

void Plane::disarm() {
  state_.armed = false;
  goal_ = Goal::rest;
}

void Plane::handle(const Handling& handling) {
  const auto& [least, most] = std::pair{config_.least_airspeed.value, config_.most_airspeed.value};
  handling_ = handling;
  handling_.cruise_speed.value = std::clamp(handling.cruise_speed.value, least, most);
  handling_.most_speed.value = std::clamp(handling.most_speed.value, least, most);
  handling_.climb_rate.value = std::clamp(handling.climb_rate.value, slowest_climb, config_.climb_rate.value);
  handling_.descent_rate.value = std::clamp(handling.descent_rate.value, slowest_climb, config_.descent_rate.value);
  if (handling.loiter_radius.value == 0) handling_.loiter_radius = config_.loiter_radius;
}

void Plane::begin(Goal goal) {
  PONTE_ASSERT(state_.armed);
  goal_ = goal;
  from_ = known_position();
  airspeed_wanted_ = handling_.cruise_speed.value;
}

double Plane::course() const { return std::atan2(state_.velocity.east, state_.velocity.north); }

void Plane::climb_to(Metres altitude_msl) {
  if (state_.airborne) {
    hold();
  } else {
    begin(Goal::take_off);
    const double heading = state_.attitude.heading.value;
    target_ = displaced(from_, {std::cos(heading) * straight_ahead, std::sin(heading) * straight_ahead, 0});
  }
  target_.altitude_msl = altitude_msl;
}

void Plane::fly_to(const Position& target, MetresPerSecond airspeed) {
  begin(Goal::reach);
  target_ = target;
  airspeed_wanted_ = airspeed.value;
}

void Plane::circle(const Position& centre, Metres radius, MetresPerSecond airspeed) {
  begin(Goal::circle);
  target_ = centre;
  radius_ = radius.value != 0 ? radius.value : handling_.loiter_radius.value;
  airspeed_wanted_ = airspeed.value;
}

void Plane::move(const NorthEastDown& /*velocity*/) { hold(); }

/// The circle begins here, to the right.
void Plane::hold() {
  if (!state_.airborne) {
    goal_ = Goal::rest;
    return;
  }
  begin(Goal::circle);
  radius_ = handling_.loiter_radius.value;
  target_ = displaced(from_, {-std::sin(course()) * radius_, std::cos(course()) * radius_, 0});
}

void Plane::drift() {
  if (!state_.airborne) {
    goal_ = Goal::rest;
    return;
  }
  begin(Goal::drift);
  target_ = from_;
}

void Plane::land(const std::optional<Position>& place) {
  if (!state_.airborne) return;
  begin(Goal::land);
  const double ahead = std::max(height(), 1.0) / landing_slope;
  target_ = place.value_or(displaced(from_, {std::cos(course()) * ahead, std::sin(course()) * ahead, 0}));
  target_.altitude_msl = Metres{ground_};
}

void Plane::sink() {
  if (!state_.airborne) return;
  begin(Goal::sink);
  target_ = from_;
}

/// Its nose is where its course and the wind have it.
void Plane::face(const Facing& /*facing*/) {}

void Plane::step(const Conditions& conditions) {
  const auto before = state_.attitude;
  const bool motor_runs = conditions.motors_run && state_.armed;
  state_.wind = conditions.wind;
  position_error_ = conditions.position_error;
  if (state_.airborne) {
    fly(demand(motor_runs));
    if (state_.position.altitude_msl.value <= ground_ && state_.velocity.down >= 0) touch_down();
  } else if (goal_ != Goal::rest || ground_speed_ > 0) {
    roll_on_ground(motor_runs);
  }
  state_.rates = body_rates(before, state_.attitude, dt);
  use_energy(motor_runs);
}

/// One step through the air, which moves with the wind. Turns are coordinated: what pulls round is the bank alone.
void Plane::fly(const Demand& demand) {
  auto& attitude = state_.attitude;
  const double roll_rate = config_.roll_rate.value;
  const double bank_change = std::clamp(bank_per_error * (demand.bank - attitude.roll.value), -roll_rate, roll_rate);
  attitude.roll = Radians{attitude.roll.value + bank_change * dt};

  const double acceleration = config_.acceleration.value;
  airspeed_ += std::clamp(speeding_up * (demand.airspeed - airspeed_), -acceleration, acceleration) * dt;
  climb_ += std::clamp((demand.climb - climb_) / climb_lag, -climb_acceleration, climb_acceleration) * dt;

  const double turn_rate = standard_gravity * std::tan(attitude.roll.value) / airspeed_;
  attitude.heading = Radians{wrapped(attitude.heading.value + turn_rate * dt)};
  const double rise = std::clamp(climb_ / airspeed_, -1.0, 1.0);
  const double ahead = airspeed_ * std::sqrt(1 - rise * rise);
  attitude.pitch = Radians{std::asin(rise) + angle_of_attack / std::cos(attitude.roll.value)};

  const double heading = attitude.heading.value;
  const auto velocity = NorthEastDown{std::cos(heading) * ahead, std::sin(heading) * ahead, -climb_} + state_.wind;
  state_.acceleration = (velocity - state_.velocity) * (1 / dt);
  state_.position = displaced(state_.position, (state_.velocity + velocity) * (dt / 2));
  state_.velocity = velocity;
}

/// One step on the wheels: faster until it flies, or slower until it stands.
void Plane::roll_on_ground(bool motor_runs) {
  const double heading = state_.attitude.heading.value;
  const NorthEastDown ahead{std::cos(heading), std::sin(heading), 0};
  const bool runs = goal_ == Goal::take_off && motor_runs;
  const double before = ground_speed_;
  ground_speed_ = std::max(0.0, ground_speed_ + (runs ? config_.acceleration.value : -braking) * dt);
  const auto velocity = ahead * ground_speed_;
  state_.acceleration = ahead * ((ground_speed_ - before) / dt);
  state_.position = displaced(state_.position, (state_.velocity + velocity) * (dt / 2));
  state_.velocity = velocity;
  airspeed_ = ground_speed_ - (state_.wind.north * ahead.north + state_.wind.east * ahead.east);
  if (!runs || airspeed_ < config_.least_airspeed.value * take_off_margin) return;
  state_.airborne = true;
  climb_ = 0;
}

/// What it has of speed goes into the wheels, along its nose.
void Plane::touch_down() {
  const double heading = state_.attitude.heading.value;
  ground_speed_ = std::max(0.0, state_.velocity.north * std::cos(heading) + state_.velocity.east * std::sin(heading));
  state_.airborne = false;
  state_.position.altitude_msl = Metres{ground_};
  state_.velocity = NorthEastDown{std::cos(heading), std::sin(heading), 0} * ground_speed_;
  state_.acceleration = {};
  state_.attitude = {Radians{}, Radians{}, state_.attitude.heading};
  climb_ = 0;
  goal_ = Goal::rest;
  target_ = state_.position;
}

/// Against the air by the cube of its speed, in turns by the load on the wings, and what it lifts.
void Plane::use_energy(bool motor_runs) {
  double amperes = electronics_amperes;
  state_.throttle = 0;
  if (motor_runs && (state_.airborne || goal_ == Goal::take_off)) {
    const double speed = airspeed_ / config_.cruise_airspeed.value;
    const double load = 1 / std::cos(state_.attitude.roll.value);
    const double motor = state_.airborne
                             ? cruise_amperes * speed * speed * speed * load + climb_ * amperes_per_climb_rate
                             : full_amperes;
    const double used = std::clamp(motor, 0.0, full_amperes);
    state_.throttle = used / full_amperes;
    amperes += used;
  }
  battery_.drain(amperes, dt);
  state_.battery = battery_.state();
}

}  // namespace ponte::sim
