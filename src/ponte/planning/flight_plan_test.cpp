#include "ponte/planning/flight_plan.hpp"

#include "ponte/planning/solver.hpp"

#include <gmock/gmock.h>

namespace ponte::planning {
namespace {

using vehicle::Place;

const Place home{radians_from_degrees(-30.0667), radians_from_degrees(-51.1221)};

Place at(double east, double north) { return Map{home}.place({east, north}); }

Task task_with(const std::vector<Place>& places) {
  Task task;
  for (const auto& place : places) task.points.push_back({.place = place});
  task.crafts = {{.start = home,
                  .ends = {home},
                  .speed = MetresPerSecond{10},
                  .sets_speed = true,
                  .vertical_speed = MetresPerSecond{2}}};
  task.margin = Metres{5};
  task.altitude = {Metres{40}, vehicle::AltitudeFrame::home};
  return task;
}

TEST(GroundSpeed, AddsTheWindFromBehindAndTakesItFromAhead) {
  const Wind west_wind{MetresPerSecond{6}, radians_from_degrees(270)};
  EXPECT_NEAR(ground_speed(MetresPerSecond{10}, radians_from_degrees(90), west_wind).value, 16, 1e-9);
  EXPECT_NEAR(ground_speed(MetresPerSecond{10}, radians_from_degrees(270), west_wind).value, 4, 1e-9);
  EXPECT_NEAR(ground_speed(MetresPerSecond{10}, radians_from_degrees(0), west_wind).value, 8, 1e-9);
  EXPECT_EQ(ground_speed(MetresPerSecond{5}, radians_from_degrees(0), west_wind).value, 0);
}

TEST(FlightPlanner, CountsLegsDwellClimbAndDescent) {
  auto task = task_with({at(1000, 0)});
  task.points[0].dwell = vehicle::Seconds{30};
  const FlightPlanner planner{task};
  ASSERT_TRUE(check(planner.problem()).has_value());
  const auto flights = planner.flights(Plan{{{0}}});
  EXPECT_NEAR(flights[0].length.value, 2000, 0.01);
  EXPECT_NEAR(flights[0].time.count(), 200 + 30 + 40, 0.01);
}

TEST(FlightPlanner, FindsThatWindMakesTheWayBackDearer) {
  auto task = task_with({at(1000, 0)});
  task.wind = {MetresPerSecond{6}, radians_from_degrees(270)};
  const FlightPlanner planner{task};
  EXPECT_NEAR(planner.problem().costs[0](1, 0), 1000.0 / 16, 0.01);
  EXPECT_NEAR(planner.problem().costs[0](0, 1), 1000.0 / 4, 0.01);
  task.wind.speed = MetresPerSecond{11};
  EXPECT_EQ(FlightPlanner{task}.problem().costs[0](0, 1), unlimited);
}

TEST(FlightPlanner, FliesRoundZonesAndCannotReachWhatIsInOne) {
  auto task = task_with({at(1000, 0), at(500, 0)});
  task.fence.fence_polygons.push_back({{at(400, -100), at(600, -100), at(600, 300), at(400, 300)}, false});
  const FlightPlanner planner{task};
  const auto solver = make_solver(planner.problem(), Method::best, 1);
  solver->improve(10);
  EXPECT_EQ(solver->best(), (Plan{{{0}}}));
  EXPECT_EQ(unvisited(planner.problem(), solver->best())[0].reason, UnvisitedReason::no_way);
  const auto flight = planner.flights(solver->best())[0];
  EXPECT_EQ(flight.legs[0].turns.size(), 2U);
  EXPECT_EQ(flight.legs[1].turns.size(), 2U);
  const auto mission = mission_of(task.crafts[0], flight, task.points, {});
  EXPECT_EQ(mission.items.size(), 8U);  // take-off, speed, two turns, the point, two turns, return
}

TEST(MissionOf, LandsWhereItEndsAndReturnsHome) {
  auto task = task_with({at(100, 0)});
  const auto last_action = [&] {
    const FlightPlanner planner{task};
    return mission_of(task.crafts[0], planner.flights(Plan{{{0}}})[0], task.points, {}).items.back().action;
  };
  EXPECT_TRUE(std::holds_alternative<vehicle::ReturnItem>(last_action()));
  task.crafts[0].ends = {};
  EXPECT_EQ(std::get<vehicle::LandItem>(last_action()).place, at(100, 0));
  task.crafts[0].ends = {at(200, 0)};
  EXPECT_EQ(std::get<vehicle::LandItem>(last_action()).place, at(200, 0));
}

TEST(MissionOf, SaysDwellPicturesWaitAndLayer) {
  auto task = task_with({at(100, 0)});
  task.points[0].dwell = vehicle::Seconds{7};
  const FlightPlanner planner{task};
  const auto mission = mission_of(task.crafts[0], planner.flights(Plan{{{0}}})[0], task.points,
                                  {.added_altitude = Metres{10}, .wait = vehicle::Seconds{20}, .takes_pictures = true});
  ASSERT_EQ(mission.items.size(), 6U);
  EXPECT_EQ(std::get<vehicle::DelayItem>(mission.items[0].action).duration.count(), 20);
  EXPECT_EQ(std::get<vehicle::TakeOffItem>(mission.items[1].action).altitude.height.value, 50);
  EXPECT_EQ(std::get<vehicle::WaypointItem>(mission.items[3].action).dwell.count(), 7);
  EXPECT_EQ(std::get<vehicle::TakePicturesItem>(mission.items[4].action).count, 1U);
}

TEST(Layers, PartsRoutesThatCrossOrComeNear) {
  auto task = task_with({at(1000, 1000), at(1000, 0), at(5000, 5000)});
  task.crafts = {task.crafts[0], task.crafts[0], task.crafts[0]};
  for (auto& craft : task.crafts) craft.ends = {};
  task.crafts[1].start = at(0, 1000);
  task.crafts[2].start = at(4000, 5000);
  const FlightPlanner planner{task};
  EXPECT_THAT(layers(task.crafts, planner.flights(Plan{{{0}, {1}, {2}}}), Metres{20}), ::testing::ElementsAre(0, 1, 0));
}

}  // namespace
}  // namespace ponte::planning
