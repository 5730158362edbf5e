#include "ponte/planning/flight_plan.hpp"

#include "ponte/core/random.hpp"
#include "ponte/planning/flight_mission.hpp"
#include "ponte/planning/pass_search.hpp"
#include "ponte/planning/plane.hpp"
#include "ponte/planning/solver.hpp"
#include "support/seed.hpp"

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
  const auto mission = mission_of(task, 0, flight, false);
  EXPECT_EQ(mission.items.size(), 8U);  // take-off, speed, two turns, the point, two turns, return
}

TEST(MissionOf, LandsWhereItEndsAndReturnsHome) {
  auto task = task_with({at(100, 0)});
  const auto last_action = [&] {
    const FlightPlanner planner{task};
    return mission_of(task, 0, planner.flights(Plan{{{0}}})[0], false).items.back().action;
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
  auto flight = planner.flights(Plan{{{0}}})[0];
  flight.added_altitude = Metres{10};
  flight.wait = vehicle::Seconds{20};
  const auto mission = mission_of(task, 0, flight, true);
  ASSERT_EQ(mission.items.size(), 7U);
  EXPECT_EQ(std::get<vehicle::DelayItem>(mission.items[0].action).duration.count(), 20);
  EXPECT_EQ(std::get<vehicle::TakeOffItem>(mission.items[1].action).altitude.height.value, 50);
  EXPECT_EQ(std::get<vehicle::WaypointItem>(mission.items[3].action).dwell.count(), 7);
  EXPECT_EQ(std::get<vehicle::TakePicturesItem>(mission.items[4].action).count, 1U);
  // It comes home in its layer, and not as its autopilot would.
  EXPECT_EQ(std::get<vehicle::WaypointItem>(mission.items[5].action).altitude.height.value, 50);
  EXPECT_EQ(std::get<vehicle::LandItem>(mission.items[6].action).place, home);
}

SurveyLine line_between(const Place& begin, const Place& end) {
  return {.begin = begin, .end = end, .spacing = Metres{25}, .run_in = Metres{30}};
}

TEST(FlightPlanner, FliesAlongLinesInTheDirectionThatIsShorter) {
  auto task = task_with({});
  task.lines = {line_between(at(0, 100), at(500, 100)), line_between(at(0, 150), at(500, 150))};
  const FlightPlanner planner{task};
  EXPECT_TRUE(planner.has_passes());
  const auto flight = planner.flights(Plan{{{0, 1}}})[0];
  ASSERT_EQ(flight.legs.size(), 3U);
  EXPECT_EQ(flight.legs[0].line->begin, task.lines[0].begin);
  EXPECT_EQ(flight.legs[1].line->begin, task.lines[1].end);
  EXPECT_NEAR(flight.length.value, std::hypot(30, 100) + 560 + 50 + 560 + std::hypot(30, 150), 0.1);

  const auto mission = mission_of(task, 0, flight, false);
  std::vector<double> spacings;
  for (const auto& item : mission.items)
    if (const auto* camera = std::get_if<vehicle::CameraDistanceItem>(&item.action))
      spacings.push_back(camera->spacing.value);
  EXPECT_EQ(spacings, (std::vector<double>{25, 0, 25, 0}));
  EXPECT_EQ(mission.items.size(), 15U);  // take-off, speed, six for each line, return
}

TEST(FlightPlanner, LeavesOutALineThatAZoneCuts) {
  auto task = task_with({});
  task.lines = {line_between(at(0, 100), at(500, 100)), line_between(at(0, 400), at(500, 400))};
  task.fence.fence_polygons.push_back({{at(200, 50), at(250, 50), at(250, 150), at(200, 150)}, false});
  const FlightPlanner planner{task};
  const auto solver = make_solver(planner.problem(), Method::best, 1);
  solver->improve(10);
  const PassSearch search{planner.pass_problem(), solver->best(), 1};
  EXPECT_EQ(search.best(), (Plan{{{1}}}));
  EXPECT_EQ(unvisited(planner.pass_problem(), search.best())[0].reason, UnvisitedReason::no_way);
}

TEST(FlightPlanner, CountsTurnsOfAFixedWing) {
  auto task = task_with({at(1000, 0)});
  task.crafts[0].turn_radius = Metres{50};
  const FlightPlanner planner{task};
  const auto flight = planner.flights(Plan{{{0}}})[0];
  // Out, round and home to the start: two tangents of a circle through the point, at the courses that are looked at.
  EXPECT_GT(flight.length.value, 2000 + 50);
  EXPECT_LT(flight.length.value, 2000 + 50 * 2 * 3.1416);
  EXPECT_NEAR(flight.time.count(), flight.length.value / 10 + 40, 1e-6);
  EXPECT_FALSE(flight.legs[1].turns.empty());
}

// The track of a fixed wing is as long and takes as long as the answer says, bends no more than its radius, visits its
// points, and touches no zone; and the answer costs what the search was told.
TEST(FlightPlannerSeeded, FliesWhatItSays) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 8; ++seed) {
    Random random{seed};
    std::vector<Place> places;
    for (int i = 0; i < 7; ++i) {
      const auto east = 1000 * random.unit();
      places.push_back(at(east, 1000 * random.unit()));
    }
    auto task = task_with(places);
    task.crafts[0].turn_radius = Metres{40};
    task.wind = {MetresPerSecond{3}, Radians{6 * random.unit()}};
    task.fence.fence_polygons.push_back({{at(450, 450), at(550, 450), at(550, 550), at(450, 550)}, false});
    const FlightPlanner planner{task};
    const auto solver = make_solver(planner.problem(), Method::best, seed);
    solver->improve(300);
    PassSearch search{planner.pass_problem(), solver->best(), seed};
    search.improve(1000);
    const auto plan = search.best();
    const auto flight = planner.flights(plan)[0];
    const auto cost = best_passes(planner.pass_problem(), planner.problem().vehicles[0], plan.routes[0]).cost;
    EXPECT_NEAR(flight.time.count(), cost + 40, 1e-6) << "seed " << seed;

    const Map map{home};
    const auto radius = turn_radius_in_wind(Metres{40}, task.crafts[0].speed, task.wind).value;
    double metres = 0;
    std::size_t visited = 0;
    for (std::size_t i = 2; i + 1 < flight.track.size(); ++i) {
      const auto a = map.point(flight.track[i - 1].place);
      const auto b = map.point(flight.track[i].place);
      metres += length(b - a);
      for (const auto stop : plan.routes[0])
        if (length(b - map.point(places[stop])) < 1e-6) ++visited;
      EXPECT_GE(flight.track[i].time, flight.track[i - 1].time);
      EXPECT_TRUE(length(b - a) == 0 ||
                  planner.airspace().is_free(planner.airspace().map().point(flight.track[i - 1].place),
                                             planner.airspace().map().point(flight.track[i].place)))
          << "seed " << seed;
      if (i + 2 >= flight.track.size()) continue;
      const auto c = map.point(flight.track[i + 1].place);
      if (length(b - a) < 1 || length(c - b) < 1) continue;
      const auto bend = std::abs(std::remainder((course(b, c) - course(a, b)).value, 2 * 3.14159265358979));
      EXPECT_LE(bend, (length(b - a) + length(c - b)) / 2 / radius * 1.02 + 1e-6) << "seed " << seed;
    }
    EXPECT_GE(visited, plan.routes[0].size()) << "seed " << seed;
    EXPECT_NEAR(metres, flight.length.value, 0.01 * metres) << "seed " << seed;
  }
}

}  // namespace
}  // namespace ponte::planning
