#include "ponte/planning/pass_problem.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ponte::planning {
namespace {

/// The least costs of reaching each pass of a place, and the pass of the place before from which that is.
struct Reached {
  std::size_t place{};
  std::vector<double> costs;
  std::vector<std::size_t> from;
};

Reached begun(const PassCosts& passes, std::size_t start) {
  return {start, std::vector<double>(passes.passes(start)), {}};
}

Reached gone_on(const PassCosts& passes, const Reached& before, std::size_t place, double service) {
  const auto count = passes.passes(place);
  Reached result{place, std::vector<double>(count, unlimited), std::vector<std::size_t>(count)};
  for (std::size_t i = 0; i < before.costs.size(); ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const auto cost = before.costs[i] + passes.costs(passes.first[before.place] + i, passes.first[place] + j);
      if (cost >= result.costs[j]) continue;
      result.costs[j] = cost;
      result.from[j] = i;
    }
  for (auto& cost : result.costs) cost += service;
  return result;
}

std::size_t cheapest(const Reached& reached) {
  return static_cast<std::size_t>(std::ranges::min_element(reached.costs) - reached.costs.begin());
}

double expected_leg(const PassCosts& passes, std::size_t from, std::size_t to, bool begins_anyhow) {
  double sum = 0;
  double least = unlimited;
  double count = 0;
  for (auto a = passes.first[from]; a < passes.first[from + 1]; ++a) {
    double best = unlimited;
    for (auto b = passes.first[to]; b < passes.first[to + 1]; ++b) best = std::min(best, passes.costs(a, b));
    if (std::isinf(best)) continue;
    least = std::min(least, best);
    sum += best;
    ++count;
  }
  return begins_anyhow || count == 0 ? least : (least + sum / count) / 2;
}

}  // namespace

CostMatrix expected(const PassCosts& passes, std::size_t stops) {
  CostMatrix result{passes.places()};
  for (std::size_t from = 0; from < passes.places(); ++from)
    for (std::size_t to = 0; to < passes.places(); ++to)
      result(from, to) = expected_leg(passes, from, to, from >= stops);
  return result;
}

PassedRoute best_passes(const PassProblem& problem, const Vehicle& vehicle, const std::vector<std::size_t>& route) {
  PassedRoute result{.cost = 0, .passes = {}, .end = vehicle.start};
  if (route.empty()) return result;
  const auto& passes = problem.classes[vehicle.costs];
  std::vector<Reached> way{begun(passes, vehicle.start)};
  for (const auto stop : route) way.push_back(gone_on(passes, way.back(), stop, problem.problem.stops[stop].service));
  std::optional<Reached> best_end;
  for (const auto end : vehicle.ends) {
    auto there = gone_on(passes, way.back(), end, 0);
    if (!best_end || std::ranges::min(there.costs) < std::ranges::min(best_end->costs)) best_end = std::move(there);
  }
  if (best_end) way.push_back(std::move(*best_end));
  result.end = way.back().place;
  result.cost = std::ranges::min(way.back().costs);
  result.passes.resize(way.size());
  auto pass = cheapest(way.back());
  for (auto at = way.size(); at-- > 0;) {
    result.passes[at] = pass;
    if (at > 0) pass = way[at].from[pass];
  }
  return result;
}

std::vector<Unvisited> unvisited(const PassProblem& problem, const Plan& plan) {
  return unvisited(problem.problem, plan, [&](const Vehicle& vehicle, std::size_t stop) {
    return best_passes(problem, vehicle, {stop}).cost;
  });
}

}  // namespace ponte::planning
