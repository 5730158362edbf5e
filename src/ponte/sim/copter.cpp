#include "ponte/sim/copter.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::sim {
namespace {

constexpr double dt = std::chrono::duration<double>{Airframe::step_length}.count();

// How the flight controller answers to errors, and how fast the airframe follows it.
constexpr double acceleration_per_velocity = 3.0;  // 1/s
constexpr double thrust_lag = 0.12;                // s
constexpr double jerk_limit = 8.0;                 // m/s^3
constexpr double turn_rate_per_heading = 1.5;      // 1/s
constexpr double turn_acceleration = 2.0;          // rad/s^2
constexpr double turns_above = 0.3;                // m/s: slower, the heading stays
constexpr double turns_beyond = 2.0;               // m to the target: nearer, the heading stays
constexpr double hardest_landing = 3.0;            // m/s
constexpr double slowest = 0.1;                    // m/s: any rate and any speed

constexpr double drag = 0.25;  // 1/s: deceleration in m/s^2 per m/s of airspeed
constexpr double hover_throttle = 0.39;
constexpr double idle_throttle = 0.1;
constexpr double electronics_amperes = 0.4;
constexpr double idle_amperes = 1.5;
constexpr double hover_amperes = 18.0;
constexpr double amperes_per_climb_rate = 1.7;  // A per m/s: two kilograms, at 11.7 V

/// Its part over ground no longer than this.
NorthEastDown limited(const NorthEastDown& vector, double most) {
  const double size = horizontal(vector);
  const double scale = size > most ? most / size : 1;
  return {vector.north * scale, vector.east * scale, vector.down};
}

}  // namespace

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
  state_.armed = false;
  goal_ = Goal::rest;
}

void Copter::handle(const Handling& handling) {
  const auto within = [](MetresPerSecond wanted, MetresPerSecond able) {
    return MetresPerSecond{std::clamp(wanted.value, slowest, able.value)};
  };
  handling_ = handling;
  handling_.most_speed = within(handling.most_speed, config_.speed);
  handling_.climb_rate = within(handling.climb_rate, config_.climb_rate);
  handling_.take_off_rate = within(handling.take_off_rate, config_.climb_rate);
  handling_.descent_rate = within(handling.descent_rate, config_.descent_rate);
  handling_.landing_rate = within(handling.landing_rate, config_.descent_rate);
}

void Copter::begin(Goal goal) {
  PONTE_ASSERT(state_.armed);
  goal_ = goal;
  facing_ = {};
  takes_off_ = false;
  sinks_ = false;
}

void Copter::climb_to(Metres altitude_msl) {
  begin(Goal::reach);
  takes_off_ = !state_.airborne;
  stop_at(altitude_msl);
}

void Copter::fly_to(const Position& target, MetresPerSecond speed) {
  begin(Goal::reach);
  target_ = target;
  speed_limit_ = std::max(speed.value, slowest);
}

void Copter::circle(const Position& centre, Metres radius, MetresPerSecond speed) {
  begin(Goal::circle);
  target_ = centre;
  radius_ = radius.value;
  speed_limit_ = std::max(speed.value, slowest);
}

void Copter::move(const NorthEastDown& velocity) {
  begin(Goal::move);
  velocity_wanted_ = velocity;
  target_ = known_position();
}

void Copter::hold() {
  if (!state_.airborne) {
    goal_ = Goal::rest;
    return;
  }
  begin(Goal::reach);
  stop_at(known_position().altitude_msl);
}

void Copter::drift() {
  if (!state_.airborne) {
    goal_ = Goal::rest;
    return;
  }
  begin(Goal::drift);
  target_ = known_position();
}

void Copter::land(const std::optional<Position>& place) {
  if (!state_.airborne) return;
  begin(Goal::land);
  stop_at(known_position().altitude_msl);
  if (!place) return;
  const auto altitude = target_.altitude_msl;
  target_ = *place;
  target_.altitude_msl = altitude;
}

void Copter::sink() {
  if (!state_.airborne) return;
  begin(Goal::sink);
  target_ = known_position();
}

void Copter::face(const Facing& facing) { facing_ = facing; }

void Copter::step(const Conditions& conditions) {
  const auto before = state_.attitude;
  const bool motors_run = conditions.motors_run && state_.armed;
  state_.wind = conditions.wind;
  position_error_ = conditions.position_error;
  const auto offset = offset_between(known_position(), target_);
  const auto wanted = demand(offset);
  if (state_.airborne || (wanted.velocity.down < 0 && motors_run)) {
    state_.airborne = true;
    accelerate(wanted, motors_run);
    turn(offset);
    tilt(before);
    if (state_.position.altitude_msl.value <= ground_ && state_.velocity.down >= 0) touch_down();
  }
  use_energy();
}

/// No faster than its handling has it.
NorthEastDown Copter::allowed(const NorthEastDown& velocity) const {
  auto result = limited(velocity, handling_.most_speed.value);
  result.down = std::clamp(velocity.down, -handling_.climb_rate.value, handling_.descent_rate.value);
  return result;
}

/// One step of velocity and position. The thrust follows what is wanted with a lag, since the body has to tilt first;
/// it leans against the air only as far as the body may.
void Copter::accelerate(const Demand& demand, bool motors_run) {
  const auto resistance = (state_.velocity - state_.wind) * drag;
  NorthEastDown acceleration = resistance * -1;
  if (motors_run) {
    auto wanted = demand.acceleration + (demand.velocity - state_.velocity) * acceleration_per_velocity;
    wanted = limited(wanted, config_.acceleration.value);
    const double vertical = config_.vertical_acceleration.value;
    wanted.down = std::clamp(wanted.down, -vertical, vertical);
    wanted = wanted + resistance;
    wanted = holds_place() ? limited(wanted, standard_gravity * std::tan(config_.lean.value))
                           : NorthEastDown{0, 0, wanted.down};
    const auto change = (wanted - thrust_) * (dt / thrust_lag);
    const double most = jerk_limit * dt;
    thrust_.north += std::clamp(change.north, -most, most);
    thrust_.east += std::clamp(change.east, -most, most);
    thrust_.down += std::clamp(change.down, -most, most);
    acceleration = acceleration + thrust_;
  } else {
    thrust_ = {0, 0, standard_gravity};
    acceleration.down += standard_gravity;
  }
  const auto velocity = state_.velocity + acceleration * dt;
  state_.position = displaced(state_.position, (state_.velocity + velocity) * (dt / 2));
  state_.velocity = velocity;
  state_.acceleration = acceleration;
}

/// One step of the heading: towards the target, unless it was told otherwise.
void Copter::turn(const NorthEastDown& offset) {
  const double heading = state_.attitude.heading.value;
  const double limit = config_.turn_rate.value;
  if (facing_.heading) {
    heading_wanted_ = facing_.heading->value;
  } else if (facing_.turn_rate) {
    heading_wanted_ = heading;
  } else if (goal_ == Goal::move && horizontal(velocity_wanted_) > turns_above) {
    heading_wanted_ = std::atan2(velocity_wanted_.east, velocity_wanted_.north);
  } else if (holds_place() && horizontal(offset) > turns_beyond) {
    heading_wanted_ = std::atan2(offset.east, offset.north);
  }
  const double rate = !facing_.heading && facing_.turn_rate
                          ? facing_.turn_rate->value
                          : turn_rate_per_heading * wrapped(heading_wanted_ - heading);
  const double wanted = std::clamp(rate, -limit, limit);
  turn_rate_ += std::clamp(wanted - turn_rate_, -turn_acceleration * dt, turn_acceleration * dt);
  state_.attitude.heading = Radians{wrapped(heading + turn_rate_ * dt)};
}

/// The rotors push against the weight, beside their thrust.
void Copter::tilt(const Attitude& before) {
  const auto thrust = thrust_ - NorthEastDown{0, 0, standard_gravity};
  const double size = std::sqrt(thrust.north * thrust.north + thrust.east * thrust.east + thrust.down * thrust.down);
  if (size > 0) state_.attitude = attitude_for_thrust(thrust, state_.attitude.heading);
  state_.rates = body_rates(before, state_.attitude, dt);
  state_.throttle = std::min(1.0, hover_throttle * size / standard_gravity);
}

void Copter::touch_down() {
  state_.crashed = state_.velocity.down > hardest_landing;
  state_.airborne = false;
  state_.position.altitude_msl = Metres{ground_};
  state_.velocity = {};
  state_.acceleration = {};
  state_.attitude = {Radians{}, Radians{}, state_.attitude.heading};
  state_.rates = {};
  thrust_ = {};
  heading_wanted_ = state_.attitude.heading.value;
  turn_rate_ = 0;
  goal_ = Goal::rest;
  target_ = state_.position;
}

/// Hovering by the thrust's power law, and climbing by the weight that is lifted.
void Copter::use_energy() {
  double amperes = electronics_amperes;
  if (!state_.airborne) {
    state_.throttle = state_.armed ? idle_throttle : 0;
    if (state_.armed) amperes += idle_amperes;
  } else {
    const double load = state_.throttle / hover_throttle;
    const double lifting = -state_.velocity.down * amperes_per_climb_rate;
    amperes += std::max(0.0, hover_amperes * load * std::sqrt(load) + lifting);
  }
  battery_.drain(amperes, dt);
  state_.battery = battery_.state();
}

}  // namespace ponte::sim
