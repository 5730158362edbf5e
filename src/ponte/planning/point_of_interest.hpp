#pragma once

#include "ponte/planning/where.hpp"
#include "ponte/vehicle/mission.hpp"

#include <optional>
#include <string>

namespace ponte::planning {

/// A place that some vehicle is to visit.
struct PointOfInterest {
  vehicle::Place place{};
  std::optional<vehicle::Altitude> altitude{};  ///< absent: the planner's choice
  vehicle::Seconds dwell{};                     ///< how long to stay there
  std::optional<double> priority{};             ///< 0 or more, the higher the more important; absent: as any other
  std::optional<double> sensor_quality{};       ///< that a visitor's sensor must have at least, 0 to 1; absent: any
  std::string name{};                           ///< for people; empty: none
  Where where{};                                ///< it stands in its file

  /// The same point, wherever it was read.
  friend bool operator==(const PointOfInterest& a, const PointOfInterest& b) {
    return a.place == b.place && a.altitude == b.altitude && a.dwell == b.dwell && a.priority == b.priority &&
           a.sensor_quality == b.sensor_quality && a.name == b.name;
  }
};

}  // namespace ponte::planning
