#include "ponte/sim/mission_flight.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/seconds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr double altitude_within = 0.8;        // m: a copter is at the altitude of its waypoint
constexpr double take_off_within = 0.3;        // m: a copter has taken off
constexpr double plane_altitude_within = 2.0;  // m
constexpr double on_circle_within = 0.2;       // of the radius
constexpr int most_items_at_once = 1000;       // that are no flight: more is a mission that jumps in a circle

}  // namespace

void MissionFlight::set_items(std::span<const MissionItem> items, Personality personality) {
  items_ = items;
  first_ = personality == Personality::ardupilot ? 1 : 0;
  if (current_ >= items_.size() || leg_ == Leg::none) rewind();
}

void MissionFlight::rewind() {
  leg_ = Leg::none;
  current_ = static_cast<std::uint16_t>(has_items() ? first_ : 0);
  finished_ = false;
  paused_ = false;
  speed_.reset();
  jumps_.clear();
  pending_.clear();
  held_until_.reset();
  held_beyond_m_.reset();
  region_of_interest_.reset();
  heading_.reset();
}

void MissionFlight::begin(const FlightContext& flight) {
  if (finished_) rewind();
  advance(has_items() ? current_ : items_.size(), flight);
}

bool MissionFlight::set_current(std::uint16_t item, bool is_active, const FlightContext& flight) {
  if (item >= items_.size()) return false;
  finished_ = false;
  current_ = item;
  if (is_active) advance(std::max<std::size_t>(item, first_), flight);
  return true;
}

void MissionFlight::set_speed(MetresPerSecond speed, const FlightContext& flight) {
  speed_ = speed;
  if (leg_ == Leg::travel && !arrived_at_ && !paused_) travel(items_[current_], flight);
}

bool MissionFlight::pause(const FlightContext& flight) {
  if (leg_ != Leg::travel || arrived_at_) return false;
  paused_ = true;
  flight.airframe.hold();
  return true;
}

bool MissionFlight::go_on(const FlightContext& flight) {
  if (leg_ != Leg::travel || arrived_at_) return false;
  paused_ = false;
  travel(items_[current_], flight);
  return true;
}

bool MissionFlight::is_landing() const { return leg_ == Leg::land || (leg_ == Leg::home && return_.is_landing()); }

/// To the next item that is flown, from this one on. What is to be done on the way there waits for `act`.
void MissionFlight::advance(std::size_t from, const FlightContext& flight) {
  pending_.clear();
  held_until_.reset();
  held_beyond_m_.reset();
  heading_.reset();
  auto item = from;
  for (int count = 0; item < items_.size() && count < most_items_at_once; ++count) {
    if (is_navigation(items_[item])) return start(item, flight);
    if (items_[item].command == messages::MAV_CMD_DO_JUMP) {
      item = after_jump(item);
      continue;
    }
    if (pending_.size() < most_pending) pending_.push_back(static_cast<std::uint16_t>(item));
    ++item;
  }
  finish(flight);
}

/// A jump is made as often as its second parameter says, for ever if that is negative.
std::size_t MissionFlight::after_jump(std::size_t item) {
  const auto& [target, times] = std::pair{items_[item].param1, items_[item].param2};
  if (!(target >= 0) || !(double{target} < static_cast<double>(items_.size())) || std::isnan(times)) return item + 1;
  const auto destination = std::max(static_cast<std::size_t>(target), first_);
  if (times < 0) return destination;
  auto jump = std::ranges::find(jumps_, item, &Jump::item);
  if (jump == jumps_.end()) {
    if (jumps_.size() == most_jumps) return item + 1;
    jump = jumps_.insert(jump, {static_cast<std::uint16_t>(item), 0});
  }
  if (static_cast<float>(jump->done) >= times) return item + 1;
  ++jump->done;
  return destination;
}

void MissionFlight::start(std::size_t item, const FlightContext& flight) {
  current_ = static_cast<std::uint16_t>(item);
  arrived_at_.reset();
  wait_ = {};
  paused_ = false;
  if (!flight.is_px4())
    flight.facts.push(
        notice(messages::MAV_SEVERITY_INFO, "Mission: {} {}", current_, short_name(items_[item].command)));
  start_leg(items_[item], flight);
}

void MissionFlight::start_leg(const MissionItem& item, const FlightContext& flight) {
  auto& airframe = flight.airframe;
  from_ = airframe.known_position();
  const auto place = place_of(item, flight.home);
  place_ = place.value_or(from_);
  switch (item.command) {
    case messages::MAV_CMD_NAV_TAKEOFF:
      leg_ = Leg::take_off;
      place_.altitude_msl = altitude_of(item, flight.home);
      airframe.climb_to(place_.altitude_msl);
      return;
    case messages::MAV_CMD_NAV_WAYPOINT:
    case messages::MAV_CMD_NAV_SPLINE_WAYPOINT:
      leg_ = Leg::travel;
      if (!flight.is_plane()) wait_ = seconds_from(item.param1);
      return travel(item, flight);
    case messages::MAV_CMD_NAV_LOITER_TIME:
      leg_ = Leg::travel;
      wait_ = seconds_from(item.param1);
      return travel(item, flight);
    case messages::MAV_CMD_NAV_LOITER_UNLIM:
      leg_ = Leg::travel;
      wait_ = Duration::max();
      return travel(item, flight);
    case messages::MAV_CMD_NAV_LOITER_TURNS:
      leg_ = Leg::turns;
      turned_ = 0;
      return travel(item, flight);
    case messages::MAV_CMD_NAV_LOITER_TO_ALT:
      leg_ = Leg::climb;
      place_.altitude_msl = altitude_of(item, flight.home);
      return travel(item, flight);
    case messages::MAV_CMD_NAV_DELAY:
      leg_ = Leg::wait;
      wait_ = seconds_from(item.param1);
      arrived_at_ = flight.now;
      return airframe.hold();
    case messages::MAV_CMD_NAV_RETURN_TO_LAUNCH:
      if (flight.is_px4() || flight.is_plane()) {
        leg_ = Leg::leave_for_home;
        return;
      }
      leg_ = Leg::home;
      return return_.begin(flight);
    case messages::MAV_CMD_NAV_LAND: leg_ = Leg::land; return airframe.land(place);
    default:
      // An upload is refused for it; an autopilot that has it all the same flies on.
      flight.facts.push(notice(messages::MAV_SEVERITY_INFO, "Skipping invalid cmd #{}", current_));
      leg_ = Leg::wait;
      arrived_at_ = flight.now;
      return;
  }
}

/// To the place of the item: a waypoint is passed, round the others a plane circles and a copter turns its rounds.
void MissionFlight::travel(const MissionItem& item, const FlightContext& flight) {
  const auto speed = speed_.value_or(flight.settings.handling.cruise_speed);
  const bool is_waypoint =
      item.command == messages::MAV_CMD_NAV_WAYPOINT || item.command == messages::MAV_CMD_NAV_SPLINE_WAYPOINT;
  if (is_waypoint || (!flight.is_plane() && leg_ != Leg::turns)) return flight.airframe.fly_to(place_, speed);
  // LOITER_TO_ALT has its radius in its second parameter.
  const double asked = leg_ == Leg::climb ? item.param2 : item.param3;
  const double radius = std::isfinite(asked) && asked != 0 ? asked : flight.settings.handling.loiter_radius.value;
  flight.airframe.circle(place_, Metres{radius}, speed);
}

void MissionFlight::step(const FlightContext& flight) {
  if (finished_ || paused_ || leg_ == Leg::none || leg_ == Leg::leave_for_home) return;
  act(flight);
  look(flight);
  if (leg_ == Leg::home) return_.step(flight);
  if (!is_done(flight)) return;
  tell_done(flight);
  advance(current_ + std::size_t{1}, flight);
}

bool MissionFlight::is_done(const FlightContext& flight) {
  const double above = flight.offset_to(place_).down;
  switch (leg_) {
    case Leg::take_off: return flight.is_plane() ? above > -plane_altitude_within : std::abs(above) < take_off_within;
    case Leg::travel:
    case Leg::wait:
      if (!arrived_at_ && has_arrived(flight)) arrived_at_ = flight.now;
      return arrived_at_ && flight.now - *arrived_at_ >= wait_;
    case Leg::turns: return has_turned(flight);
    case Leg::climb:
      return has_arrived(flight) && std::abs(above) < (flight.is_plane() ? plane_altitude_within : altitude_within);
    case Leg::land: return !flight.airframe.state().airborne;
    case Leg::home: return return_.is_landing() && !flight.airframe.state().airborne;
    case Leg::none:
    case Leg::leave_for_home: return false;
  }
  return false;
}

/// At the place, or, in a plane, on the circle round it or past the waypoint.
bool MissionFlight::has_arrived(const FlightContext& flight) const {
  const auto offset = flight.offset_to(place_);
  const auto& item = items_[current_];
  const bool is_waypoint = item.command == messages::MAV_CMD_NAV_WAYPOINT;
  double radius = flight.settings.acceptance_radius.value;
  if (is_waypoint && flight.is_px4() && item.param2 > 0) radius = item.param2;
  if (!flight.is_plane()) return horizontal(offset) < radius && std::abs(offset.down) < altitude_within;
  if (!is_waypoint) return horizontal(offset) < flight.settings.handling.loiter_radius.value * (1 + on_circle_within);
  if (horizontal(offset) < radius) return true;
  const auto leg = offset_between(from_, place_);
  return offset.north * leg.north + offset.east * leg.east < 0;
}

/// Counts the way round the place, once it is on the circle.
bool MissionFlight::has_turned(const FlightContext& flight) {
  const auto& item = items_[current_];
  const double asked = std::abs(item.param3);
  const double radius = asked > 0 ? asked : flight.settings.handling.loiter_radius.value;
  const auto offset = flight.offset_to(place_);
  const double bearing = std::atan2(-offset.east, -offset.north);
  if (!arrived_at_) {
    if (std::abs(horizontal(offset) - radius) > on_circle_within * radius) return false;
    arrived_at_ = flight.now;
  } else {
    turned_ += wrapped(bearing - bearing_);
  }
  bearing_ = bearing;
  return std::abs(turned_) >= double{item.param1} * 2 * std::numbers::pi;
}

/// With the words of each autopilot. ArduPilot does not report the landing.
void MissionFlight::tell_done(const FlightContext& flight) const {
  const auto command = items_[current_].command;
  if (!flight.is_px4() && command == messages::MAV_CMD_NAV_LAND) return;
  flight.facts.push(ItemReached{current_});
  if (flight.is_px4()) return;
  const auto info = [&](const Notice& each) { flight.facts.push(each); };
  if (command == messages::MAV_CMD_NAV_WAYPOINT && !flight.is_plane())
    return info(notice(messages::MAV_SEVERITY_INFO, "Reached command #{}", current_));
  if (command == messages::MAV_CMD_NAV_WAYPOINT)
    return info(notice(messages::MAV_SEVERITY_INFO, "Reached waypoint #{} dist {:.0f}m", current_,
                       horizontal(flight.offset_to(place_))));
  if (command == messages::MAV_CMD_NAV_TAKEOFF && flight.is_plane())
    return info(notice(messages::MAV_SEVERITY_INFO, "Takeoff complete at {:.2f}m", flight.offset_to(flight.home).down));
  if (command == messages::MAV_CMD_NAV_LOITER_TURNS && flight.is_plane())
    return info(notice(messages::MAV_SEVERITY_INFO, "Loiter orbits complete"));
}

/// ArduCopter and PX4 stay where they are, ArduPlane goes home.
void MissionFlight::finish(const FlightContext& flight) {
  const bool in_air = flight.airframe.state().airborne;
  finished_ = true;
  leg_ = Leg::none;
  pending_.clear();
  if (flight.is_px4()) {
    flight.facts.push(notice(messages::MAV_SEVERITY_INFO, "Mission finished, {}\t", in_air ? "loitering" : "landed"));
  } else if (flight.is_plane() && in_air) {
    flight.facts.push(notice(messages::MAV_SEVERITY_INFO, "Mission complete, changing mode to RTL"));
    leg_ = Leg::leave_for_home;
    return;
  }
  if (in_air) flight.airframe.hold();
}

}  // namespace ponte::sim
