#pragma once

#include "ponte/planning/problem.hpp"

/// Problems whose places can be passed in several ways, which the order of the visits alone does not decide: a line is
/// flown along in one direction or the other, and what cannot turn on the spot passes a point on some course.
namespace ponte::planning {

/// What each leg costs a class of vehicles, from each pass of a place to each pass of the next.
struct PassCosts {
  std::vector<std::size_t> first;  ///< the number of each place's first pass, and behind the last place that of all
  CostMatrix costs;                ///< between passes by their numbers; what the later pass itself takes included

  [[nodiscard]] std::size_t places() const { return first.size() - 1; }
  [[nodiscard]] std::size_t passes(std::size_t place) const { return first[place + 1] - first[place]; }
};

struct PassProblem {
  /// Its costs are those that `expected` makes of the passes, so every solver can look for a good order.
  Problem problem;
  std::vector<PassCosts> classes;  ///< as many as `problem.costs`
};

/// What a leg may be expected to cost: half-way between the least and the mean of the ways to pass its beginning, each
/// with the best way to pass its end. From the places after the stops, where routes may begin in any way, it costs the
/// least.
[[nodiscard]] CostMatrix expected(const PassCosts& passes, std::size_t stops);

/// A route with the ways of passing that make it cheapest.
struct PassedRoute {
  double cost{};                    ///< visits included; infinite when there is no way, 0 without stops
  std::vector<std::size_t> passes;  ///< of the start, of each stop, and of the end if the vehicle has one
  std::size_t end{};                ///< the place; the last stop where the vehicle has no ends
};
[[nodiscard]] PassedRoute best_passes(const PassProblem& problem, const Vehicle& vehicle,
                                      const std::vector<std::size_t>& route);

/// The stops that no route visits, and why.
[[nodiscard]] std::vector<Unvisited> unvisited(const PassProblem& problem, const Plan& plan);

}  // namespace ponte::planning
