#include "ponte/sim/plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

constexpr Position start{Radians{-0.5248}, Radians{-0.8922}, Metres{50}};
constexpr double dt = 0.02;
constexpr MetresPerSecond cruise{22};

class PlaneTest : public ::testing::Test {
 protected:
  /// Lets time go by, and keeps the extremes of what happens in the air.
  void fly(double seconds) {
    for (double t = 0; t < seconds; t += dt) {
      const auto before = plane_.state();
      plane_.step({.wind = wind_, .position_error = {}, .motors_run = motor_runs_});
      const auto& after = plane_.state();
      if (!before.airborne || !after.airborne) continue;
      bank_ = std::max(bank_, std::abs(after.attitude.roll.value));
      climb_ = std::max(climb_, -after.velocity.down);
      sink_ = std::max(sink_, after.velocity.down);
      const auto air = after.velocity - after.wind;
      slowest_ = std::min(slowest_, horizontal(air));
    }
  }

  void take_off(double height) {
    plane_.arm();
    plane_.climb_to(start.altitude_msl + Metres{height});
    fly(60);
  }

  const AirframeState& state() const { return plane_.state(); }
  NorthEastDown place() const { return offset_between(start, state().position); }
  double height() const { return -place().down; }
  NorthEastDown air() const { return state().velocity - state().wind; }

  PlaneConfig config_{};
  NorthEastDown wind_{};
  bool motor_runs_{true};
  Plane plane_{config_, start, Radians{}};
  double bank_{};
  double climb_{};
  double sink_{};
  double slowest_{1000};
};

TEST_F(PlaneTest, StandsInTheWind) {
  wind_ = {8, 3, 0};
  plane_.arm();
  fly(10);
  EXPECT_EQ(state().position, start);
  EXPECT_EQ(state().velocity, NorthEastDown{});
}

TEST_F(PlaneTest, RunsUntilItFliesAndClimbsAhead) {
  plane_.arm();
  plane_.climb_to(start.altitude_msl + Metres{80});
  while (!state().airborne) fly(dt);
  // It leaves the ground at v after v^2 / 2a.
  const double speed = config_.least_airspeed.value * 1.1;
  EXPECT_NEAR(horizontal(state().velocity), speed, 0.2);
  EXPECT_NEAR(place().north, speed * speed / 2 / config_.acceleration.value, 0.5);
  fly(60);
  EXPECT_NEAR(height(), 80, 0.2);
  EXPECT_NEAR(place().east, 0, 0.01);
  EXPECT_LT(climb_, config_.climb_rate.value * 1.01);
  EXPECT_GT(climb_, config_.climb_rate.value * 0.95);
  EXPECT_NEAR(horizontal(state().velocity), 22, 0.05);
}

TEST_F(PlaneTest, NeedsLessGroundAgainstTheWind) {
  wind_ = {-6, 0, 0};
  plane_.arm();
  plane_.climb_to(start.altitude_msl + Metres{80});
  while (!state().airborne) fly(dt);
  const double speed = config_.least_airspeed.value * 1.1 - 6;
  EXPECT_NEAR(place().north, speed * speed / 2 / config_.acceleration.value, 0.5);
}

TEST_F(PlaneTest, CirclesWithTheBankThatTheRadiusDemands) {
  take_off(80);
  const auto centre = displaced(start, {1500, 200, -80});
  plane_.circle(centre, Metres{100}, cruise);
  fly(90);
  double turned{};
  for (double t = 0; t < 60; t += dt) {
    const auto before = offset_between(centre, state().position);
    fly(dt);
    const auto after = offset_between(centre, state().position);
    ASSERT_NEAR(horizontal(after), 100, 1.5);
    ASSERT_NEAR(state().attitude.roll.value, std::atan(22 * 22 / (standard_gravity * 100)), 0.03);
    turned += wrapped(std::atan2(after.east, after.north) - std::atan2(before.east, before.north));
  }
  EXPECT_NEAR(turned, 60 * 22.0 / 100, 0.3) << "clockwise";
  EXPECT_NEAR(height(), 80, 0.5);
}

TEST_F(PlaneTest, CirclesTheOtherWayAndInWind) {
  take_off(80);
  wind_ = {0, 7, 0};
  const auto centre = displaced(start, {1500, -200, -80});
  plane_.circle(centre, Metres{-120}, cruise);
  fly(120);
  double turned{};
  for (double t = 0; t < 60; t += dt) {
    const auto before = offset_between(centre, state().position);
    fly(dt);
    const auto after = offset_between(centre, state().position);
    ASSERT_NEAR(horizontal(after), 120, 12);
    turned += wrapped(std::atan2(after.east, after.north) - std::atan2(before.east, before.north));
  }
  EXPECT_LT(turned, -8);
}

TEST_F(PlaneTest, NeverBanksOrClimbsBeyondItsLimits) {
  take_off(100);
  wind_ = {5, -4, 0};
  for (int i = 0; i < 12; ++i) {
    const double angle = i * 2.4;
    plane_.fly_to(displaced(start, {400 * std::cos(angle), 400 * std::sin(angle), -100.0 - 10 * i}), cruise);
    fly(15);
  }
  EXPECT_LT(bank_, config_.bank.value * 1.001);
  EXPECT_GT(bank_, config_.bank.value * 0.95);
  EXPECT_LT(climb_, config_.climb_rate.value * 1.01);
  EXPECT_LT(sink_, config_.descent_rate.value * 1.01);
  EXPECT_GT(slowest_, config_.least_airspeed.value);
}

TEST_F(PlaneTest, KeepsToTheLineInCrossWind) {
  take_off(80);
  fly(20);
  wind_ = {0, 8, 0};
  const auto from = state().position;
  plane_.fly_to(displaced(from, {3000, 0, 0}), cruise);
  fly(60);
  const auto here = offset_between(from, state().position);
  EXPECT_NEAR(here.east, 0, 3);
  // The wind triangle: it crabs by asin(w / v), and is as fast as what remains.
  EXPECT_NEAR(state().attitude.heading.value, -std::asin(8.0 / 22), 0.02);
  EXPECT_NEAR(horizontal(state().velocity), std::sqrt(22.0 * 22 - 8 * 8), 0.1);
}

TEST_F(PlaneTest, CirclesRoundAPlaceThatItHasPassed) {
  take_off(80);
  const auto target = displaced(start, {2200, 300, -80});
  plane_.fly_to(target, cruise);
  fly(180);
  for (double t = 0; t < 30; t += dt) {
    fly(dt);
    ASSERT_NEAR(horizontal(offset_between(target, state().position)), config_.loiter_radius.value, 3);
  }
}

TEST_F(PlaneTest, LandsOnTheSpotAndRollsOut) {
  take_off(60);
  const auto spot = displaced(start, {2600, 0, 0});
  plane_.land(spot);
  while (state().airborne) fly(dt);
  EXPECT_LT(horizontal(offset_between(state().position, spot)), 120);
  EXPECT_LT(sink_, config_.descent_rate.value * 1.01);
  const double speed = horizontal(state().velocity);
  EXPECT_GT(speed, 10);
  const double from = place().north;
  fly(20);
  EXPECT_EQ(state().velocity, NorthEastDown{});
  EXPECT_NEAR(place().north - from, speed * speed / 2 / 2.5, 1);
  EXPECT_EQ(height(), 0);
  plane_.disarm();
}

TEST_F(PlaneTest, TouchesDownSoftly) {
  take_off(60);
  plane_.land(std::nullopt);
  double sinking{};
  while (state().airborne) {
    sinking = state().velocity.down;
    fly(dt);
  }
  EXPECT_NEAR(sinking, 0.6, 0.15);
}

TEST_F(PlaneTest, DriftsStraightWithTheWind) {
  take_off(80);
  plane_.drift();
  fly(5);
  wind_ = {0, 5, 0};
  fly(dt);
  const auto from = place();
  fly(20);
  EXPECT_NEAR(place().east - from.east, 100, 1);
  EXPECT_NEAR(state().attitude.heading.value, 0, 0.01);
  EXPECT_NEAR(height(), 80, 0.3);
}

TEST_F(PlaneTest, GlidesWithoutItsMotor) {
  take_off(100);
  plane_.drift();
  motor_runs_ = false;
  const auto from = place();
  fly(40);
  const double way = horizontal(place() - from);
  EXPECT_NEAR(way / (from.down * -1 - height()), 12, 1.5) << "glide ratio";
  EXPECT_EQ(state().throttle, 0);
  fly(60);
  EXPECT_FALSE(state().airborne);
}

TEST_F(PlaneTest, FeelsItsTurns) {
  take_off(80);
  plane_.circle(displaced(start, {1500, 200, -80}), Metres{100}, cruise);
  fly(90);
  const auto felt = specific_force(state());
  EXPECT_NEAR(felt.y, 0, 0.4) << "coordinated";
  EXPECT_NEAR(felt.z, -standard_gravity / std::cos(state().attitude.roll.value), 0.2);
  EXPECT_NEAR(state().rates.z, 22.0 / 100 * std::cos(state().attitude.roll.value), 0.03);
}

TEST_F(PlaneTest, NeedsMoreCurrentToClimb) {
  take_off(80);
  const double level = state().battery.amperes;
  plane_.climb_to(start.altitude_msl + Metres{200});
  fly(10);
  EXPECT_GT(state().battery.amperes, level + 5);
}

}  // namespace
}  // namespace ponte::sim
