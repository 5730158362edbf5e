#include "ponte/planning/problem.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace ponte::planning {
namespace {

using ::testing::HasSubstr;

/// Two stops on a line at 10 and 20 from home, which is place 2; each visit takes 1.
Problem line() {
  Problem problem{.stops = {{.service = 1}, {.service = 1}}, .vehicles = {{.start = 2, .ends = {2}}}, .costs = {}};
  CostMatrix costs{3};
  costs(2, 0) = costs(0, 2) = costs(0, 1) = costs(1, 0) = 10;
  costs(2, 1) = costs(1, 2) = 20;
  problem.costs.push_back(costs);
  return problem;
}

TEST(RouteCost, CountsLegsVisitsAndTheWayToTheEnd) {
  const auto problem = line();
  EXPECT_EQ(route_cost(problem, problem.vehicles[0], {0, 1}), 42);
  EXPECT_EQ(route_cost(problem, problem.vehicles[0], {}), 0);
}

TEST(RouteCost, EndsAtTheLastStopOrAtTheCheapestEnd) {
  auto problem = line();
  auto& vehicle = problem.vehicles[0];
  vehicle.ends = {};
  EXPECT_EQ(route_cost(problem, vehicle, {0, 1}), 22);
  EXPECT_EQ(route_end(problem, vehicle, {0, 1}), 1U);
  vehicle.ends = {2, 0};
  EXPECT_EQ(route_cost(problem, vehicle, {0, 1}), 32);
  EXPECT_EQ(route_end(problem, vehicle, {0, 1}), 0U);
}

TEST(Unvisited, SaysWhy) {
  auto problem = line();
  problem.stops.resize(4);
  problem.stops[1].quality_needed = 0.5;
  CostMatrix costs{5};
  costs(4, 3) = unlimited;
  costs(4, 2) = costs(2, 4) = 100;
  problem.costs = {costs};
  problem.vehicles = {{.start = 4, .ends = {4}, .endurance = 50}};
  const auto reasons = unvisited(problem, Plan{{{}}});
  ASSERT_EQ(reasons.size(), 4U);
  EXPECT_EQ(reasons[0].reason, UnvisitedReason::outweighed);
  EXPECT_EQ(reasons[1].reason, UnvisitedReason::no_sensor);
  EXPECT_EQ(reasons[2].reason, UnvisitedReason::too_far);
  EXPECT_EQ(reasons[2].cost_alone, 200);
  EXPECT_EQ(reasons[3].reason, UnvisitedReason::no_way);
  EXPECT_EQ(unvisited(problem, Plan{{{0, 2}}}).size(), 2U);
}

TEST(CheckProblem, RefusesWhatIsNone) {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  const auto error_after = [](auto change) {
    auto problem = line();
    change(problem);
    const auto checked = check(problem);
    return checked ? "" : checked.error();
  };
  EXPECT_EQ(error_after([](Problem&) {}), "");
  EXPECT_EQ(error_after([](Problem& p) { p.vehicles.clear(); }), "there is no vehicle");
  EXPECT_EQ(error_after([](Problem& p) { p.vehicles[0].start = 3; }), "vehicle 0: there is no place 3");
  EXPECT_EQ(error_after([](Problem& p) { p.vehicles[0].ends = {7}; }), "vehicle 0: there is no place 7");
  EXPECT_EQ(error_after([](Problem& p) { p.vehicles[0].costs = 1; }), "vehicle 0: there is no cost matrix 1");
  EXPECT_THAT(error_after([](Problem& p) { p.vehicles[0].endurance = -1; }), HasSubstr("endurance -1"));
  EXPECT_THAT(error_after([](Problem& p) { p.vehicles[0].endurance = nan; }), HasSubstr("endurance nan"));
  EXPECT_THAT(error_after([](Problem& p) { p.vehicles[0].quality = nan; }), HasSubstr("sensor quality"));
  EXPECT_THAT(error_after([](Problem& p) { p.stops[1].service = unlimited; }), HasSubstr("stop 1: a visit of inf"));
  EXPECT_THAT(error_after([](Problem& p) { p.stops[1].priority = 0; }), HasSubstr("stop 1: priority 0"));
  EXPECT_THAT(error_after([](Problem& p) { p.stops[0].quality_needed = nan; }), HasSubstr("quality needed"));
  EXPECT_THAT(error_after([](Problem& p) { p.costs[0](1, 2) = -5; }), HasSubstr("cost matrix 0: -5 from 1 to 2"));
  EXPECT_THAT(error_after([](Problem& p) { p.costs[0](1, 2) = 1e9; }), HasSubstr("1000000000 from 1 to 2"));
  EXPECT_THAT(error_after([](Problem& p) { p.stops.resize(4); }), HasSubstr("3 places are too few for 4 stops"));
}

}  // namespace
}  // namespace ponte::planning
