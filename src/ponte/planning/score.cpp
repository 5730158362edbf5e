#include "ponte/planning/score.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ponte::planning {
namespace {

/// The mean of the routes is that of power 2^6 = 64: nearly the longest, and yet every route counts a little.
constexpr int doublings = 6;
/// To leave a stop of the mean priority unvisited is as bad as this many typical legs.
constexpr double legs_per_stop = 2;

/// Of a route that visits only the stop that is farthest in this sense.
Ticks longest_single_visit(const Legs& legs) {
  Ticks longest = 1;
  for (Node vehicle = 0; vehicle < legs.vehicles(); ++vehicle) {
    const auto home = legs.home(vehicle);
    for (Node stop = 0; stop < legs.stops(); ++stop) {
      const auto cost = legs(vehicle, home, stop) + legs(vehicle, stop, home);
      if (cost < no_way) longest = std::max(longest, cost);
    }
  }
  return longest;
}

}  // namespace

Scoring::Scoring(Objective objective, const Legs& legs, Ticks typical_leg)
    : objective_{objective}, scale_{1 / static_cast<double>(longest_single_visit(legs))} {
  Ticks priorities = 1;
  for (Node stop = 0; stop < legs.stops(); ++stop) priorities += legs.priority(stop);
  ticks_per_priority_ = legs_per_stop * static_cast<double>(typical_leg) * legs.stops() / static_cast<double>(priorities);
}

double Scoring::share(Ticks cost) const {
  auto share = static_cast<double>(cost);
  if (objective_ == Objective::total) return share;
  share *= scale_;
  for (int i = 0; i < doublings; ++i) share *= share;
  return share;
}

Score Scoring::score(const Legs& legs, const Routes& routes) const {
  Score result{.unvisited_priority = routes.unvisited_priority()};
  for (Node vehicle = 0; vehicle < legs.vehicles(); ++vehicle) {
    const auto cost = routes.cost(vehicle);
    result.total += cost;
    result.longest = std::max(result.longest, cost);
    result.smooth += share(cost);
  }
  if (objective_ == Objective::longest) {
    for (int i = 0; i < doublings; ++i) result.smooth = std::sqrt(result.smooth);
    result.smooth /= scale_;
  }
  result.smooth += ticks_per_priority_ * static_cast<double>(result.unvisited_priority);
  return result;
}

bool Scoring::is_better(const Score& a, const Score& b) const {
  if (objective_ == Objective::total)
    return std::tie(a.unvisited_priority, a.total) < std::tie(b.unvisited_priority, b.total);
  return std::tie(a.unvisited_priority, a.longest, a.total) < std::tie(b.unvisited_priority, b.longest, b.total);
}

}  // namespace ponte::planning
