#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/attitude.hpp"
#include "ponte/sim/mission_flight.hpp"
#include "ponte/sim/seconds.hpp"

#include <cmath>

/// What a mission does on the way: speeds, where to look, and the conditions that hold up what comes after them.
namespace ponte::sim {

namespace messages = mavlink::autopilots;

void MissionFlight::act(const FlightContext& flight) {
  while (!pending_.empty() && !is_held_up(flight)) {
    const auto item = pending_.front();
    pending_.erase(pending_.begin());
    held_until_.reset();
    held_beyond_m_.reset();
    perform(items_[item], flight);
    flight.facts.push(ItemReached{item});
  }
}

bool MissionFlight::is_held_up(const FlightContext& flight) const {
  if (held_until_ && flight.now < *held_until_) return true;
  return held_beyond_m_ && horizontal(flight.offset_to(place_)) > *held_beyond_m_;
}

void MissionFlight::perform(const MissionItem& item, const FlightContext& flight) {
  switch (item.command) {
    case messages::MAV_CMD_DO_CHANGE_SPEED:
      if (item.param2 > 0) set_speed(MetresPerSecond{item.param2}, flight);
      return;
    case messages::MAV_CMD_DO_SET_ROI:
    case messages::MAV_CMD_DO_SET_ROI_LOCATION: region_of_interest_ = place_of(item, flight.home); return;
    case messages::MAV_CMD_DO_SET_ROI_NONE: region_of_interest_.reset(); return;
    case messages::MAV_CMD_CONDITION_DELAY: held_until_ = flight.now + seconds_from(item.param1); return;
    case messages::MAV_CMD_CONDITION_DISTANCE: held_beyond_m_ = item.param1; return;
    case messages::MAV_CMD_CONDITION_YAW:
      if (std::isfinite(item.param1))
        heading_ = heading_after_turn(flight.airframe.state().attitude.heading, double{item.param1},
                                      double{item.param3}, item.param4 > 0);
      return;
    default: return;  // cameras, servos and the like, which this vehicle does not have
  }
}

/// The nose of a copter points to the region of interest.
void MissionFlight::look(const FlightContext& flight) const {
  if (!region_of_interest_ && !heading_) return;
  auto heading = heading_;
  if (region_of_interest_) {
    const auto offset = flight.offset_to(*region_of_interest_);
    heading = Radians{std::atan2(offset.east, offset.north)};
  }
  flight.airframe.face({.heading = heading});
}

}  // namespace ponte::sim
