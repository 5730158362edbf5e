#pragma once

#include "ponte/planning/point_of_interest.hpp"
#include "ponte/planning/problem.hpp"
#include "ponte/planning/wind.hpp"

#include <vector>

namespace ponte::planning {

struct Craft {
  vehicle::Place start{};
  std::vector<vehicle::Place> ends{};     ///< it lands at the one that is cheapest to reach; at its last stop if none
  MetresPerSecond speed{};                ///< through the air, above 0
  bool sets_speed{};                      ///< its mission sets this speed; else the craft is known to fly at it
  MetresPerSecond vertical_speed{};       ///< of climb and descent, above 0
  Metres turn_radius{};                   ///< in still air; 0: it turns on the spot
  vehicle::Seconds endurance{unlimited};  ///< what it may use, the reserve taken off
  double quality{1};                      ///< of its sensor, 0 to 1
};

/// A line to fly along in one direction or the other, with a picture at both ends and after each `spacing` between.
struct SurveyLine {
  vehicle::Place begin{};
  vehicle::Place end{};
  Metres spacing{};
  Metres run_in{};  ///< flown straight on before and behind it
};

/// Points to visit and lines to fly along.
struct Task {
  std::vector<PointOfInterest> points{};
  std::vector<SurveyLine> lines{};
  std::vector<Craft> crafts{};  ///< at least one
  vehicle::Mission fence{};     ///< its polygons and circles hold on every leg
  Metres margin{};              ///< that detours keep from corners of the fence
  Wind wind{};
  vehicle::Altitude altitude{};  ///< to fly at where a point tells none
  Objective objective{};
};

}  // namespace ponte::planning
