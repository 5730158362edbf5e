#include "ponte/planning/airspace.hpp"

#include "ponte/core/random.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ponte::planning {
namespace {

using vehicle::Place;

const Place home{radians_from_degrees(-30.0667), radians_from_degrees(-51.1221)};

/// East and north of home, in metres.
Place at(double east, double north) { return Map{home}.place({east, north}); }

vehicle::Mission no_fly(const std::vector<Place>& corners, bool inclusion = false) {
  vehicle::Mission fence;
  fence.fence_polygons.push_back({corners, inclusion});
  return fence;
}

double way_length(const Place& from, const std::vector<Place>& turns, const Place& to) {
  double sum = 0;
  auto place = from;
  for (const auto& turn : turns) sum += bearing(std::exchange(place, turn), turn).length.value;
  return sum + bearing(place, to).length.value;
}

TEST(Bearing, AgreesWithTheLengthOfAMinuteOfLatitude) {
  // A degree of latitude at 45 degrees is 111.132 km (the meridian of WGS 84).
  const Place south{radians_from_degrees(44.5), radians_from_degrees(7)};
  const Place north{radians_from_degrees(45.5), radians_from_degrees(7)};
  EXPECT_NEAR(bearing(south, north).length.value, 111'132, 5);
  EXPECT_NEAR(bearing(south, north).course.value, 0, 1e-9);
}

TEST(Map, BringsAPlaceBack) {
  const auto place = at(3000, -4000);
  EXPECT_NEAR(bearing(home, place).length.value, 5000, 0.01);
  EXPECT_NEAR(Map{home}.point(place).east, 3000, 1e-6);
}

TEST(Airspace, IsAllFreeWithoutAFence) {
  const Airspace airspace{{}, home, Metres{5}};
  EXPECT_EQ(airspace.way(home, at(1000, 0)), std::vector<Place>{});
}

TEST(Airspace, TurnsAtTheCornersOnTheShorterSide) {
  const Airspace airspace{no_fly({at(400, -100), at(600, -100), at(600, 300), at(400, 300)}), home, Metres{5}};
  const auto way = airspace.way(at(0, 0), at(1000, 0));
  ASSERT_TRUE(way.has_value());
  ASSERT_EQ(way->size(), 2U);
  const auto first = Map{home}.point(way->front());
  EXPECT_NEAR(first.east, 400 - 5 / std::sqrt(2), 0.01);
  EXPECT_NEAR(first.north, -100 - 5 / std::sqrt(2), 0.01);
  EXPECT_NEAR(way_length(at(0, 0), *way, at(1000, 0)), 2 * std::hypot(396.46, 103.54) + 207.07, 0.1);
}

TEST(Airspace, AllowsNothingInsideAZoneAndNoWayOutOfAnInclusion) {
  const Airspace zone{no_fly({at(400, -100), at(600, -100), at(600, 300), at(400, 300)}), home, Metres{5}};
  EXPECT_FALSE(zone.allows(at(500, 0)));
  EXPECT_TRUE(zone.allows(at(700, 0)));
  EXPECT_EQ(zone.way(home, at(500, 0)), std::nullopt);
  const Airspace field{no_fly({at(-100, -100), at(100, -100), at(100, 100), at(-100, 100)}, true), home, Metres{5}};
  EXPECT_TRUE(field.allows(home));
  EXPECT_EQ(field.way(home, at(500, 0)), std::nullopt);
}

TEST(Airspace, FollowsTheBendOfAnInclusion) {
  const Airspace field{no_fly({at(0, 0), at(1000, 0), at(1000, 100), at(100, 100), at(100, 1000), at(0, 1000)}, true),
                       home, Metres{5}};
  const auto way = field.way(at(900, 50), at(50, 900));
  ASSERT_TRUE(way.has_value());
  EXPECT_EQ(way->size(), 1U);
}

TEST(Airspace, FindsNoWayIntoACourtyard) {
  // A wall of four pieces around the target.
  vehicle::Mission fence;
  for (const auto& corners : {std::vector{at(-60, -60), at(60, -60), at(60, -40), at(-60, -40)},
                              std::vector{at(-60, 40), at(60, 40), at(60, 60), at(-60, 60)},
                              std::vector{at(-60, -50), at(-40, -50), at(-40, 50), at(-60, 50)},
                              std::vector{at(40, -50), at(60, -50), at(60, 50), at(40, 50)}})
    fence.fence_polygons.push_back({corners, false});
  const Airspace airspace{fence, home, Metres{2}};
  EXPECT_TRUE(airspace.allows(home));
  EXPECT_EQ(airspace.way(home, at(500, 0)), std::nullopt);
}

// No point of any way, looked at every metre, is in a forbidden circle; and a way is never shorter than the geodesic.
TEST(AirspaceSeeded, KeepsEveryMetreOutOfTheCircles) {
  const auto seed = chosen_seed();
  Random random{seed};
  vehicle::Mission fence;
  for (int i = 0; i < 8; ++i) {
    const auto east = 1000 * random.unit();
    const auto north = 1000 * random.unit();
    fence.fence_circles.push_back({at(east, north), Metres{30 + 70 * random.unit()}, false});
  }
  const Airspace airspace{fence, home, Metres{3}};
  int detours = 0;
  for (int i = 0; i < 200; ++i) {
    const auto x = 1000 * random.unit();
    const auto from = at(x, -120);
    const auto to = at(1000 - x, 1120);
    const auto way = airspace.way(from, to);
    ASSERT_TRUE(way.has_value()) << "seed " << seed;
    if (!way->empty()) ++detours;
    EXPECT_GE(way_length(from, *way, to), bearing(from, to).length.value - 1e-6);
    auto places = *way;
    places.push_back(to);
    auto place = from;
    for (const auto& next : places) {
      const auto [length, course] = bearing(place, next);
      for (double flown = 0; flown < length.value; flown += 1)
        for (const auto& circle : fence.fence_circles)
          ASSERT_GT(bearing(circle.centre, displaced(place, course, Metres{flown})).length.value, circle.radius.value)
              << "seed " << seed;
      place = next;
    }
  }
  EXPECT_GT(detours, 20) << "seed " << seed;
}

}  // namespace
}  // namespace ponte::planning
