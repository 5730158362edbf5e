#include "ponte/sim/return_flight.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::sim {
namespace {

constexpr double home_within = 0.5;         // m over ground
constexpr double nearly_still = 0.3;        // m/s
constexpr double at_altitude_within = 0.3;  // m
constexpr double lowest_return_height = 2;  // m, however near home is

}  // namespace

void ReturnFlight::begin(const FlightContext& flight) {
  const auto offset = flight.offset_to(flight.home);
  double height = flight.settings.return_height.value;
  if (flight.settings.return_cone_slope > 0)
    height = std::min(height, std::max(horizontal(offset) * flight.settings.return_cone_slope, lowest_return_height));
  altitude_ = flight.home.altitude_msl + Metres{std::max(height, offset.down + flight.settings.return_climb.value)};
  if (flight.is_plane()) {
    leg_ = Leg::circle;
    altitude_ = flight.home.altitude_msl + flight.settings.return_height;
    flight.airframe.circle(above_home(flight), flight.settings.handling.loiter_radius, speed(flight));
    return;
  }
  leg_ = Leg::rise;
  flight.airframe.climb_to(altitude_);
}

void ReturnFlight::step(const FlightContext& flight) {
  auto& airframe = flight.airframe;
  switch (leg_) {
    case Leg::rise:
      if (std::abs((airframe.known_position().altitude_msl - altitude_).value) > at_altitude_within) return;
      leg_ = Leg::cross;
      airframe.fly_to(above_home(flight), speed(flight));
      return;
    case Leg::cross:
      if (horizontal(flight.offset_to(flight.home)) > home_within ||
          horizontal(airframe.state().velocity) > nearly_still)
        return;
      leg_ = Leg::wait;
      there_since_ = flight.now;
      return;
    case Leg::wait:
      if (flight.now - there_since_ >= flight.settings.return_wait) leave_altitude(flight);
      return;
    case Leg::descend:
      if (flight.offset_to(above_home(flight)).down > at_altitude_within) return;
      leg_ = Leg::stay;
      there_since_ = flight.now;
      return;
    case Leg::stay:
      if (flight.now - there_since_ < flight.settings.return_final_wait) return;
      leg_ = Leg::land;
      return airframe.land(flight.home);
    case Leg::land:
    case Leg::circle: return;
  }
}

/// To land, or to where it waits once more.
void ReturnFlight::leave_altitude(const FlightContext& flight) {
  const auto height = flight.settings.return_final_height;
  if (height <= Metres{}) {
    leg_ = Leg::land;
    return flight.airframe.land(flight.home);
  }
  leg_ = Leg::descend;
  altitude_ = std::min(altitude_, flight.home.altitude_msl + height);
  flight.airframe.fly_to(above_home(flight), speed(flight));
}

MetresPerSecond ReturnFlight::speed(const FlightContext& flight) const {
  const auto& settings = flight.settings;
  return settings.return_speed > MetresPerSecond{} ? settings.return_speed : settings.handling.cruise_speed;
}

Position ReturnFlight::above_home(const FlightContext& flight) const {
  auto result = flight.home;
  result.altitude_msl = altitude_;
  return result;
}

}  // namespace ponte::sim
