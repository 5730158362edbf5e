#include "ponte/sim/geodesy.hpp"

#include "ponte/core/random.hpp"

#include <gtest/gtest.h>
#include <GeographicLib/Geodesic.hpp>

#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

Position at(double latitude, double longitude, double altitude = 0) {
  return {radians_from_degrees(latitude), radians_from_degrees(longitude), Metres{altitude}};
}

constexpr double centimetre = 0.01;

// Lengths of geodesics on WGS-84, by Vincenty's formulae.
TEST(OffsetBetween, HasTheLengthOfTheGeodesic) {
  EXPECT_NEAR(horizontal(offset_between(at(0, 0), at(0.01, 0))), 1105.7428, centimetre);
  EXPECT_NEAR(horizontal(offset_between(at(-30.06898, -51.12179), at(-30.08, -51.15))), 2981.5886, centimetre);
  EXPECT_NEAR(horizontal(offset_between(at(-30.06898, -51.12179), at(-30.04, -51.09))), 4440.5391, centimetre);
  EXPECT_NEAR(horizontal(offset_between(at(-30.06898, -51.12179), at(-30.06898, -51.07))), 4993.5649, centimetre);
}

TEST(OffsetBetween, AgreesWithGeographicLibOverTenKilometres) {
  Random random{1};
  for (int i = 0; i < 2000; ++i) {
    const double latitude = random.unit() * 130 - 65;
    const double longitude = random.unit() * 360 - 180;
    const double bearing = random.unit() * 360;
    const double distance = random.unit() * 10'000;
    double to_latitude{};
    double to_longitude{};
    GeographicLib::Geodesic::WGS84().Direct(latitude, longitude, bearing, distance, to_latitude, to_longitude);
    ASSERT_NEAR(horizontal(offset_between(at(latitude, longitude), at(to_latitude, to_longitude))), distance, 0.05)
        << latitude << ' ' << longitude << ' ' << bearing;
  }
}

TEST(OffsetBetween, CrossesTheDateLine) {
  const auto offset = offset_between(at(60, 179.98), at(60.03, -179.97));
  EXPECT_GT(offset.east, 0);
  EXPECT_NEAR(horizontal(offset), 4352.9910, centimetre);
}

TEST(OffsetBetween, PointsNorthEastAndDown) {
  const auto offset = offset_between(at(-30, -51, 100), at(-30.001, -50.999, 80));
  EXPECT_LT(offset.north, 0);
  EXPECT_GT(offset.east, 0);
  EXPECT_EQ(offset.down, 20);
}

TEST(Displaced, IsTheInverseOfOffsetBetween) {
  const auto from = at(-30.06898, -51.12179, 50);
  for (const auto& offset : {NorthEastDown{}, NorthEastDown{0.01, -0.02, 0.03}, NorthEastDown{3000, -4000, -200},
                             NorthEastDown{-50, 9000, 1}}) {
    const auto back = offset_between(from, displaced(from, offset));
    EXPECT_NEAR(back.north, offset.north, 1e-3);
    EXPECT_NEAR(back.east, offset.east, 1e-3);
    EXPECT_NEAR(back.down, offset.down, 1e-9);
  }
}

TEST(Displaced, CrossesTheDateLine) {
  EXPECT_LT(displaced(at(10, 179.999), {0, 1000, 0}).longitude.value, 0);
  EXPECT_GT(displaced(at(10, -179.999), {0, -1000, 0}).longitude.value, 0);
}

TEST(Wrapped, KeepsAnglesWithinHalfATurn) {
  EXPECT_NEAR(wrapped(7), 7 - 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(wrapped(-4), 2 * std::numbers::pi - 4, 1e-12);
  EXPECT_EQ(wrapped(1), 1);
}

}  // namespace
}  // namespace ponte::sim
