#include "ponte/planning/score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace ponte::planning {
namespace {
const int doublings = std::getenv("P_DOUBLINGS") ? atoi(std::getenv("P_DOUBLINGS")) : 6;
}
double Scoring::weight(Ticks cost) const {
  auto weight = static_cast<double>(cost);
  if (objective_ == Objective::total) return weight;
  weight *= scale_;
  for (int i = 0; i < doublings; ++i) weight *= weight;
  return weight;
}

Score Scoring::score(const Legs& legs, const Routes& routes) const {
  Score result{.unvisited_priority = routes.unvisited_priority()};
  for (Node vehicle = 0; vehicle < legs.vehicles(); ++vehicle) {
    const auto cost = routes.cost(vehicle);
    result.total += cost;
    result.longest = std::max(result.longest, cost);
    result.smooth += weight(cost);
  }
  if (objective_ == Objective::longest)
    for (int i = 0; i < doublings; ++i) result.smooth = std::sqrt(result.smooth);
  if (objective_ == Objective::longest) result.smooth /= scale_;
  return result;
}

bool Scoring::is_better(const Score& a, const Score& b) const {
  if (objective_ == Objective::total)
    return std::tie(a.unvisited_priority, a.total) < std::tie(b.unvisited_priority, b.total);
  return std::tie(a.unvisited_priority, a.longest, a.total) < std::tie(b.unvisited_priority, b.longest, b.total);
}

}  // namespace ponte::planning
