#include "ponte/planning/separation.hpp"

#include "ponte/core/random.hpp"
#include "ponte/planning/plane.hpp"
#include "support/seed.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace ponte::planning {
namespace {

const vehicle::Place home{radians_from_degrees(-30.0667), radians_from_degrees(-51.1221)};
constexpr Separation usual{.distance = Metres{20},
                           .height = Metres{10},
                           .window = vehicle::Seconds{10},
                           .wait = vehicle::Seconds{15},
                           .layers_max = 4};

vehicle::Place at(double east, double north) { return Map{home}.place({east, north}); }

Craft craft_at(double east, double north) {
  return {.start = at(east, north), .ends = {}, .speed = MetresPerSecond{10}, .vertical_speed = MetresPerSecond{2}};
}

std::vector<Flight> flights_of(const Task& task, const Plan& plan) { return FlightPlanner{task}.flights(plan); }

Task task_of(std::vector<Craft> crafts, const std::vector<vehicle::Place>& places) {
  Task task{.crafts = std::move(crafts)};
  for (const auto& place : places) task.points.push_back({.place = place});
  task.altitude = {Metres{40}, vehicle::AltitudeFrame::home};
  return task;
}

struct Spot {
  MapPoint at;
  double height{};
};

/// Where the flight is; nothing while it is on the ground.
std::optional<Spot> where(const Flight& flight, double time) {
  const Map map{home};
  for (std::size_t i = 1; i < flight.track.size(); ++i) {
    const auto& before = flight.track[i - 1];
    const auto& after = flight.track[i];
    const auto begin = (flight.wait + before.time).count();
    const auto end = (flight.wait + after.time).count();
    if (time < begin || time > end || end <= begin) continue;
    const auto part = (time - begin) / (end - begin);
    const auto from = map.point(before.place);
    return Spot{from + (map.point(after.place) - from) * part,
                std::lerp(before.height.value, after.height.value, part)};
  }
  return std::nullopt;
}

TEST(Conflicts, AreWhereFlightsMeetAtTheSameTime) {
  // Both cross the middle after as long a way.
  auto task = task_of({craft_at(0, 0), craft_at(0, 1000)}, {at(1000, 1000), at(1000, 0)});
  const auto found = conflicts(flights_of(task, {{{0}, {1}}}), usual);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].second, 1U);
  EXPECT_LT(bearing(found[0].place, at(500, 500)).length.value, 150);
}

TEST(Conflicts, AreNoneWhereTheOtherHasLongPassed) {
  auto task = task_of({craft_at(0, 0), craft_at(0, 3000)}, {at(1000, 1000), at(1000, 0)});
  EXPECT_THAT(conflicts(flights_of(task, {{{0}, {1}}}), usual), ::testing::IsEmpty());
}

TEST(Separate, GivesALayerWhereThatIsEnoughAndAWaitWhereTheStartIsTheSame) {
  auto crossing = task_of({craft_at(0, 0), craft_at(0, 1000)}, {at(1000, 1000), at(1000, 0)});
  auto flights = flights_of(crossing, {{{0}, {1}}});
  separate(flights, crossing.crafts, usual);
  EXPECT_EQ(flights[0].added_altitude, Metres{0});
  EXPECT_EQ(flights[1].added_altitude, Metres{10});
  EXPECT_EQ(flights[1].wait.count(), 0);
  auto same_start = task_of({craft_at(0, 0), craft_at(0, 0)}, {at(1000, 1000), at(-1000, 0)});
  flights = flights_of(same_start, {{{0}, {1}}});
  separate(flights, same_start.crafts, usual);
  EXPECT_GT(flights[1].wait.count(), 20);
}

TEST(Separate, OnlyWaitsWhereOneLayerIsAllowed) {
  auto crossing = task_of({craft_at(0, 0), craft_at(0, 1000)}, {at(1000, 1000), at(1000, 0)});
  auto flights = flights_of(crossing, {{{0}, {1}}});
  auto flat = usual;
  flat.layers_max = 1;
  separate(flights, crossing.crafts, flat);
  EXPECT_EQ(flights[1].added_altitude, Metres{0});
  EXPECT_GT(flights[1].wait.count(), 0);
}

TEST(Raised, CostsTimeToClimbAndToDescend) {
  auto task = task_of({craft_at(0, 0)}, {at(1000, 0)});
  const auto flight = flights_of(task, {{{0}}})[0];
  const auto higher = raised(flight, task.crafts[0], Metres{10});
  EXPECT_NEAR((higher.time - flight.time).count(), 10, 1e-9);
  EXPECT_EQ(higher.track.back().time, higher.time);
  EXPECT_EQ(higher.track[1].height, Metres{50});
  EXPECT_EQ(higher.track.back().height, Metres{0});
}

// Looked at every half second, with either vehicle early or late by up to the window, no two are too near.
TEST(SeparateSeeded, KeepsAllFlightsApart) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 10; ++seed) {
    Random random{seed};
    const auto anywhere = [&] {
      const auto east = 600 * random.unit();
      return at(east, 600 * random.unit());
    };
    Task task;
    task.altitude = {Metres{40}, vehicle::AltitudeFrame::home};
    Plan plan;
    for (int i = 0; i < 4; ++i) {
      task.crafts.push_back(craft_at(600 * random.unit(), 600 * random.unit()));
      task.crafts.back().ends = {task.crafts.back().start};
      if (i == 3) task.crafts.back().turn_radius = Metres{30};
      auto& route = plan.routes.emplace_back();
      for (int j = 0; j < 3; ++j) {
        route.push_back(task.points.size());
        task.points.push_back({.place = anywhere()});
      }
    }
    auto flights = flights_of(task, plan);
    separate(flights, task.crafts, usual);
    EXPECT_THAT(conflicts(flights, usual), ::testing::IsEmpty()) << "seed " << seed;
    for (std::size_t i = 0; i < flights.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (double time = 0; time < 1000; time += 0.5)
          for (const auto late : {-9.9, -4.0, 0.0, 4.0, 9.9}) {
            const auto a = where(flights[i], time);
            const auto b = where(flights[j], time + late);
            if (!a || !b) continue;
            ASSERT_TRUE(length(a->at - b->at) >= 19.9 || std::abs(a->height - b->height) >= 9.9)
                << "seed " << seed << ", flights " << i << " and " << j << " at " << time;
          }
  }
}

}  // namespace
}  // namespace ponte::planning
