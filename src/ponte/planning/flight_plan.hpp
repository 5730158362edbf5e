#pragma once

#include "ponte/planning/airspace.hpp"
#include "ponte/planning/pass_problem.hpp"
#include "ponte/planning/task.hpp"
#include "ponte/planning/turning.hpp"

#include <optional>

/// From points and lines to a problem for a solver, and from its plan to flights.
namespace ponte::planning {

/// A route in the air.
struct Flight {
  struct Leg {
    std::vector<vehicle::Place> turns{};  ///< to fly by before the target: round zones, and where a turn is over
    vehicle::Place target{};
    std::optional<std::size_t> stop{};  ///< what is visited: a point, or a line from its number on; nothing at the end
    std::optional<SurveyLine> line{};   ///< in the direction of the flight; the target lies its run-in behind it
    vehicle::Altitude altitude{};
  };
  /// When it is where. It flies straight from one moment to the next.
  struct Moment {
    vehicle::Seconds time{};  ///< since its take-off
    vehicle::Place place{};
    Metres height{};  ///< in the frame of the task's altitude
  };
  std::vector<Leg> legs{};      ///< none when the craft stays on the ground
  std::vector<Moment> track{};  ///< turns as chords of 10 degrees
  Metres length{};              ///< over ground
  vehicle::Seconds time{};      ///< with climb, dwell and descent
  Metres added_altitude{};      ///< to keep away from others
  vehicle::Seconds wait{};      ///< before take-off, likewise
};

/// Knows the ways between all places of a task.
class FlightPlanner {
 public:
  explicit FlightPlanner(Task task);
  FlightPlanner(const FlightPlanner&) = delete;
  FlightPlanner& operator=(const FlightPlanner&) = delete;
  ~FlightPlanner() = default;

  [[nodiscard]] const Task& task() const { return task_; }
  [[nodiscard]] const Airspace& airspace() const { return airspace_; }
  /// Stop i is point i, and behind the points line i. Costs are seconds.
  [[nodiscard]] const PassProblem& pass_problem() const { return problem_; }
  [[nodiscard]] const Problem& problem() const { return problem_.problem; }
  /// Whether only `pass_problem` has the true costs: there are lines, or a craft that cannot turn on the spot.
  [[nodiscard]] bool has_passes() const;
  /// One flight for each craft, of a plan for the problem.
  [[nodiscard]] std::vector<Flight> flights(const Plan& plan) const;

 private:
  /// A way to make a visit, or to start or to land: in at one spot, out at another.
  struct Pass {
    std::size_t in{};
    std::size_t out{};
    Radians course{};  ///< on the map; of no matter to a craft that turns on the spot
  };
  /// Crafts that are alike in flight.
  struct Class {
    MetresPerSecond speed{};
    Metres turn_radius{};
    FlyingTimes times;
    std::optional<TurningWays> turning{};     ///< of a craft that cannot turn on the spot
    std::vector<std::vector<Pass>> passes{};  ///< of each place of the problem
  };
  using Corners = std::vector<vehicle::Place>;

  void find_ways();
  std::size_t class_of(const Craft& craft);
  [[nodiscard]] std::vector<std::vector<Pass>> passes_of(Metres turn_radius) const;
  [[nodiscard]] PassCosts pass_costs(const Class& likes) const;
  void add_costs(PassCosts& costs, const Class& likes, std::size_t from, std::size_t to) const;
  [[nodiscard]] double seconds(const Class& likes, std::size_t from, std::size_t to) const;
  [[nodiscard]] double seconds_within(const Class& likes, const Pass& pass) const;
  [[nodiscard]] Flight flight(std::size_t craft, const std::vector<std::size_t>& route) const;
  void add_leg(Flight& flight, const Class& likes, const Pass& from, const Pass& to,
               std::optional<std::size_t> stop) const;
  void turn_to(Flight& flight, Flight::Leg& leg, const Class& likes, const Pass& from, const Pass& to) const;
  void fly_to(Flight& flight, const Class& likes, const vehicle::Place& place) const;
  [[nodiscard]] const Corners& corners(std::size_t from, std::size_t to) const {
    return *ways_[from * places_.size() + to];
  }
  [[nodiscard]] std::vector<MapPoint> corner_points(std::size_t from, std::size_t to) const;

  Task task_;
  std::vector<vehicle::Place> places_;  ///< of all spots: points, both ends of lines, starts and ends of crafts
  Airspace airspace_;
  std::vector<MapPoint> spots_;               ///< the same on the map
  std::vector<std::optional<Corners>> ways_;  ///< from each spot to each, without turns
  std::vector<Class> classes_;
  PassProblem problem_;
};

}  // namespace ponte::planning
