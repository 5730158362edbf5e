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
      copter_.step({.wind = wind_, .position_error = error_, .motors_run = motors_run_});
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
  NorthEastDown error_{};
  bool motors_run_{true};
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
  EXPECT_LT(climb_, Handling{}.climb_rate.value * 1.05);
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
  EXPECT_LT(climb_, Handling{}.climb_rate.value * 1.05);
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
  EXPECT_NEAR(sink_, Handling{}.descent_rate.value, 0.03);
  while (height() > 2) fly(dt);
  EXPECT_NEAR(copter_.state().velocity.down, Handling{}.landing_rate.value, 0.02);
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

// The drag of the air is 0.25 1/s times the airspeed, so what the wind does to the copter can be calculated.
constexpr double drag = 0.25;

TEST_F(CopterTest, DriftsAwayWithTheWind) {
  take_off(20);
  const auto from = place();
  wind_ = {0, 8, 0};
  copter_.drift();
  for (double t = dt; t < 20; t += dt) {
    fly(dt);
    ASSERT_NEAR(copter_.state().velocity.east, 8 * (1 - std::exp(-drag * t)), 0.03);
    ASSERT_NEAR(place().east - from.east, 8 * (t - (1 - std::exp(-drag * t)) / drag), 0.3);
  }
  EXPECT_NEAR(height(), 20, 0.05);
  EXPECT_NEAR(tilt_, 0, 1e-3) << "level";
}

TEST_F(CopterTest, LeansIntoTheWindToHoldItsPlace) {
  take_off(20);
  const auto from = place();
  wind_ = {-9, 0, 0};
  fly(30);
  EXPECT_LT(horizontal(place() - from), 0.05);
  EXPECT_NEAR(copter_.state().attitude.pitch.value, -std::atan(drag * 9 / standard_gravity), 1e-3);
  EXPECT_NEAR(copter_.state().attitude.roll.value, 0, 1e-3);
}

TEST_F(CopterTest, IsCarriedOffByMoreWindThanItMayLeanAgainst) {
  take_off(20);
  wind_ = {0, -30, 0};
  fly(60);
  const double resisted = standard_gravity * std::tan(config_.lean.value) / drag;
  EXPECT_NEAR(copter_.state().velocity.east, -(30 - resisted), 0.05);
  EXPECT_LT(tilt_, config_.lean.value * 1.001);
  EXPECT_NEAR(height(), 20, 0.1);
}

TEST_F(CopterTest, TakesOffAndLandsOnTheSpotInWind) {
  wind_ = {4, 3, 0};
  take_off(20);
  EXPECT_LT(horizontal(place()), 0.1);
  copter_.land(start);
  fly(60);
  EXPECT_FALSE(copter_.state().airborne);
  EXPECT_LT(horizontal(place()), 0.1);
}

TEST_F(CopterTest, CirclesRoundAPlaceInWind) {
  take_off(20);
  wind_ = {0, 5, 0};
  const auto centre = displaced(start, {40, 0, -20});
  for (const double radius : {25.0, -25.0}) {
    copter_.circle(centre, Metres{radius}, MetresPerSecond{4});
    fly(40);
    double turned{};
    for (double t = 0; t < 60; t += dt) {
      const auto before = offset_between(centre, copter_.state().position);
      fly(dt);
      const auto after = offset_between(centre, copter_.state().position);
      ASSERT_NEAR(horizontal(after), 25, 0.3);
      turned += wrapped(std::atan2(after.east, after.north) - std::atan2(before.east, before.north));
    }
    EXPECT_NEAR(turned, 60 * 4 / radius, 0.2) << "clockwise if positive";
    EXPECT_NEAR(height(), 20, 0.1);
  }
  EXPECT_LT(acceleration_, config_.acceleration.value * 1.03);
}

TEST_F(CopterTest, MovesWithAVelocityAndTurnsItsNose) {
  take_off(20);
  wind_ = {3, 0, 0};
  copter_.move({1, -2, -0.5});
  fly(20);
  const auto& state = copter_.state();
  EXPECT_NEAR(state.velocity.north, 1, 0.01);
  EXPECT_NEAR(state.velocity.east, -2, 0.01);
  EXPECT_NEAR(state.velocity.down, -0.5, 0.01);
  EXPECT_NEAR(state.attitude.heading.value, std::atan2(-2, 1), 0.01);
  copter_.face({.heading = Radians{2}});
  fly(10);
  EXPECT_NEAR(state.attitude.heading.value, 2, 0.01);
  copter_.face({.turn_rate = RadiansPerSecond{-0.3}});
  fly(5);
  EXPECT_NEAR(state.rates.z, -0.3 * std::cos(state.attitude.roll.value) * std::cos(state.attitude.pitch.value), 0.01);
}

TEST_F(CopterTest, SteersByWhereItBelievesToBe) {
  take_off(20);
  const auto before = place();
  error_ = {5, -3, 0};
  fly(20);
  EXPECT_NEAR(place().north - before.north, -5, 0.05);
  EXPECT_NEAR(place().east - before.east, 3, 0.05);
  EXPECT_LT(horizontal(offset_between(copter_.known_position(), copter_.target())), 0.05);
}

TEST_F(CopterTest, FallsWithoutItsMotors) {
  take_off(50);
  motors_run_ = false;
  const double from = height();
  fly(1);
  // With drag in proportion to the speed: v = g/k (1 - exp(-k t)).
  EXPECT_NEAR(copter_.state().velocity.down, standard_gravity / drag * (1 - std::exp(-drag)), 0.1);
  EXPECT_NEAR(from - height(), 4.5, 0.2);
  fly(10);
  EXPECT_FALSE(copter_.state().airborne);
  EXPECT_EQ(height(), 0);
}

TEST_F(CopterTest, NeedsMoreCurrentToClimbAndToResistTheWind) {
  take_off(20);
  const double hovering = copter_.state().battery.amperes;
  copter_.climb_to(start.altitude_msl + Metres{100});
  fly(10);
  const double climbing = copter_.state().battery.amperes;
  EXPECT_GT(climbing, hovering + 3);
  copter_.climb_to(start.altitude_msl + Metres{20});
  fly(10);
  EXPECT_LT(copter_.state().battery.amperes, hovering);
  fly(60);
  wind_ = {12, 0, 0};
  fly(20);
  EXPECT_GT(copter_.state().battery.amperes, hovering * 1.05);
}

}  // namespace
}  // namespace ponte::sim
