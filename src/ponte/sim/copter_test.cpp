#include "ponte/sim/copter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

constexpr Position start{Radians{-0.5248}, Radians{-0.8922}, Metres{50}};
constexpr double dt = 0.02;

class CopterTest : public ::testing::Test {
 protected:
  /// Lets time go by, and keeps the extremes of what happens.
  void fly(double seconds) {
    for (double t = 0; t < seconds; t += dt) {
      const auto before = copter_.state();
      copter_.step({.wind = wind_});
      const auto& after = copter_.state();
      fastest_ = std::max(fastest_, horizontal(after.velocity));
      climb_ = std::max(climb_, -after.velocity.down);
      sink_ = std::max(sink_, after.velocity.down);
      acceleration_ = std::max(acceleration_, horizontal(after.acceleration));
      tilt_ = std::max({tilt_, std::abs(after.attitude.roll.value), std::abs(after.attitude.pitch.value)});
      rate_ = std::max({rate_, std::abs(after.rates.x), std::abs(after.rates.y), std::abs(after.rates.z)});
      turn_ = std::max(turn_, std::abs(wrapped(after.attitude.heading.value - before.attitude.heading.value)) / dt);
    }
  }

  void take_off(double height) {
    copter_.arm();
    copter_.climb_to(start.altitude_msl + Metres{height});
    fly(30);
  }

  NorthEastDown place() const { return offset_between(start, copter_.state().position); }
  double height() const { return -place().down; }

  CopterConfig config_{};
  NorthEastDown wind_{};
  Copter copter_{config_, start, Radians{}};
  double fastest_{};
  double climb_{};
  double sink_{};
  double acceleration_{};
  double tilt_{};
  double rate_{};
  double turn_{};
};

TEST_F(CopterTest, StandsStillUntilItIsToldToFly) {
  copter_.arm();
  fly(10);
  EXPECT_EQ(copter_.state().position, start);
  EXPECT_FALSE(copter_.state().airborne);
  EXPECT_EQ(specific_force(copter_.state()), (BodyVector{0, 0, -standard_gravity}));
}

TEST_F(CopterTest, ClimbsStraightUpWithinItsLimits) {
  take_off(20);
  EXPECT_TRUE(copter_.state().airborne);
  EXPECT_NEAR(height(), 20, 0.05);
  EXPECT_NEAR(horizontal(place()), 0, 0.001);
  EXPECT_GT(climb_, 2.4);
  EXPECT_LT(climb_, config_.climb_rate.value * 1.05);
  EXPECT_LT(tilt_, 1e-6);
}

TEST_F(CopterTest, FliesToAPointWithinItsLimits) {
  take_off(20);
  const auto target = displaced(copter_.state().position, {100, 50, -10});
  copter_.fly_to(target, MetresPerSecond{8});
  fly(40);
  const auto rest = offset_between(copter_.state().position, target);
  EXPECT_NEAR(horizontal(rest), 0, 0.05);
  EXPECT_NEAR(rest.down, 0, 0.05);
  EXPECT_GT(fastest_, 7.5);
  EXPECT_LT(fastest_, 8 * 1.03);
  EXPECT_LT(acceleration_, config_.acceleration.value * 1.03);
  EXPECT_LT(climb_, config_.climb_rate.value * 1.05);
}

TEST_F(CopterTest, TurnsTowardsItsCourseAndTilts) {
  take_off(20);
  copter_.fly_to(displaced(copter_.state().position, {0, 200, 0}), MetresPerSecond{8});
  fly(12);
  EXPECT_NEAR(copter_.state().attitude.heading.value, std::numbers::pi / 2, 0.01);
  EXPECT_LT(copter_.state().attitude.pitch.value, -0.1) << "cruising against the drag";
  EXPECT_NEAR(copter_.state().attitude.roll.value, 0, 0.01);
  EXPECT_LT(tilt_, 0.5);
  EXPECT_LT(turn_, config_.turn_rate.value * 1.001);
  EXPECT_LT(rate_, 1.5);
}

TEST_F(CopterTest, StopsWithoutHaste) {
  take_off(20);
  copter_.fly_to(displaced(copter_.state().position, {500, 0, 0}), MetresPerSecond{8});
  fly(20);
  const double before = place().north;
  copter_.hold();
  fly(15);
  EXPECT_NEAR(horizontal(copter_.state().velocity), 0, 0.01);
  EXPECT_LT(place().north - before, 8 * 8 / 2 / 1.0);
  EXPECT_GT(place().north, before);
  EXPECT_NEAR(height(), 20, 0.05);
  EXPECT_LT(acceleration_, config_.acceleration.value * 1.03);
}

TEST_F(CopterTest, LandsSlowlyAndStands) {
  take_off(25);
  copter_.land(std::nullopt);
  fly(10);
  EXPECT_NEAR(sink_, config_.descent_rate.value, 0.03);
  while (height() > 2) fly(dt);
  EXPECT_NEAR(copter_.state().velocity.down, config_.landing_rate.value, 0.02);
  fly(10);
  EXPECT_FALSE(copter_.state().airborne);
  EXPECT_EQ(height(), 0);
  EXPECT_EQ(copter_.state().velocity, NorthEastDown{});
  EXPECT_EQ(copter_.state().rates, BodyVector{});
  EXPECT_TRUE(copter_.state().armed);
  copter_.disarm();
  EXPECT_FALSE(copter_.state().armed);
}

TEST_F(CopterTest, StopsOverGroundBeforeItSinks) {
  take_off(5);
  copter_.fly_to(displaced(copter_.state().position, {500, 0, 0}), MetresPerSecond{8});
  fly(10);
  copter_.land(std::nullopt);
  while (horizontal(copter_.state().velocity) > 1) {
    EXPECT_NEAR(height(), 5, 0.1);
    fly(dt);
  }
  fly(20);
  EXPECT_FALSE(copter_.state().airborne);
}

TEST_F(CopterTest, FeelsItsAccelerationAndThePushAgainstGravity) {
  take_off(20);
  copter_.fly_to(displaced(copter_.state().position, {0, 200, 0}), MetresPerSecond{8});
  for (int i = 0; i < 500; ++i) {
    fly(dt);
    const auto& state = copter_.state();
    const auto felt = specific_force(state);
    const auto east = to_body(state.attitude, {0, 1, 0});
    const auto down = to_body(state.attitude, {0, 0, 1});
    EXPECT_NEAR(felt.x * east.x + felt.y * east.y + felt.z * east.z, state.acceleration.east, 1e-9);
    EXPECT_NEAR(felt.x * down.x + felt.y * down.y + felt.z * down.z, state.acceleration.down - standard_gravity, 1e-9);
  }
}

TEST_F(CopterTest, NeedsMoreCurrentInTheAir) {
  fly(1);
  const double parked = copter_.state().battery.amperes;
  copter_.arm();
  fly(1);
  const double idling = copter_.state().battery.amperes;
  take_off(20);
  const double hovering = copter_.state().battery.amperes;
  EXPECT_LT(parked, idling);
  EXPECT_LT(idling * 5, hovering);
  EXPECT_NEAR(copter_.state().throttle, 0.39, 1e-6);
  EXPECT_LT(copter_.state().battery.remaining, 1);
}

TEST_F(CopterTest, HoldsItsSpeedLimitAtEveryHeadingAndFromEveryPlace) {
  take_off(20);
  for (int corner = 0; corner < 12; ++corner) {
    const double angle = corner * 2.4;
    copter_.fly_to(displaced(start, {80 * std::cos(angle), 80 * std::sin(angle), -20}), MetresPerSecond{6});
    fly(7);  // not long enough to arrive
  }
  EXPECT_LT(fastest_, 6 * 1.03);
  EXPECT_LT(acceleration_, config_.acceleration.value * 1.03);
  EXPECT_LT(tilt_, 0.6);
  EXPECT_LT(rate_, 2.5);
}

}  // namespace
}  // namespace ponte::sim
