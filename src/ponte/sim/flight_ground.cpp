#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/flight.hpp"

/// A flight on the ground: how it leaves it and comes back, and what disarms it there.
namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

using enum FlightMode;

constexpr Duration square_begins_after = std::chrono::seconds{2};

}  // namespace

void Flight::on_ground_left_or_reached(const FlightContext& flight) {
  was_airborne_ = flight.airframe.state().airborne;
  has_landed_ = !was_airborne_;
  idle_since_ = flight.now;
  if (has_landed_ && flight.airframe.state().crashed) return crash(flight);
  if (has_landed_ && leg_ != Leg::mission) leg_ = Leg::none;
  if (!flight.is_px4()) return;
  flight.facts.push(notice(messages::MAV_SEVERITY_INFO, "{} detected\t", has_landed_ ? "Landing" : "Takeoff"));
}

void Flight::crash(const FlightContext& flight) {
  flight.airframe.disarm();
  on_disarmed();
  flight.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "{}",
                           flight.is_px4() ? "Crash detected, disarmed\t" : "Crash: Disarming"));
}

void Flight::wait_on_ground(const FlightContext& flight) {
  const auto idle = flight.now - idle_since_;
  if (mode_ == guided && flies_square_ && !has_landed_ && idle >= square_begins_after) return climb(height_, flight);
  const auto patience = has_landed_ ? settings_.disarms_landed_after : settings_.disarms_idle_after;
  if (patience > Duration{} && idle >= patience) disarm(flight);
}

/// One that does not leave the ground, as without motors.
void Flight::give_up_take_off(const FlightContext& flight) {
  const auto& state = flight.airframe.state();
  const bool tries =
      state.armed && !state.airborne && (leg_ == Leg::take_off || (leg_ == Leg::mission && mission_.is_taking_off()));
  if (!tries) {
    tries_since_.reset();
    return;
  }
  if (!tries_since_) tries_since_ = flight.now;
  const auto patience = settings_.disarms_idle_after;
  if (patience > Duration{} && flight.now - *tries_since_ >= patience) disarm(flight);
}

/// By itself, with the words of each autopilot.
void Flight::disarm(const FlightContext& flight) {
  flight.airframe.disarm();
  const auto info = [&](const Notice& each) { flight.facts.push(each); };
  if (flight.is_px4()) {
    info(notice(messages::MAV_SEVERITY_INFO, "Disarmed by {}\t", has_landed_ ? "landing" : "auto preflight disarming"));
    if (mode_ == rtl || mode_ == land || mode_ == FlightMode::take_off) mode_ = loiter;
  } else if (flight.is_plane()) {
    info(notice(messages::MAV_SEVERITY_INFO, "Throttle disarmed"));
    info(notice(messages::MAV_SEVERITY_INFO, "Auto disarmed"));
  } else {
    info(notice(messages::MAV_SEVERITY_INFO, "Disarming motors"));
  }
  on_disarmed();
}

}  // namespace ponte::sim
