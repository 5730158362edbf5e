#include "ponte/planning/turning.hpp"

#include "ponte/core/random.hpp"
#include "ponte/planning/plane.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ponte::planning {
namespace {

constexpr auto pi = std::numbers::pi;
constexpr MetresPerSecond speed{20};
const vehicle::Place home{radians_from_degrees(-30.0667), radians_from_degrees(-51.1221)};

Airspace with_zones(const std::vector<std::vector<MapPoint>>& zones) {
  vehicle::Mission fence;
  for (const auto& corners : zones) {
    auto& zone = fence.fence_polygons.emplace_back(vehicle::FencePolygon{{}, false});
    for (const auto& corner : corners) zone.corners.push_back(Map{home}.place(corner));
  }
  return {fence, home, Metres{5}};
}

std::vector<MapPoint> square(MapPoint middle, double half) {
  return {middle + MapPoint{-half, -half}, middle + MapPoint{half, -half}, middle + MapPoint{half, half},
          middle + MapPoint{-half, half}};
}

TEST(FlyingTimes, AreLengthsOverSpeedInStillAir) {
  const FlyingTimes times{speed, {}};
  const auto path = shortest_dubins_path({}, {{300, -200}, Radians{1}}, 60);
  EXPECT_NEAR(times.along(path), path.length() / speed.value, 1e-9);
}

// Round a whole circle in the wind, the time is the integral of 1 over the speed over ground.
TEST(FlyingTimes, FollowTheWindRoundACircle) {
  const Wind wind{MetresPerSecond{8}, Radians{0.7}};
  const FlyingTimes times{speed, wind};
  const DubinsPath circle{{{}, Radians{-1}}, 60, {{{1, 2 * pi * 60}, {0, 0}, {1, 0}}}};
  double sum = 0;
  constexpr int parts = 100'000;
  for (int i = 0; i < parts; ++i)
    sum += 2 * pi * 60 / parts / ground_speed(speed, Radians{2 * pi * (i + 0.5) / parts}, wind).value;
  EXPECT_NEAR(times.along(circle), sum, 1e-3);
  const DubinsPath other_way{{{}, Radians{-1}}, 60, {{{-1, 2 * pi * 60}, {0, 0}, {1, 0}}}};
  EXPECT_NEAR(times.along(other_way), sum, 1e-3);
}

TEST(FlyingTimes, AreInfiniteForTurnsWhereTheWindIsAsFast) {
  const FlyingTimes times{speed, {MetresPerSecond{20}, {}}};
  EXPECT_TRUE(std::isinf(times.along(shortest_dubins_path({}, {{0, 900}, Radians{pi}}, 60))));
}

TEST(TurnRadiusInWind, IsWidestWithTheWindBehind) {
  EXPECT_EQ(turn_radius_in_wind(Metres{60}, speed, {}).value, 60);
  EXPECT_NEAR(turn_radius_in_wind(Metres{60}, speed, {MetresPerSecond{10}, {}}).value, 60 * 1.5 * 1.5, 1e-9);
}

TEST(TurningWays, GoRoundAZoneWhoseDetourTheyKnow) {
  const auto airspace = with_zones({square({500, 0}, 150)});
  const TurningWays ways{airspace, {speed, {}}, Metres{60}};
  const auto east = Radians{pi / 2};
  const auto corners = airspace.way(airspace.map().place({0, 0}), airspace.map().place({1000, 0}));
  ASSERT_TRUE(corners && corners->size() == 2);
  std::vector<MapPoint> points;
  for (const auto& corner : *corners) points.push_back(airspace.map().point(corner));
  EXPECT_FALSE(ways.way({{}, east}, {}, {{1000, 0}, east}).has_value());
  const auto found = ways.way({{}, east}, points, {{1000, 0}, east});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->paths.size(), 3U);
  EXPECT_GT(found->seconds * speed.value, 1000);
  EXPECT_LT(found->seconds * speed.value, 1400);
}

// The table that planning uses has the times of the ways that are flown; and no point of them, looked at every metre,
// is in a zone by more than the chords of the test may leave a circle.
TEST(TurningWaysSeeded, KeepOutOfZonesAndTakeAsLongAsTheirTableSays) {
  const auto seed = chosen_seed();
  Random random{seed};
  constexpr double radius = 40;
  constexpr double chord_error = 0.001 * radius;
  std::vector<std::vector<MapPoint>> zones;
  std::vector<std::vector<MapPoint>> cores;
  for (int i = 0; i < 6; ++i) {
    const auto east = 150 + 700 * random.unit();
    const auto north = 1000 * random.unit();
    const auto half = 30 + 40 * random.unit();
    zones.push_back(square({east, north}, half));
    cores.push_back(square({east, north}, half - chord_error));
  }
  const auto airspace = with_zones(zones);
  const TurningWays ways{airspace, {speed, {}}, Metres{radius}};
  int past_corners = 0;
  for (int i = 0; i < 20; ++i) {
    const MapPoint a{-50, 1000 * random.unit()};
    const MapPoint b{1050, 1000 * random.unit()};
    std::vector<MapPoint> corners;
    const auto detour = airspace.way(airspace.map().place(a), airspace.map().place(b));
    ASSERT_TRUE(detour.has_value());
    for (const auto& corner : *detour) corners.push_back(airspace.map().point(corner));
    const auto from = poses_at(a);
    const auto to = poses_at(b);
    const auto table = ways.seconds(from, corners, to);
    for (std::size_t j = 0; j < courses; ++j) {
      const auto k = (j * 5) % courses;
      const auto found = ways.way(from[j], corners, to[k]);
      ASSERT_EQ(found.has_value(), std::isfinite(table[j * courses + k])) << "seed " << seed;
      if (!found) continue;
      EXPECT_NEAR(found->seconds, table[j * courses + k], 1e-9) << "seed " << seed;
      if (found->paths.size() > 1) ++past_corners;
      for (const auto& path : found->paths)
        for (double flown = 0; flown <= path.length(); flown += 1)
          for (const auto& core : cores) ASSERT_FALSE(is_inside(core, path.pose_after(flown).at)) << "seed " << seed;
    }
  }
  EXPECT_GT(past_corners, 5) << "seed " << seed;
}

}  // namespace
}  // namespace ponte::planning
