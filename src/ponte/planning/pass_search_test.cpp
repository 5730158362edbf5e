#include "ponte/planning/pass_search.hpp"

#include "ponte/planning/test_problems.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace ponte::planning {
namespace {

/// Legs that cost what chance says, from each pass to each.
PassProblem random_problem(Random& random, std::size_t stops, std::size_t vehicles) {
  PassProblem result;
  auto& problem = result.problem;
  problem.stops.resize(stops);
  for (auto& stop : problem.stops) stop.service = random.below(3);
  PassCosts passes{.first = {0}, .costs = CostMatrix{0}};
  for (std::size_t place = 0; place < stops + vehicles; ++place)
    passes.first.push_back(passes.first.back() + 1 + random.below(3));
  passes.costs = CostMatrix{passes.first.back()};
  for (std::size_t a = 0; a < passes.first.back(); ++a)
    for (std::size_t b = 0; b < passes.first.back(); ++b) passes.costs(a, b) = 1 + random.below(100);
  for (std::size_t i = 0; i < vehicles; ++i) problem.vehicles.push_back({.start = stops + i, .ends = {stops + i}});
  problem.costs = {expected(passes, stops)};
  result.classes = {std::move(passes)};
  return result;
}

/// By trying every way of passing.
double least_cost(const PassProblem& problem, const Vehicle& vehicle, const std::vector<std::size_t>& route) {
  const auto& passes = problem.classes[vehicle.costs];
  auto places = route;
  places.insert(places.begin(), vehicle.start);
  places.push_back(vehicle.ends.front());
  std::vector<std::size_t> choice(places.size());
  double best = unlimited;
  while (true) {
    double sum = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
      sum += passes.costs(passes.first[places[i - 1]] + choice[i - 1], passes.first[places[i]] + choice[i]);
    for (const auto stop : route) sum += problem.problem.stops[stop].service;
    best = std::min(best, sum);
    std::size_t i = 0;
    while (i < choice.size() && ++choice[i] == passes.passes(places[i])) choice[i++] = 0;
    if (i == choice.size()) return best;
  }
}

double cost_of(const PassProblem& problem, const Plan& plan, std::size_t index) {
  return best_passes(problem, problem.problem.vehicles[index], plan.routes[index]).cost;
}

TEST(PassProblemSeeded, FindsTheBestPassesOfARoute) {
  const auto seed = chosen_seed();
  Random random{seed};
  for (int i = 0; i < 30; ++i) {
    const auto problem = random_problem(random, 5, 1);
    const auto& vehicle = problem.problem.vehicles[0];
    const std::vector<std::size_t> route{3, 1, 4, 0, 2};
    const auto found = best_passes(problem, vehicle, route);
    EXPECT_EQ(found.cost, least_cost(problem, vehicle, route)) << "seed " << seed;
    EXPECT_EQ(found.passes.size(), route.size() + 2);
    EXPECT_EQ(found.end, 5U);
  }
}

TEST(PassProblem, ExpectsLegsBetweenTheLeastAndTheMean) {
  PassCosts passes{.first = {0, 2, 4}, .costs = CostMatrix{4}};
  passes.costs(0, 2) = 10;
  passes.costs(0, 3) = 20;
  passes.costs(1, 2) = 40;
  passes.costs(1, 3) = 30;
  EXPECT_EQ(expected(passes, 2)(0, 1), 15);  // the best ways on cost 10 and 30
  EXPECT_EQ(expected(passes, 0)(0, 1), 10);
  passes.costs(1, 2) = passes.costs(1, 3) = unlimited;
  EXPECT_EQ(expected(passes, 2)(0, 1), 10);
}

TEST(PassSearchSeeded, FindsTheBestPlanOfSmallProblems) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 10; ++seed) {
    Random random{seed};
    const auto problem = random_problem(random, 6, 1);
    std::vector<std::size_t> order(6);
    std::iota(order.begin(), order.end(), std::size_t{0});
    PassSearch search{problem, Plan{{order}}, seed};
    double best = unlimited;
    do best = std::min(best, best_passes(problem, problem.problem.vehicles[0], order).cost);
    while (std::ranges::next_permutation(order).found);
    for (int again = 0; again < 30 && cost_of(problem, search.best(), 0) > best; ++again) search.improve(10'000);
    EXPECT_EQ(cost_of(problem, search.best(), 0), best) << "seed " << seed;
  }
}

TEST(PassSearchSeeded, HoldsEveryConstraintAndIsNeverWorseThanItsStart) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 10; ++seed) {
    Random random{seed};
    auto problem = random_problem(random, 20, 2);
    for (auto& stop : problem.problem.stops) {
      stop.priority = 1 + random.below(3);
      stop.quality_needed = random.below(2);
    }
    problem.problem.vehicles[0].quality = 1;
    problem.problem.vehicles[1].endurance = 60;
    problem.problem.objective = random.chance(0.5) ? Objective::total : Objective::longest;
    Plan start{{{}, {}}};
    for (std::size_t stop = 0; stop < 20; ++stop)
      start.routes[problem.problem.stops[stop].quality_needed > 0 ? 0 : 1].push_back(stop);
    PassSearch search{problem, start, seed};
    const auto figure = [&] {
      const auto plan = search.best();
      double unvisited_priority = 0;
      for (const auto& each : unvisited(problem, plan)) unvisited_priority += problem.problem.stops[each.stop].priority;
      const auto a = cost_of(problem, plan, 0);
      const auto b = cost_of(problem, plan, 1);
      return std::pair{unvisited_priority, problem.problem.objective == Objective::total ? a + b : std::max(a, b)};
    };
    auto before = figure();
    for (int round = 0; round < 20; ++round) {
      search.improve(50);
      EXPECT_LE(figure(), before) << "seed " << seed;
      before = figure();
      EXPECT_LE(cost_of(problem, search.best(), 1), 60) << "seed " << seed;
      std::vector<int> visits(20);
      const auto plan = search.best();
      for (std::size_t i = 0; i < 2; ++i)
        for (const auto stop : plan.routes[i]) {
          EXPECT_EQ(++visits[stop], 1) << "seed " << seed;
          EXPECT_LE(problem.problem.stops[stop].quality_needed, problem.problem.vehicles[i].quality);
        }
    }
  }
}

TEST(PassSearch, LeavesOutWhatMattersLeastWhenTheTrueCostsAreBeyondTheEndurance) {
  PassProblem problem;
  problem.problem.stops = {{.priority = 5}, {.priority = 1}, {.priority = 5}};
  problem.problem.vehicles = {{.start = 3, .ends = {3}, .endurance = 35}};
  PassCosts passes{.first = {0, 1, 2, 3, 4}, .costs = CostMatrix{4}};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b) passes.costs(a, b) = 10;
  problem.problem.costs = {expected(passes, 3)};
  problem.classes = {passes};
  PassSearch search{problem, Plan{{{0, 1, 2}}}, 1};
  search.improve(100);
  EXPECT_EQ(search.best().routes[0].size(), 2U);
  const auto left = unvisited(problem, search.best());
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].stop, 1U);
  EXPECT_EQ(left[0].reason, UnvisitedReason::outweighed);
  EXPECT_EQ(left[0].cost_alone, 20);
}

}  // namespace
}  // namespace ponte::planning
