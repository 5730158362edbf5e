#include "ponte/planning/solver.hpp"

#include "ponte/planning/test_problems.hpp"
#include "ponte/planning/tour_search.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ponte::planning {
namespace {

using testing::broken_constraint;
using testing::is_worse;

using Routes = std::vector<std::vector<std::size_t>>;

Plan solved(const Problem& problem, std::uint64_t seed, std::uint64_t tries, Method method = Method::best) {
  const auto solver = make_solver(problem, method, seed);
  solver->improve(tries);
  return solver->best();
}

/// The least cost of one route of this vehicle through exactly the stops of each set, by Held and Karp's recursion.
/// Sets are bit masks; the stops of a set that no route can visit cost infinity.
std::vector<double> best_routes(const Problem& problem, const Vehicle& vehicle) {
  const auto stops = problem.stops.size();
  const auto sets = std::size_t{1} << stops;
  const auto& costs = problem.costs[vehicle.costs];
  std::vector<double> ending_at(sets * stops, unlimited);
  std::vector<double> result(sets, unlimited);
  result[0] = 0;
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < stops; ++last) {
      const auto before = set & ~(std::size_t{1} << last);
      if (before == set || problem.stops[last].quality_needed > vehicle.quality) continue;
      auto& cost = ending_at[set * stops + last];
      if (before == 0) cost = costs(vehicle.start, last);
      for (std::size_t previous = 0; previous < stops; ++previous)
        cost = std::min(cost, ending_at[before * stops + previous] + costs(previous, last));
      cost += problem.stops[last].service;
      result[set] = std::min(result[set], cost + cost_to_end(costs, vehicle, last));
    }
    if (result[set] > vehicle.endurance) result[set] = unlimited;
  }
  return result;
}

/// The best figures that any plan can have: every split of the stops among the vehicles and nobody is looked at.
PlanFigures best_figures(const Problem& problem) {
  const auto sets = std::size_t{1} << problem.stops.size();
  const PlanFigures nothing{unlimited, unlimited, unlimited};
  std::vector<PlanFigures> best(sets, nothing);
  best[0] = {};
  const auto is_less = [&](const PlanFigures& a, const PlanFigures& b) {
    return problem.objective == Objective::total ? a.total < b.total
                                                 : std::tie(a.longest, a.total) < std::tie(b.longest, b.total);
  };
  for (const auto& vehicle : problem.vehicles) {
    const auto routes = best_routes(problem, vehicle);
    auto next = best;
    for (std::size_t set = 0; set < sets; ++set)
      for (auto own = set; own != 0; own = (own - 1) & set) {
        const auto& others = best[set & ~own];
        const PlanFigures all{0, std::max(others.longest, routes[own]), others.total + routes[own]};
        if (is_less(all, next[set])) next[set] = all;
      }
    best = next;
  }
  auto result = nothing;
  for (std::size_t set = 0; set < sets; ++set) {
    if (!std::isfinite(best[set].total)) continue;
    auto each = best[set];
    for (std::size_t stop = 0; stop < problem.stops.size(); ++stop)
      if ((set >> stop & 1U) == 0) each.unvisited_priority += problem.stops[stop].priority;
    if (each.unvisited_priority < result.unvisited_priority ||
        (each.unvisited_priority == result.unvisited_priority && is_less(each, result)))
      result = each;
  }
  return result;
}

/// With as many tries, or, of a seed that is hard to it, a few times as many.
void expect_best(const Problem& problem, std::uint64_t seed, std::uint64_t tries) {
  const auto wanted = best_figures(problem);
  const auto is_best = [&](const Plan& plan) {
    const auto found = figures(problem, plan);
    if (found.unvisited_priority != wanted.unvisited_priority) return false;
    return problem.objective == Objective::total ? std::abs(found.total - wanted.total) <= 1e-3
                                                 : std::abs(found.longest - wanted.longest) <= 1e-3;
  };
  auto plan = solved(problem, seed, tries);
  for (auto more = 2 * tries; more <= 64 * tries && !is_best(plan); more *= 2) plan = solved(problem, seed, more);
  ASSERT_EQ(broken_constraint(problem, plan), "") << "seed " << seed;
  const auto found = figures(problem, plan);
  EXPECT_EQ(found.unvisited_priority, wanted.unvisited_priority) << "seed " << seed;
  if (problem.objective == Objective::total)
    EXPECT_NEAR(found.total, wanted.total, 1e-3) << "seed " << seed;
  else
    EXPECT_NEAR(found.longest, wanted.longest, 1e-3) << "seed " << seed;
}

TEST(SolverSeeded, FindsTheBestTourOfNineStops) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 20; ++seed) {
    Random random{seed};
    const auto problem = testing::one_tour(random, 9);
    ASSERT_TRUE(TourSearch::fits(problem));
    expect_best(problem, seed, 300);
  }
}

TEST(SolverSeeded, FindsTheBestTourThatEndsElsewhereOrAtTheLastStop) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 20; ++seed) {
    Random random{seed};
    auto problem = testing::one_tour(random, 9);
    problem.vehicles[0].ends.clear();
    ASSERT_TRUE(TourSearch::fits(problem));
    expect_best(problem, seed, 300);
    problem.costs[0] = testing::random_costs(random, 12);
    problem.vehicles[0].ends = {10, 11};
    ASSERT_TRUE(TourSearch::fits(problem));
    expect_best(problem, seed, 300);
  }
}

TEST(SolverSeeded, FindsTheBestTourInWind) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 20; ++seed) {
    Random random{seed};
    const auto problem = testing::one_tour(random, 8, 0.4);
    ASSERT_FALSE(TourSearch::fits(problem));
    expect_best(problem, seed, 3000);
  }
}

TEST(SolverSeeded, FindsTheBestPlanOfSmallMixedProblems) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 20; ++seed) {
    Random random{seed};
    auto problem = testing::mixed_problem(random, 7);
    for (auto& vehicle : problem.vehicles) vehicle.endurance = std::min(vehicle.endurance, 1500.0);
    expect_best(problem, seed, 5000);
  }
}

TEST(SolverSeeded, HoldsEveryConstraintAndIsNeverWorseThanItsStart) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 10; ++seed) {
    for (const auto method : {Method::best, Method::annealing}) {
      Random random{seed};
      const auto problem = testing::mixed_problem(random, 1 + random.below(60));
      ASSERT_TRUE(check(problem).has_value());
      const auto solver = make_solver(problem, method, seed);
      auto best = solver->best();
      for (int round = 0; round < 20; ++round) {
        EXPECT_EQ(broken_constraint(problem, best), "") << "seed " << seed << ", round " << round;
        solver->improve(100);
        EXPECT_FALSE(is_worse(problem, solver->best(), best)) << "seed " << seed << ", round " << round;
        best = solver->best();
      }
      std::size_t visited = 0;
      for (const auto& route : best.routes) visited += route.size();
      EXPECT_EQ(visited + unvisited(problem, best).size(), problem.stops.size()) << "seed " << seed;
    }
  }
}

TEST(SolverSeeded, GivesTheSamePlanForTheSameSeedInWhateverPortions) {
  const auto seed = chosen_seed();
  Random random{seed};
  for (const auto& problem : {testing::mixed_problem(random, 40), testing::one_tour(random, 40)}) {
    for (const auto method : {Method::best, Method::annealing}) {
      const auto solver = make_solver(problem, method, seed);
      for (int portion = 0; portion < 100; ++portion) solver->improve(10);
      EXPECT_EQ(solver->best(), solved(problem, seed, 1000, method)) << "seed " << seed;
    }
  }
}

// g++ and clang run this test; so both give this plan.
TEST(Solver, GivesThisPlanWithEveryCompiler) {
  Random random{1};
  const auto mixed = testing::mixed_problem(random, 12);
  const auto tour = testing::one_tour(random, 12);
  EXPECT_EQ(solved(mixed, 1, 500).routes, (Routes{{3, 4, 2, 10}, {5, 1, 8, 11, 0}, {6, 7}}));
  EXPECT_EQ(solved(tour, 1, 500).routes, (Routes{{7, 0, 3, 5, 6, 4, 10, 8, 9, 11, 1, 2}}));
  EXPECT_EQ(solved(mixed, 1, 500, Method::annealing).routes, (Routes{{4, 11, 2, 10}, {0, 7, 8, 5, 9, 3}, {6}}));
}

TEST(Solver, KnowsWhatToDoWithNothingAndWithOneStop) {
  Random random{1};
  EXPECT_EQ(solved(testing::one_tour(random, 0), 1, 10).routes, (Routes{{}}));
  EXPECT_EQ(solved(testing::one_tour(random, 1), 1, 10).routes, (Routes{{0}}));
  EXPECT_EQ(solved(testing::one_tour(random, 0), 1, 10, Method::annealing).routes, (Routes{{}}));
}

TEST(Solver, SurvivesStopsAtOneAndTheSamePlace) {
  Problem problem{.stops = std::vector<Stop>(20), .vehicles = {{.start = 20, .ends = {20}}}, .costs = {CostMatrix{21}}};
  EXPECT_EQ(broken_constraint(problem, solved(problem, 1, 200)), "");
  EXPECT_EQ(solved(problem, 1, 200).routes[0].size(), 20U);
  problem.vehicles[0].endurance = 0;
  EXPECT_EQ(solved(problem, 1, 200).routes[0].size(), 20U);
}

TEST(Solver, BeatsAnnealingOnALargeTour) {
  Random random{3};
  const auto problem = testing::one_tour(random, 150);
  EXPECT_TRUE(is_worse(problem, solved(problem, 1, 2000, Method::annealing), solved(problem, 1, 2000)));
}

}  // namespace
}  // namespace ponte::planning
