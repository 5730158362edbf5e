#include "ponte/planning/legs.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::planning {

Ticks ticks(double cost) {
  constexpr double ticks_per_unit = 0x1p20;
  return std::isinf(cost) ? no_way : static_cast<Ticks>(std::llround(cost * ticks_per_unit));
}

Legs::Legs(const Problem& problem) {
  for (const auto& stop : problem.stops)
    stops_.push_back({ticks(stop.service), ticks(stop.priority), stop.quality_needed});
  for (const auto& vehicle : problem.vehicles) {
    const auto& costs = problem.costs[vehicle.costs];
    VehicleFacts facts{.costs = vehicle.costs,
                       .limit = std::min(ticks(vehicle.endurance), no_way - 1),
                       .quality = vehicle.quality,
                       .from_start = {},
                       .to_end = {}};
    for (std::size_t stop = 0; stop < stops_.size(); ++stop) {
      facts.from_start.push_back(ticks(costs(vehicle.start, stop)) + ticks(problem.stops[stop].service));
      facts.to_end.push_back(ticks(cost_to_end(costs, vehicle, stop)));
    }
    vehicles_.push_back(std::move(facts));
  }
  for (const auto& costs : problem.costs) {
    auto& legs = classes_.emplace_back();
    for (std::size_t from = 0; from < stops_.size(); ++from)
      for (std::size_t to = 0; to < stops_.size(); ++to)
        legs.push_back(ticks(costs(from, to)) + ticks(problem.stops[to].service));
  }
}

Ticks Legs::distance(Node a, Node b) const {
  auto least = no_way;
  for (const auto& legs : classes_)
    least = std::min({least, legs[std::size_t{a} * stops() + b] - stops_[b].service,
                      legs[std::size_t{b} * stops() + a] - stops_[a].service});
  return least;
}

}  // namespace ponte::planning
