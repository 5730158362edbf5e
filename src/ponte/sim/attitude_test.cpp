#include "ponte/sim/attitude.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double tiny = 1e-12;

Attitude attitude(double roll, double pitch, double heading) {
  return {Radians{roll}, Radians{pitch}, Radians{heading}};
}

TEST(ToBody, FindsNorthOnTheLeftWhenItLooksEast) {
  const auto north = to_body(attitude(0, 0, pi / 2), {1, 0, 0});
  EXPECT_NEAR(north.x, 0, tiny);
  EXPECT_NEAR(north.y, -1, tiny);
  EXPECT_NEAR(north.z, 0, tiny);
}

TEST(ToBody, FindsDownBehindTheNoseUp) {
  const auto down = to_body(attitude(0, 0.1, 0), {0, 0, 1});
  EXPECT_NEAR(down.x, -std::sin(0.1), tiny);
  EXPECT_NEAR(down.z, std::cos(0.1), tiny);
}

TEST(ToBody, FindsDownOnTheLowerSide) {
  const auto down = to_body(attitude(0.1, 0, 1), {0, 0, 1});
  EXPECT_NEAR(down.y, std::sin(0.1), tiny);
  EXPECT_NEAR(down.z, std::cos(0.1), tiny);
}

TEST(AttitudeForThrust, IsLevelForAHover) {
  EXPECT_EQ(attitude_for_thrust({0, 0, -9.8}, Radians{2}), attitude(0, 0, 2));
}

TEST(AttitudeForThrust, LowersTheNoseToGoAheadAndTheRightSideToGoRight) {
  EXPECT_LT(attitude_for_thrust({1, 0, -9.8}, Radians{0}).pitch.value, 0);
  EXPECT_GT(attitude_for_thrust({0, 1, -9.8}, Radians{0}).roll.value, 0);
  EXPECT_GT(attitude_for_thrust({1, 0, -9.8}, Radians{-pi / 2}).roll.value, 0);
}

TEST(AttitudeForThrust, PutsTheThrustAlongTheAxisOfTheRotors) {
  const NorthEastDown thrust{2, -3, -9};
  const auto body = to_body(attitude_for_thrust(thrust, Radians{0.7}), thrust);
  EXPECT_NEAR(body.x, 0, tiny);
  EXPECT_NEAR(body.y, 0, tiny);
  EXPECT_NEAR(body.z, -std::sqrt(94), 1e-9);
}

TEST(BodyRates, AreTheChangeOfEachAngleWhenLevel) {
  const auto rates = body_rates(attitude(0, 0, 0), attitude(0, 0, 0.02), 0.02);
  EXPECT_NEAR(rates.x, 0, tiny);
  EXPECT_NEAR(rates.y, 0, tiny);
  EXPECT_NEAR(rates.z, 1, tiny);
}

TEST(BodyRates, TurnThroughSouthTheShortWay) {
  EXPECT_NEAR(body_rates(attitude(0, 0, pi - 0.01), attitude(0, 0, -pi + 0.01), 0.02).z, 1, 1e-9);
}

TEST(BodyRates, ShareATurnAmongTheAxesOfATiltedBody) {
  const auto rates = body_rates(attitude(0.5, 0.3, 1), attitude(0.5, 0.3, 1.02), 0.02);
  EXPECT_NEAR(rates.x, -std::sin(0.3), 1e-9);
  EXPECT_NEAR(rates.y, std::sin(0.5) * std::cos(0.3), 1e-9);
  EXPECT_NEAR(rates.z, std::cos(0.5) * std::cos(0.3), 1e-9);
}

}  // namespace
}  // namespace ponte::sim
