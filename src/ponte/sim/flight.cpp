#include "ponte/sim/flight.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

using enum FlightMode;

constexpr Metres highest_take_off{1000};       // above home
constexpr double arrived_within = 1.0;         // m over ground: a corner of the square
constexpr double at_altitude_within = 0.3;     // m
constexpr double plane_altitude_within = 2.0;  // m

FlightMode first_mode(VehicleKind kind) {
  if (kind.personality == Personality::px4) return loiter;
  return kind.type == AirframeType::plane ? manual : stabilize;
}

}  // namespace

Flight::Flight(VehicleKind kind, const FlightSettings& settings, bool flies_square, const SquareConfig& square)
    : kind_{kind},
      settings_{settings},
      flies_square_{flies_square},
      square_{square},
      height_{square.height},
      mode_{first_mode(kind)} {}

bool Flight::enter(FlightMode mode, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  if (mode == mode_) return true;
  const auto flight = context(now, airframe, facts);
  if (!may_enter(mode, flight)) return false;
  change_mode(mode, flight);
  return true;
}

void Flight::restart(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  begin(context(now, airframe, facts));
}

bool Flight::may_enter(FlightMode mode, const FlightContext& flight) const {
  if (!has_mode(kind_, mode)) return false;
  const bool is_offboard = flight.is_px4() && mode == guided;
  if (is_offboard && !guided_.is_fresh(flight)) return false;
  const auto& state = flight.airframe.state();
  if (!state.armed && !flight.is_px4()) return true;
  if (mode == automatic && !mission_.has_items()) return false;
  return !state.armed || has_position_ || !flight_mode_info(kind_, mode).needs_position;
}

void Flight::change_mode(FlightMode mode, const FlightContext& flight) {
  mode_ = mode;
  begin(flight);
}

/// What a mode does first.
void Flight::begin(const FlightContext& flight) {
  auto& airframe = flight.airframe;
  const auto& state = airframe.state();
  leg_ = Leg::none;
  speed_.reset();
  mission_may_begin_ = settings_.mode_takes_off;
  if (!state.armed) return;
  if (!state.airborne) airframe.hold();  // a take-off that has not begun yet
  switch (mode_) {
    case automatic:
      if (state.airborne || mission_may_begin_) begin_mission(flight);
      return;
    case FlightMode::take_off: return climb(settings_.take_off_height, flight);
    case guided:
      if (flight.is_px4()) {
        leg_ = Leg::guided;  // what has come so far is in force
        return;
      }
      guided_.begin();
      if (!state.airborne) return;
      leg_ = flies_square_ ? Leg::square : Leg::guided;
      return airframe.hold();
    default: break;
  }
  if (!state.airborne) return;
  switch (mode_) {
    case rtl: leg_ = Leg::home; return return_.begin(flight);
    case land: leg_ = Leg::land; return land_here(flight);
    case circle: {
      const double heading = state.attitude.heading.value;
      const double radius = settings_.handling.loiter_radius.value;
      const NorthEastDown ahead{std::cos(heading) * radius, std::sin(heading) * radius, 0};
      return airframe.circle(displaced(airframe.known_position(), ahead), Metres{radius},
                             settings_.handling.cruise_speed);
    }
    case manual:
    case stabilize:
    case altitude_hold: return airframe.drift();
    default: return airframe.hold();
  }
}

void Flight::begin_mission(const FlightContext& flight) {
  leg_ = Leg::mission;
  if (flight.is_px4()) flight.facts.push(notice(messages::MAV_SEVERITY_INFO, "Executing Mission\t"));
  mission_.begin(flight);
}

void Flight::climb(Metres height, const FlightContext& flight) {
  leg_ = Leg::take_off;
  height_ = height;
  flight.airframe.climb_to(home_.altitude_msl + height);
}

void Flight::on_armed(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  airframe.handle(settings_.handling);
  idle_since_ = now;
  was_airborne_ = false;
  has_landed_ = false;
  corner_ = 0;
  height_ = square_.height;
  if (flies_square_ && !flight.is_px4() && !flight.is_plane()) mode_ = guided;
  begin(flight);
}

void Flight::on_disarmed() {
  leg_ = Leg::none;
  if (kind_.personality == Personality::ardupilot) mission_.rewind();
}

bool Flight::take_off(Metres height, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  const auto& state = airframe.state();
  if (!state.armed || state.airborne || height <= Metres{} || height > highest_take_off) return false;
  if (!flight.is_px4() && (mode_ != guided || flight.is_plane())) return false;
  if (flight.is_px4()) mode_ = FlightMode::take_off;
  climb(height, flight);
  return true;
}

bool Flight::start_mission(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  if (!airframe.state().armed || !mission_.has_items()) return false;
  if (mode_ != automatic && !may_enter(automatic, flight)) return false;
  if (mode_ != automatic) change_mode(automatic, flight);
  if (leg_ != Leg::mission) begin_mission(flight);
  return true;
}

bool Flight::set_current_item(std::uint16_t item, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  return mission_.set_current(item, leg_ == Leg::mission, context(now, airframe, facts));
}

bool Flight::pause_mission(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  return leg_ == Leg::mission && mission_.pause(context(now, airframe, facts));
}

bool Flight::continue_mission(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  return leg_ == Leg::mission && mission_.go_on(context(now, airframe, facts));
}

bool Flight::guide(const GuidedTarget& target, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  const auto& state = airframe.state();
  if (flight.is_px4() && mode_ != guided) {
    guided_.remember(target, flight);
    return true;
  }
  if (mode_ != guided || !state.armed || (!state.airborne && !flight.is_px4())) return false;
  if (leg_ == Leg::take_off) return false;
  leg_ = Leg::guided;
  guided_.take(target, speed_.value_or(settings_.handling.cruise_speed), flight);
  return true;
}

bool Flight::reposition(const GuidedTarget& target, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  return lead(target, flight.is_px4() ? loiter : guided, flight);
}

bool Flight::orbit(const GuidedTarget& target, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  return lead(target, circle, context(now, airframe, facts));
}

bool Flight::lead(const GuidedTarget& target, FlightMode mode, const FlightContext& flight) {
  const auto& airframe = flight.airframe;
  if (!airframe.state().airborne || !airframe.state().armed) return false;
  if (mode_ != mode && !may_enter(mode, flight)) return false;
  if (mode_ != mode) change_mode(mode, flight);
  leg_ = Leg::guided;
  guided_.take(target, speed_.value_or(settings_.handling.cruise_speed), flight);
  return true;
}

void Flight::change_speed(MetresPerSecond speed, Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  speed_ = speed;
  if (leg_ == Leg::mission) mission_.set_speed(speed, flight);
  if (leg_ == Leg::guided) guided_.set_speed(speed, flight);
}

void Flight::step(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) {
  const auto flight = context(now, airframe, facts);
  const auto& state = airframe.state();
  airframe.handle(settings_.handling);
  if (!state.armed) {
    leg_ = Leg::none;
    was_airborne_ = false;
    return;
  }
  if (state.airborne != was_airborne_) on_ground_left_or_reached(flight);
  if (!state.armed) return;
  const bool flies_mission = leg_ == Leg::mission && !mission_.is_finished();
  if (state.airborne || leg_ == Leg::take_off || flies_mission || (leg_ == Leg::guided && flight.is_px4()))
    fly(flight);
  else
    wait_on_ground(flight);
  give_up_take_off(flight);
}

void Flight::fly(const FlightContext& flight) {
  switch (leg_) {
    case Leg::take_off: {
      const double above = flight.offset_to(home_).down - height_.value;
      const bool is_there = flight.is_plane() ? above > -plane_altitude_within : std::abs(above) < at_altitude_within;
      if (is_there) on_taken_off(flight);
      return;
    }
    case Leg::square: return fly_square(flight);
    case Leg::guided:
      guided_.step(flight);
      if (flight.is_px4() && mode_ == guided && !guided_.is_fresh(flight))
        change_mode(may_enter(settings_.offboard_lost, flight) ? settings_.offboard_lost : land, flight);
      return;
    case Leg::mission:
      mission_.step(flight);
      if (mission_.wants_return()) change_mode(rtl, flight);
      return;
    case Leg::home: return return_.step(flight);
    case Leg::land:
      if (lands_blindly_ == has_position_) land_here(flight);
      return;
    case Leg::none: return;
  }
}

void Flight::land_here(const FlightContext& flight) {
  lands_blindly_ = !has_position_;
  if (has_position_)
    flight.airframe.land(std::nullopt);
  else
    flight.airframe.sink();
}

void Flight::on_taken_off(const FlightContext& flight) {
  if (flight.is_px4()) change_mode(loiter, flight);
  leg_ = flies_square_ && mode_ == guided ? Leg::square : Leg::guided;
  flight.airframe.climb_to(home_.altitude_msl + height_);
}

void Flight::fly_square(const FlightContext& flight) {
  constexpr std::array<NorthEastDown, 4> corners{{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}};
  auto corner = displaced(home_, corners[corner_] * square_.side.value);
  corner.altitude_msl = home_.altitude_msl + height_;
  flight.airframe.fly_to(corner, square_.speed);
  if (horizontal(flight.offset_to(corner)) < arrived_within)
    corner_ = static_cast<std::uint8_t>((corner_ + 1) % corners.size());
}

LandedState Flight::landed_state(const AirframeState& state) const {
  if (!state.airborne) return LandedState::on_ground;
  if (leg_ == Leg::take_off || (leg_ == Leg::mission && mission_.is_taking_off())) return LandedState::taking_off;
  const bool lands = leg_ == Leg::land || (leg_ == Leg::home && return_.is_landing()) ||
                     (leg_ == Leg::mission && mission_.is_landing());
  return lands ? LandedState::landing : LandedState::in_air;
}

std::optional<Position> Flight::target(const Airframe& airframe) const {
  if (landed_state(airframe.state()) == LandedState::landing || !airframe.state().airborne) return std::nullopt;
  if (leg_ == Leg::none || leg_ == Leg::land) return std::nullopt;
  return airframe.target();
}

}  // namespace ponte::sim
