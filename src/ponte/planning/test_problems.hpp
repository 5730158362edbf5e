#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/problem.hpp"

#include <cmath>
#include <string>
#include <vector>

/// Problems and plans for the tests of the solvers.
namespace ponte::planning::testing {

/// Stops and homes in a square of 1000, with a wind of so much of the speed that blows along the first axis.
inline CostMatrix random_costs(Random& random, std::size_t places, double wind = 0) {
  struct Point {
    double x;
    double y;
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < places; ++i) {
    const auto x = 1000 * random.unit();
    const auto y = 1000 * random.unit();
    points.push_back({x, y});
  }
  CostMatrix costs{places};
  for (std::size_t from = 0; from < places; ++from)
    for (std::size_t to = 0; to < places; ++to) {
      const auto x = points[to].x - points[from].x;
      const auto y = points[to].y - points[from].y;
      costs(from, to) = std::sqrt(x * x + y * y) + wind * std::abs(x) - wind * x;
    }
  return costs;
}

/// One vehicle, which comes home.
inline Problem one_tour(Random& random, std::size_t stops, double wind = 0) {
  return {.stops = std::vector<Stop>(stops),
          .vehicles = {{.start = stops, .ends = {stops}}},
          .costs = {random_costs(random, stops + 1, wind)}};
}

/// All that a problem can have: two classes of vehicles, several homes, an open route, endurance, sensors, priorities,
/// ways that are closed.
inline Problem mixed_problem(Random& random, std::size_t stops) {
  Problem problem;
  for (std::size_t i = 0; i < stops; ++i) {
    Stop stop;
    stop.service = random.below(3) * 10.0;
    stop.priority = 1 + random.below(9);
    stop.quality_needed = random.below(3) * 0.5;
    problem.stops.push_back(stop);
  }
  for (int i = 0; i < 2; ++i) problem.costs.push_back(random_costs(random, stops + 2, 0.2 * i));
  for (auto& costs : problem.costs)
    for (std::size_t i = 0; i < stops / 2; ++i) {
      const auto from = random.below(static_cast<std::uint32_t>(stops));
      const auto to = random.below(static_cast<std::uint32_t>(stops));
      costs(from, to) = unlimited;
    }
  problem.vehicles = {{.costs = 0, .start = stops, .ends = {stops}, .endurance = 3000, .quality = 0.5},
                      {.costs = 1, .start = stops + 1, .ends = {stops, stops + 1}, .endurance = 2500, .quality = 1},
                      {.costs = 1, .start = stops, .ends = {}, .endurance = unlimited, .quality = 0}};
  problem.objective = random.chance(0.5) ? Objective::total : Objective::longest;
  return problem;
}

/// The first constraint that the plan breaks, in words; empty when it holds all.
inline std::string broken_constraint(const Problem& problem, const Plan& plan) {
  if (plan.routes.size() != problem.vehicles.size()) return "not one route for each vehicle";
  std::vector<int> visits(problem.stops.size());
  for (std::size_t i = 0; i < plan.routes.size(); ++i) {
    const auto& vehicle = problem.vehicles[i];
    for (const auto stop : plan.routes[i]) {
      if (++visits[stop] > 1) return "a stop is visited twice";
      if (problem.stops[stop].quality_needed > vehicle.quality) return "a sensor is not good enough";
    }
    const auto cost = route_cost(problem, vehicle, plan.routes[i]);
    if (!std::isfinite(cost)) return "a leg has no way";
    // The solvers count in ticks.
    if (cost > vehicle.endurance + 1e-3) return "a route is beyond the endurance";
  }
  return "";
}

/// Whether a plan is worse than another by the objective, beyond the size of a tick.
inline bool is_worse(const Problem& problem, const Plan& plan, const Plan& than) {
  const auto a = figures(problem, plan);
  const auto b = figures(problem, than);
  if (a.unvisited_priority != b.unvisited_priority) return a.unvisited_priority > b.unvisited_priority;
  return problem.objective == Objective::total ? a.total > b.total + 1e-3 : a.longest > b.longest + 1e-3;
}

}  // namespace ponte::planning::testing
