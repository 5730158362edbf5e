#include "ponte/planning/pass_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ponte::planning {
namespace {

constexpr Node neighbours = 10;
constexpr std::uint32_t run_max = 3;
// The highest temperature in mean legs.
constexpr double hottest_legs = 0.5;
constexpr int halvings = 6;
constexpr std::uint64_t first_tries_per_stop = 20;

Neighbours nearest(const Problem& problem) {
  const Legs legs{problem};
  return {legs.stops(), neighbours, [&](Node a, Node b) { return legs.distance(a, b); }};
}

}  // namespace

PassSearch::PassSearch(PassProblem problem, Plan plan, std::uint64_t seed)
    : problem_{std::move(problem)},
      near_{nearest(problem_.problem)},
      random_{seed},
      plan_{shortened(std::move(plan))},
      costs_{costs_of(plan_)},
      score_{score(plan_, costs_)},
      cooling_{hottest_legs * score_.total / static_cast<double>(problem_.problem.stops.size() + 1), halvings,
               first_tries_per_stop * (problem_.problem.stops.size() + 1)},
      best_{plan_},
      best_score_{score_} {}

bool PassSearch::holds(std::size_t index, const Route& route, double cost) const {
  return std::isfinite(cost) && cost <= vehicle(index).endurance && std::ranges::all_of(route, [&](std::size_t stop) {
           return problem_.problem.stops[stop].quality_needed <= vehicle(index).quality;
         });
}

Plan PassSearch::shortened(Plan plan) const {
  for (std::size_t i = 0; i < plan.routes.size(); ++i) shorten(i, plan.routes[i]);
  return plan;
}

std::vector<double> PassSearch::costs_of(const Plan& plan) const {
  std::vector<double> costs;
  for (std::size_t i = 0; i < plan.routes.size(); ++i)
    costs.push_back(best_passes(problem_, vehicle(i), plan.routes[i]).cost);
  return costs;
}

void PassSearch::shorten(std::size_t index, Route& route) const {
  auto cost = best_passes(problem_, vehicle(index), route).cost;
  while (!holds(index, route, cost)) {
    // Of stops with the least priority the one without which the route is cheapest.
    auto lost = route.size();
    for (std::size_t i = 0; i < route.size(); ++i) {
      auto rest = route;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      const auto rest_cost = best_passes(problem_, vehicle(index), rest).cost;
      const auto priority = [&](std::size_t at) { return problem_.problem.stops[route[at]].priority; };
      if (lost < route.size() && std::pair{priority(i), rest_cost} >= std::pair{priority(lost), cost}) continue;
      lost = i;
      cost = rest_cost;
    }
    route.erase(route.begin() + static_cast<std::ptrdiff_t>(lost));
  }
}

PassSearch::Spot PassSearch::spot_of(std::size_t stop) const {
  for (std::size_t i = 0; i < plan_.routes.size(); ++i)
    if (const auto found = std::ranges::find(plan_.routes[i], stop); found != plan_.routes[i].end())
      return {i, static_cast<std::size_t>(found - plan_.routes[i].begin())};
  return {plan_.routes.size(), 0};
}

std::size_t PassSearch::any_stop() { return random_.below(static_cast<std::uint32_t>(problem_.problem.stops.size())); }

void PassSearch::improve(std::uint64_t tries) {
  if (problem_.problem.stops.empty()) return;
  for (; tries > 0; --tries) {
    switch (random_.below(4)) {
      case 0: turn_round(); break;
      case 1: exchange(); break;
      default: move_run(); break;
    }
  }
}

/// Behind a near stop, or to the beginning of a route.
void PassSearch::move_run() {
  const auto stop = any_stop();
  const auto [from, index] = spot_of(stop);
  Route run{stop};
  std::vector<std::pair<std::size_t, Route>> changes;
  if (from < plan_.routes.size()) {
    auto rest = plan_.routes[from];
    const auto length = std::min<std::size_t>(1 + random_.below(run_max), rest.size() - index);
    const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(index);
    run.assign(begin, begin + static_cast<std::ptrdiff_t>(length));
    rest.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
    changes.emplace_back(from, std::move(rest));
  }
  if (random_.chance(0.5)) std::ranges::reverse(run);

  auto to = random_.below(static_cast<std::uint32_t>(plan_.routes.size()));
  std::size_t behind = 0;
  const auto near = near_.of(static_cast<Node>(stop));
  if (!near.empty() && random_.chance(0.8)) {
    const auto other = near[random_.below(static_cast<std::uint32_t>(near.size()))];
    const auto spot = spot_of(other);
    if (spot.vehicle == plan_.routes.size() || std::ranges::find(run, other) != run.end()) return;
    to = static_cast<std::uint32_t>(spot.vehicle);
    behind = spot.index + (random_.chance(0.5) ? 1 : 0);
    if (to == from && spot.index > index) behind -= run.size();
  }
  if (to != from) changes.emplace_back(to, plan_.routes[to]);
  auto& target = changes.back().second;
  target.insert(target.begin() + static_cast<std::ptrdiff_t>(behind), run.begin(), run.end());
  judge(std::move(changes));
}

void PassSearch::turn_round() {
  const auto [at, index] = spot_of(any_stop());
  if (at == plan_.routes.size()) return;
  auto route = plan_.routes[at];
  const auto end = index + 1 + random_.below(static_cast<std::uint32_t>(route.size() - index));
  std::reverse(route.begin() + static_cast<std::ptrdiff_t>(index), route.begin() + static_cast<std::ptrdiff_t>(end));
  judge({{at, std::move(route)}});
}

/// One of them may be unvisited.
void PassSearch::exchange() {
  const auto stop = any_stop();
  const auto other = any_stop();
  const auto a = spot_of(stop);
  const auto b = spot_of(other);
  std::vector<std::pair<std::size_t, Route>> changes;
  for (const auto index : {a.vehicle, b.vehicle})
    if (index < plan_.routes.size() && (changes.empty() || changes.front().first != index))
      changes.emplace_back(index, plan_.routes[index]);
  for (auto& [index, route] : changes) {
    if (index == a.vehicle) route[a.index] = other;
    if (index == b.vehicle) route[b.index] = stop;
  }
  judge(std::move(changes));
}

void PassSearch::judge(std::vector<std::pair<std::size_t, Route>> changes) {
  auto costs = costs_;
  for (auto& [index, route] : changes) {
    costs[index] = best_passes(problem_, vehicle(index), route).cost;
    if (!holds(index, route, costs[index])) return;
  }
  const auto exchange_routes = [&] {
    for (auto& [index, route] : changes) std::swap(plan_.routes[index], route);
  };
  exchange_routes();
  const auto changed = score(plan_, costs);
  const auto tolerance = cooling_.temperature() * random_.exponential();
  cooling_.step();
  if (changed.unvisited_priority > score_.unvisited_priority || smooth(changed) > smooth(score_) + tolerance) {
    exchange_routes();
    return;
  }
  score_ = changed;
  costs_ = std::move(costs);
  if (!is_better(score_, best_score_)) return;
  best_score_ = score_;
  best_ = plan_;
}

PassSearch::Score PassSearch::score(const Plan& plan, const std::vector<double>& costs) const {
  Score result;
  for (const auto& stop : problem_.problem.stops) result.unvisited_priority += ticks(stop.priority);
  for (std::size_t i = 0; i < plan.routes.size(); ++i) {
    for (const auto stop : plan.routes[i]) result.unvisited_priority -= ticks(problem_.problem.stops[stop].priority);
    result.total += costs[i];
    result.longest = std::max(result.longest, costs[i]);
  }
  return result;
}

/// The objective, and where that is the longest route a little of the others.
double PassSearch::smooth(const Score& score) const {
  constexpr double share_of_others = 0.001;
  return problem_.problem.objective == Objective::total ? score.total : score.longest + share_of_others * score.total;
}

bool PassSearch::is_better(const Score& a, const Score& b) const {
  if (problem_.problem.objective == Objective::total)
    return std::tie(a.unvisited_priority, a.total) < std::tie(b.unvisited_priority, b.total);
  return std::tie(a.unvisited_priority, a.longest, a.total) < std::tie(b.unvisited_priority, b.longest, b.total);
}

}  // namespace ponte::planning
