#pragma once

#include "ponte/planning/flight_plan.hpp"

namespace ponte::planning {

/// Wait, take-off, speed, waypoints with their dwell and pictures, landing. Empty for a flight without legs. A flight
/// that keeps apart from others comes home in its own altitude; others return as their autopilot does it.
[[nodiscard]] vehicle::Mission mission_of(const Task& task, std::size_t craft, const Flight& flight,
                                          bool takes_pictures);

}  // namespace ponte::planning
