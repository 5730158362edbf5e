#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"
#include "ponte/sim/flight_mode.hpp"
#include "ponte/sim/parameters.hpp"

namespace ponte::sim {

/// What an autopilot's parameters say about how it flies. Each is named after the parameters that it comes from, in the
/// order ArduCopter, ArduPlane, PX4; where one of them has no such parameter, it is how that autopilot behaves.
struct FlightSettings {
  MetresPerSecond cruise_speed{};  ///< WPNAV_SPEED, AIRSPEED_CRUISE, MPC_XY_CRUISE or FW_AIRSPD_TRIM
  Metres acceptance_radius{};      ///< of a waypoint: WPNAV_RADIUS, WP_RADIUS, NAV_ACC_RAD
  Metres loiter_radius{};          ///< CIRCLE_RADIUS, WP_LOITER_RAD, NAV_LOITER_RAD
  Metres take_off_height{};        ///< unless it is told another: none, TKOFF_ALT, MIS_TAKEOFF_ALT
  bool mode_takes_off{};  ///< a mission begins on the ground by its mode alone: bit 1 of AUTO_OPTIONS, yes, yes

  Metres return_height{};           ///< above home, at least: RTL_ALT, RTL_ALTITUDE, RTL_RETURN_ALT
  double return_cone_slope{};       ///< near home it need not climb higher than this times the distance: RTL_CONE_SLOPE
  MetresPerSecond return_speed{};   ///< RTL_SPEED
  Duration return_wait{};           ///< over home, before it descends: RTL_LOIT_TIME, none, RTL_LAND_DELAY
  Duration guided_time_out{};       ///< without velocities: GUID_TIMEOUT, none; without setpoints: COM_OF_LOSS_T
  Duration disarms_idle_after{};    ///< DISARM_DELAY, none, COM_DISARM_PRFLT
  Duration disarms_landed_after{};  ///< about 1 s, LAND_DISARMDELAY, COM_DISARM_LAND
};

/// With the parameters as they come from the factory.
[[nodiscard]] FlightSettings default_flight_settings(VehicleKind kind);

/// As these parameters, which are of this kind, have them; what is not among them is as it comes from the factory.
[[nodiscard]] FlightSettings flight_settings(VehicleKind kind, const Parameters& parameters);

}  // namespace ponte::sim
