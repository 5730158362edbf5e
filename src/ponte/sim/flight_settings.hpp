#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"
#include "ponte/sim/flight_mode.hpp"
#include "ponte/sim/handling.hpp"

namespace ponte::sim {

/// How an autopilot flies. `settings.cpp` says which of its parameters is which setting.
struct FlightSettings {
  Handling handling{};
  Metres acceptance_radius{};  ///< of a waypoint
  Metres take_off_height{};    ///< unless it is told another
  bool mode_takes_off{};       ///< a mission begins on the ground by its mode alone

  Metres return_height{};          ///< above home, at least
  Metres return_climb{};           ///< at least, whatever the height
  double return_cone_slope{};      ///< near home it need not climb higher than this times the distance; 0: it has to
  MetresPerSecond return_speed{};  ///< 0: the cruise speed
  Duration return_wait{};          ///< over home, before it descends
  Metres return_final_height{};    ///< where it stays before it lands; 0: it lands at once
  Duration return_final_wait{};    ///< how long; the longest of all: it does not land

  Duration guided_time_out{};       ///< without velocities, or in OFFBOARD without setpoints
  FlightMode offboard_lost{};       ///< what OFFBOARD becomes then
  Duration disarms_idle_after{};    ///< 0: never
  Duration disarms_landed_after{};  ///< 0: never
};

}  // namespace ponte::sim
