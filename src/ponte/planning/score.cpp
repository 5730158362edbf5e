#include "ponte/planning/score.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ponte::planning {
namespace {

/// The mean of the routes is that of power 2^6 = 64: nearly the longest, and yet every route counts a little.
constexpr int doublings = 6;

/// The cost of the costliest route that visits one stop.
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

Scoring::Scoring(Objective objective, const Legs& legs) : objective_{objective} {
  const auto costliest = static_cast<double>(longest_single_visit(legs));
  scale_ = 1 / costliest;
  auto least_priority = ticks(highest_priority);
  for (Node stop = 0; stop < legs.stops(); ++stop) least_priority = std::min(least_priority, legs.priority(stop));
  // So no visit costs more than it is worth.
  ticks_per_priority_ = 2 * costliest / static_cast<double>(least_priority);
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
