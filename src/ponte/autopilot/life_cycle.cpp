#include "ponte/autopilot/life_cycle.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

namespace ponte::autopilot {
namespace {

using namespace mavlink::autopilots;

/// What MAV_LANDED_STATE says, or where it is missing what else tells.
MAV_LANDED_STATE landed_state_of(const LifeCycleSigns& signs) {
  if (signs.landed_state && *signs.landed_state != MAV_LANDED_STATE_UNDEFINED &&
      *signs.landed_state <= MAV_LANDED_STATE_LANDING)
    return static_cast<MAV_LANDED_STATE>(*signs.landed_state);
  const bool is_ardupilot = signs.stack == Stack::ardupilot_copter || signs.stack == Stack::ardupilot_plane;
  if (!is_ardupilot) return MAV_LANDED_STATE_UNDEFINED;
  // ArduPilot is ACTIVE in the air only, and STANDBY on the ground, armed or not.
  if (signs.system_status == MAV_STATE_ACTIVE || signs.system_status == MAV_STATE_CRITICAL)
    return MAV_LANDED_STATE_IN_AIR;
  if (signs.system_status == MAV_STATE_STANDBY) return MAV_LANDED_STATE_ON_GROUND;
  return MAV_LANDED_STATE_UNDEFINED;
}

}  // namespace

vehicle::Phase phase_from(const LifeCycleSigns& signs) {
  using enum vehicle::Phase;
  const bool failing = signs.system_status == MAV_STATE_CRITICAL || signs.system_status == MAV_STATE_EMERGENCY ||
                       signs.system_status == MAV_STATE_FLIGHT_TERMINATION;
  if (!signs.armed) {
    switch (signs.system_status) {
      case MAV_STATE_UNINIT:
      case MAV_STATE_BOOT:
      case MAV_STATE_CALIBRATING: return power_up;
      case MAV_STATE_STANDBY:
      case MAV_STATE_ACTIVE:
      case MAV_STATE_CRITICAL: return pre_start;
      default: return unknown;
    }
  }
  switch (landed_state_of(signs)) {
    case MAV_LANDED_STATE_ON_GROUND: return pre_launch;
    case MAV_LANDED_STATE_TAKEOFF: return failing ? critical : taking_off;
    case MAV_LANDED_STATE_LANDING: return failing ? critical : landing;
    case MAV_LANDED_STATE_IN_AIR: {
      if (failing) return critical;
      if (signs.mode == vehicle::ModeKind::land) return landing;
      return signs.mode == vehicle::ModeKind::take_off ? taking_off : in_flight;
    }
    default: return unknown;
  }
}

}  // namespace ponte::autopilot
