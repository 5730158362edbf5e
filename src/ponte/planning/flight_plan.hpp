#pragma once

#include "ponte/planning/airspace.hpp"
#include "ponte/planning/point_of_interest.hpp"
#include "ponte/planning/problem.hpp"
#include "ponte/planning/wind.hpp"

/// From points of interest to a problem for a solver, and from its plan to missions that can be flown.
namespace ponte::planning {

struct Craft {
  vehicle::Place start{};
  std::vector<vehicle::Place> ends{};     ///< it lands at the one that is cheapest to reach; at its last point if none
  MetresPerSecond speed{};                ///< through the air, above 0
  bool sets_speed{};                      ///< its mission sets this speed; else the craft is known to fly at it
  MetresPerSecond vertical_speed{};       ///< of climb and descent, above 0
  vehicle::Seconds endurance{unlimited};  ///< what it may use, the reserve taken off
  double quality{1};                      ///< of its sensor, 0 to 1
};

struct Task {
  std::vector<PointOfInterest> points{};
  std::vector<Craft> crafts{};  ///< at least one
  vehicle::Mission fence{};     ///< its polygons and circles hold on every leg
  Metres margin{};              ///< that detours keep from corners of the fence
  Wind wind{};
  vehicle::Altitude altitude{};  ///< to fly at where a point tells none
  Objective objective{};
};

/// A route in the air, with the turns of its detours.
struct Flight {
  struct Leg {
    std::vector<vehicle::Place> turns{};  ///< before the target
    vehicle::Place target{};
    std::optional<std::size_t> point{};  ///< the point of interest there; nothing for the landing place
    vehicle::Altitude altitude{};
  };
  std::vector<Leg> legs{};  ///< none when the craft stays on the ground
  Metres length{};          ///< over ground
  vehicle::Seconds time{};  ///< with climb, dwell and descent
};

/// Knows the ways between all places of a task.
class FlightPlanner {
 public:
  explicit FlightPlanner(Task task);

  [[nodiscard]] const Task& task() const { return task_; }
  [[nodiscard]] const Airspace& airspace() const { return airspace_; }
  /// Stop i is point i. Costs are seconds.
  [[nodiscard]] const Problem& problem() const { return problem_; }
  /// One flight for each craft, of a plan for `problem`.
  [[nodiscard]] std::vector<Flight> flights(const Plan& plan) const;

 private:
  [[nodiscard]] std::optional<double> seconds(const Craft& craft, std::size_t from, std::size_t to) const;
  void add_leg(Flight& flight, const Craft& craft, std::size_t from, std::size_t to) const;
  [[nodiscard]] vehicle::Altitude altitude_of(std::size_t place) const;

  Task task_;
  std::vector<vehicle::Place> places_;  ///< the points, then the starts and ends of the crafts
  Airspace airspace_;
  std::vector<std::optional<std::vector<vehicle::Place>>> ways_;
  Problem problem_;
};

/// For each flight the altitude layer that keeps it apart from the others: flights whose paths come nearer to one
/// another than `distance` are in different layers, counted from 0.
[[nodiscard]] std::vector<int> layers(const std::vector<Craft>& crafts, const std::vector<Flight>& flights,
                                      Metres distance);

struct MissionStyle {
  Metres added_altitude{};  ///< of the layer
  vehicle::Seconds wait{};  ///< before take-off
  bool takes_pictures{};    ///< one at each point
};

/// Take-off, speed, waypoints, landing. Empty for a flight without legs.
[[nodiscard]] vehicle::Mission mission_of(const Craft& craft, const Flight& flight,
                                          const std::vector<PointOfInterest>& points, const MissionStyle& style);

}  // namespace ponte::planning
