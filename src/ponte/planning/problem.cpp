#include "ponte/planning/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

namespace ponte::planning {
namespace {

bool is_cost(double number) { return number >= 0 && (number <= highest_cost || std::isinf(number)); }

Result<void, std::string> check_vehicle(const Problem& problem, std::size_t index) {
  const auto& vehicle = problem.vehicles[index];
  if (vehicle.costs >= problem.costs.size())
    return fail(fmt::format("vehicle {}: there is no cost matrix {}", index, vehicle.costs));
  const auto places = problem.costs[vehicle.costs].places();
  if (vehicle.start >= places) return fail(fmt::format("vehicle {}: there is no place {}", index, vehicle.start));
  for (const auto end : vehicle.ends)
    if (end >= places) return fail(fmt::format("vehicle {}: there is no place {}", index, end));
  if (!is_cost(vehicle.endurance))
    return fail(fmt::format("vehicle {}: endurance {} is not from 0 to {}", index, vehicle.endurance, highest_cost));
  if (std::isnan(vehicle.quality)) return fail(fmt::format("vehicle {}: the sensor quality is not a number", index));
  return {};
}

Result<void, std::string> check_stop(const Problem& problem, std::size_t index) {
  const auto& stop = problem.stops[index];
  if (!is_cost(stop.service) || std::isinf(stop.service))
    return fail(fmt::format("stop {}: a visit of {} is not from 0 to {}", index, stop.service, highest_cost));
  if (!(stop.priority >= lowest_priority && stop.priority <= highest_priority))
    return fail(fmt::format("stop {}: priority {} is not from {} to {}", index, stop.priority, lowest_priority,
                            highest_priority));
  if (std::isnan(stop.quality_needed)) return fail(fmt::format("stop {}: the quality needed is not a number", index));
  return {};
}

Result<void, std::string> check_costs(const Problem& problem, std::size_t index) {
  const auto& costs = problem.costs[index];
  if (costs.places() < problem.stops.size())
    return fail(
        fmt::format("cost matrix {}: {} places are too few for {} stops", index, costs.places(), problem.stops.size()));
  for (std::size_t from = 0; from < costs.places(); ++from)
    for (std::size_t to = 0; to < costs.places(); ++to)
      if (!is_cost(costs(from, to)))
        return fail(fmt::format("cost matrix {}: {} from {} to {} is neither from 0 to {} nor infinite", index,
                                costs(from, to), from, to, highest_cost));
  return {};
}

Unvisited explain(const Problem& problem, std::size_t stop, const CostAlone& cost_alone) {
  Unvisited result{.stop = stop, .reason = UnvisitedReason::no_sensor};
  bool is_within_endurance = false;
  for (const auto& vehicle : problem.vehicles) {
    if (vehicle.quality < problem.stops[stop].quality_needed) continue;
    const auto cost = cost_alone(vehicle, stop);
    result.cost_alone = std::min(result.cost_alone, cost);
    is_within_endurance |= std::isfinite(cost) && cost <= vehicle.endurance;
    result.reason = UnvisitedReason::no_way;
  }
  if (std::isfinite(result.cost_alone))
    result.reason = is_within_endurance ? UnvisitedReason::outweighed : UnvisitedReason::too_far;
  return result;
}

}  // namespace

Result<void, std::string> check(const Problem& problem) {
  if (problem.vehicles.empty()) return fail(std::string{"there is no vehicle"});
  for (std::size_t i = 0; i < problem.costs.size(); ++i)
    if (auto checked = check_costs(problem, i); !checked) return checked;
  for (std::size_t i = 0; i < problem.vehicles.size(); ++i)
    if (auto checked = check_vehicle(problem, i); !checked) return checked;
  for (std::size_t i = 0; i < problem.stops.size(); ++i)
    if (auto checked = check_stop(problem, i); !checked) return checked;
  return {};
}

double route_cost(const Problem& problem, const Vehicle& vehicle, const std::vector<std::size_t>& route) {
  if (route.empty()) return 0;
  const auto& costs = problem.costs[vehicle.costs];
  double sum = 0;
  auto place = vehicle.start;
  for (const auto stop : route) {
    sum += costs(place, stop) + problem.stops[stop].service;
    place = stop;
  }
  return sum + cost_to_end(costs, vehicle, place);
}

double cost_to_end(const CostMatrix& costs, const Vehicle& vehicle, std::size_t stop) {
  if (vehicle.ends.empty()) return 0;
  double best = unlimited;
  for (const auto end : vehicle.ends) best = std::min(best, costs(stop, end));
  return best;
}

std::size_t route_end(const Problem& problem, const Vehicle& vehicle, const std::vector<std::size_t>& route) {
  const auto last = route.empty() ? vehicle.start : route.back();
  if (vehicle.ends.empty()) return last;
  const auto& costs = problem.costs[vehicle.costs];
  return *std::ranges::min_element(vehicle.ends, {}, [&](std::size_t end) { return costs(last, end); });
}

PlanFigures figures(const Problem& problem, const Plan& plan) {
  PlanFigures result;
  for (const auto& stop : problem.stops) result.unvisited_priority += stop.priority;
  for (std::size_t i = 0; i < plan.routes.size(); ++i) {
    const auto cost = route_cost(problem, problem.vehicles[i], plan.routes[i]);
    result.total += cost;
    result.longest = std::max(result.longest, cost);
    for (const auto stop : plan.routes[i]) result.unvisited_priority -= problem.stops[stop].priority;
  }
  return result;
}

std::vector<Unvisited> unvisited(const Problem& problem, const Plan& plan) {
  return unvisited(problem, plan,
                   [&](const Vehicle& vehicle, std::size_t stop) { return route_cost(problem, vehicle, {stop}); });
}

std::vector<Unvisited> unvisited(const Problem& problem, const Plan& plan, const CostAlone& cost_alone) {
  std::vector<char> is_visited(problem.stops.size());
  for (const auto& route : plan.routes)
    for (const auto stop : route) is_visited[stop] = 1;
  std::vector<Unvisited> result;
  for (std::size_t stop = 0; stop < problem.stops.size(); ++stop)
    if (is_visited[stop] == 0) result.push_back(explain(problem, stop, cost_alone));
  return result;
}

}  // namespace ponte::planning
