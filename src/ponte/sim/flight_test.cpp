#include "ponte/sim/flight.hpp"

#include "ponte/sim/flight_rig.hpp"
#include "ponte/sim/plane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

constexpr VehicleKind ardu_copter{Personality::ardupilot, AirframeType::copter};
constexpr VehicleKind ardu_plane{Personality::ardupilot, AirframeType::plane};
constexpr VehicleKind px4_copter{Personality::px4, AirframeType::copter};
constexpr VehicleKind px4_plane{Personality::px4, AirframeType::plane};

FlightRig rig_of(VehicleKind kind) {
  if (kind.type == AirframeType::plane) return {kind, std::make_unique<Plane>(PlaneConfig{}, field, Radians{})};
  return {kind, std::make_unique<Copter>(CopterConfig{}, field, Radians{})};
}

/// In the air, 20 m above home, in GUIDED of ArduCopter or in AUTO.LOITER of PX4.
FlightRig hovering(VehicleKind kind) {
  auto rig = rig_of(kind);
  EXPECT_TRUE(rig.enter(kind.personality == Personality::ardupilot ? FlightMode::guided : FlightMode::loiter));
  rig.arm();
  EXPECT_TRUE(rig.take_off(20));
  rig.wait(seconds{25});
  EXPECT_NEAR(rig.height(), 20, 0.1);
  return rig;
}

/// Circling, 80 m above home.
FlightRig soaring(VehicleKind kind) {
  auto rig = rig_of(kind);
  EXPECT_TRUE(rig.enter(FlightMode::take_off));
  rig.arm();
  EXPECT_TRUE(
      rig.wait_until([&] { return rig.height() > rig.flight().settings().take_off_height.value - 0.3; }, seconds{60}));
  EXPECT_TRUE(rig.enter(FlightMode::loiter));
  rig.wait(seconds{20});
  return rig;
}

Position at(double north, double east, double height) { return displaced(field, {north, east, -height}); }

double distance_to(const FlightRig& rig, double north, double east) {
  return horizontal(rig.place() - NorthEastDown{north, east, 0});
}

TEST(Modes, HaveTheNumbersAndNamesOfTheirAutopilots) {
  EXPECT_EQ(flight_mode_info(ardu_copter, FlightMode::rtl).custom_mode, 6U);
  EXPECT_EQ(flight_mode_info(ardu_plane, FlightMode::rtl).custom_mode, 11U);
  EXPECT_EQ(flight_mode_info(px4_copter, FlightMode::rtl).custom_mode, 0x05040000U);
  EXPECT_EQ(flight_mode_info(px4_plane, FlightMode::guided).custom_mode, 0x00060000U);
  EXPECT_EQ(flight_mode_info(px4_copter, FlightMode::automatic).name, "AUTO.MISSION");
  EXPECT_EQ(flight_mode(ardu_plane, 10), FlightMode::automatic);
  EXPECT_EQ(flight_mode(ardu_copter, 10), std::nullopt);
  EXPECT_FALSE(has_mode(ardu_plane, FlightMode::land));
}

TEST(Modes, AreEnteredOnlyIfTheKindHasThem) {
  auto rig = rig_of(ardu_plane);
  EXPECT_FALSE(rig.enter(FlightMode::land));
  EXPECT_FALSE(rig.enter(FlightMode::brake));
  EXPECT_EQ(rig.mode(), FlightMode::manual);
}

TEST(Modes, NeedAPositionInTheAir) {
  auto rig = hovering(ardu_copter);
  rig.flight().set_has_position(false);
  EXPECT_FALSE(rig.enter(FlightMode::rtl));
  EXPECT_FALSE(rig.enter(FlightMode::loiter));
  EXPECT_EQ(rig.mode(), FlightMode::guided);
  EXPECT_TRUE(rig.enter(FlightMode::altitude_hold));
}

TEST(Modes, OfAPilotWhoNeverSteersDriftWithTheWind) {
  for (const auto mode : {FlightMode::stabilize, FlightMode::altitude_hold}) {
    auto rig = hovering(ardu_copter);
    ASSERT_TRUE(rig.enter(mode));
    rig.conditions().wind = {0, 4, 0};
    rig.wait(seconds{30});
    EXPECT_GT(rig.place().east, 60);
    EXPECT_NEAR(rig.height(), 20, 0.1);
    ASSERT_TRUE(rig.enter(FlightMode::loiter));
    rig.wait(seconds{10});
    const double east = rig.place().east;
    rig.wait(seconds{20});
    EXPECT_NEAR(rig.place().east, east, 0.5);
  }
}

TEST(Modes, LandWithoutAPositionWhereverTheWindTakesIt) {
  auto rig = hovering(ardu_copter);
  rig.flight().set_has_position(false);
  rig.conditions().wind = {3, 0, 0};
  ASSERT_TRUE(rig.enter(FlightMode::land));
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{60}));
  EXPECT_GT(rig.place().north, 20);
}

TEST(Modes, CircleAroundAPlaceAhead) {
  auto rig = hovering(ardu_copter);
  ASSERT_TRUE(rig.enter(FlightMode::circle));
  rig.wait(seconds{60});
  EXPECT_NEAR(distance_to(rig, 10, 0), 10, 0.3);
}

TEST(Guided, FliesToAPositionAndStays) {
  auto rig = hovering(ardu_copter);
  EXPECT_TRUE(rig.guide({.position = at(60, 30, 30)}));
  rig.wait(seconds{40});
  EXPECT_LT(distance_to(rig, 60, 30), 0.1);
  EXPECT_NEAR(rig.height(), 30, 0.1);
  rig.change_speed(2);
  EXPECT_TRUE(rig.guide({.position = at(0, 30, 30)}));
  rig.wait(seconds{10});
  EXPECT_NEAR(horizontal(rig.state().velocity), 2, 0.05);
}

TEST(Guided, StopsWhenVelocitiesNoLongerCome) {
  auto rig = hovering(ardu_copter);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(rig.guide({.velocity = NorthEastDown{0, 3, 0}}));
    rig.wait(milliseconds{500});
  }
  EXPECT_NEAR(rig.state().velocity.east, 3, 0.05);
  rig.wait(milliseconds{2400});
  EXPECT_NEAR(rig.state().velocity.east, 3, 0.05) << "GUID_TIMEOUT is 3 s";
  rig.wait(seconds{8});
  EXPECT_NEAR(horizontal(rig.state().velocity), 0, 0.02);
}

TEST(Guided, TurnsTheNose) {
  auto rig = hovering(ardu_copter);
  EXPECT_TRUE(rig.guide({.heading = Radians{-1}}));
  rig.wait(seconds{8});
  EXPECT_NEAR(rig.state().attitude.heading.value, -1, 0.01);
  EXPECT_TRUE(rig.guide({.velocity = NorthEastDown{}, .turn_rate = RadiansPerSecond{0.2}}));
  rig.wait(seconds{2});
  EXPECT_NEAR(rig.state().rates.z, 0.2, 0.01);
}

TEST(Guided, IsForArduPilotsGuidedModeInTheAirOnly) {
  auto rig = rig_of(ardu_copter);
  EXPECT_FALSE(rig.guide({.position = at(10, 0, 10)})) << "STABILIZE";
  ASSERT_TRUE(rig.enter(FlightMode::guided));
  rig.arm();
  EXPECT_FALSE(rig.guide({.position = at(10, 0, 10)})) << "on the ground";
  rig.wait(seconds{5});
  EXPECT_FALSE(rig.is_flying());
  EXPECT_FALSE(rig.take_off(-1));
  EXPECT_FALSE(rig.take_off(5000));
}

TEST(Guided, OffboardNeedsAStreamBeforeAndForEver) {
  auto rig = hovering(px4_copter);
  EXPECT_FALSE(rig.enter(FlightMode::guided)) << "no setpoint has come";
  const GuidedTarget north{.velocity = NorthEastDown{2, 0, 0}};
  EXPECT_TRUE(rig.guide(north));
  rig.wait(milliseconds{1100});
  EXPECT_FALSE(rig.enter(FlightMode::guided)) << "it is stale";
  EXPECT_LT(horizontal(rig.state().velocity), 0.01);
  EXPECT_TRUE(rig.guide(north));
  ASSERT_TRUE(rig.enter(FlightMode::guided));
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(rig.guide(north));
    rig.wait(milliseconds{400});
  }
  EXPECT_NEAR(rig.state().velocity.north, 2, 0.02);
  rig.wait(milliseconds{1500});
  EXPECT_EQ(rig.mode(), FlightMode::position_hold) << "COM_OF_LOSS_T, COM_OBL_RC_ACT";
  rig.wait(seconds{8});
  EXPECT_LT(horizontal(rig.state().velocity), 0.02);
}

TEST(Guided, RepositionsInTheModeThatKeepsTheTarget) {
  auto copter = hovering(px4_copter);
  ASSERT_TRUE(copter.reposition({.position = at(30, 0, 25)}));
  copter.wait(seconds{40});
  EXPECT_EQ(copter.mode(), FlightMode::loiter);
  EXPECT_LT(distance_to(copter, 30, 0), 0.1);

  auto plane = soaring(ardu_plane);
  ASSERT_TRUE(plane.reposition({.position = at(800, 0, 90), .radius = Metres{-100}}));
  EXPECT_EQ(plane.mode(), FlightMode::guided);
  plane.wait(seconds{120});
  EXPECT_NEAR(distance_to(plane, 800, 0), 100, 3);
  EXPECT_LT(plane.state().attitude.roll.value, -0.2) << "to the left";
  EXPECT_NEAR(plane.height(), 90, 0.5);
}

TEST(TakeOff, OfPx4EndsInLoiter) {
  auto rig = hovering(px4_copter);
  EXPECT_EQ(rig.mode(), FlightMode::loiter);
  EXPECT_THAT(rig.texts, ElementsAre("Takeoff detected\t"));
  auto by_mode = rig_of(px4_copter);
  ASSERT_TRUE(by_mode.enter(FlightMode::take_off));
  by_mode.arm();
  by_mode.wait(seconds{10});
  EXPECT_NEAR(by_mode.height(), 2.5, 0.1) << "MIS_TAKEOFF_ALT";
}

TEST(TakeOff, OfAPlaneEndsInACircle) {
  auto rig = soaring(ardu_plane);
  EXPECT_NEAR(rig.height(), 50, 1) << "TKOFF_ALT";
  rig.wait(seconds{40});
  EXPECT_NEAR(rig.state().attitude.roll.value, std::atan(22 * 22 / (standard_gravity * 60)), 0.03);
}

TEST(Return, ClimbsLessNearHome) {
  auto rig = rig_of(ardu_copter);
  ASSERT_TRUE(rig.enter(FlightMode::guided));
  rig.arm();
  ASSERT_TRUE(rig.take_off(3));
  rig.wait(seconds{10});
  ASSERT_TRUE(rig.guide({.position = at(2, 0, 3)}));
  rig.wait(seconds{10});
  ASSERT_TRUE(rig.enter(FlightMode::rtl));
  double highest{};
  ASSERT_TRUE(rig.wait_until(
      [&] {
        highest = std::max(highest, rig.height());
        return !rig.state().armed;
      },
      seconds{60}));
  EXPECT_NEAR(highest, 6, 0.4) << "RTL_CONE_SLOPE 3, two metres away";
}

TEST(Return, WaitsOverHomeBeforeItLands) {
  auto rig = hovering(ardu_copter);
  ASSERT_TRUE(rig.guide({.position = at(40, 0, 20)}));
  rig.wait(seconds{20});
  ASSERT_TRUE(rig.enter(FlightMode::rtl));
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 0, 0) < 0.5; }, seconds{60}));
  rig.wait(seconds{5});
  EXPECT_NEAR(rig.height(), 20, 0.2) << "RTL_LOIT_TIME";
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{60}));
  EXPECT_LT(distance_to(rig, 0, 0), 0.6);
}

TEST(Return, OfAPlaneCirclesOverHome) {
  auto rig = soaring(ardu_plane);
  ASSERT_TRUE(rig.enter(FlightMode::rtl));
  rig.wait(std::chrono::minutes{2});
  for (int i = 0; i < 60; ++i) {
    rig.wait(seconds{1});
    ASSERT_NEAR(distance_to(rig, 0, 0), 60, 3);
    ASSERT_NEAR(rig.height(), 100, 1) << "RTL_ALTITUDE";
  }
}

TEST(PlaneMission, IsFlownAndLandedAsArduPlaneTellsIt) {
  auto rig = rig_of(ardu_plane);
  rig.load({item_at(messages::MAV_CMD_NAV_TAKEOFF, {400, 0, -60}),
            item_at(messages::MAV_CMD_NAV_WAYPOINT, {600, 0, -80}),
            item_at(messages::MAV_CMD_NAV_WAYPOINT, {600, 600, -80}),
            item_at(messages::MAV_CMD_NAV_LOITER_TURNS, {0, 600, -80}, {1, 0, 100}),
            item_at(messages::MAV_CMD_NAV_WAYPOINT, {0, -900, -40}),
            item_at(messages::MAV_CMD_NAV_WAYPOINT, {-50, -600, -25}), item_at(messages::MAV_CMD_NAV_LAND, {0, 0, 0})});
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  rig.arm();
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 3; }, seconds{90}));
  EXPECT_LT(distance_to(rig, 600, 0), 51) << "WP_RADIUS";
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 5; }, seconds{180}));
  EXPECT_NEAR(distance_to(rig, 0, 600), 100, 5);
  ASSERT_TRUE(rig.wait_until([&] { return !rig.is_flying(); }, seconds{300}));
  EXPECT_LT(distance_to(rig, 0, 0), 120);
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{25}));
  EXPECT_EQ(rig.mode(), FlightMode::automatic);
  EXPECT_THAT(rig.reached, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(rig.texts, Contains("Loiter orbits complete"));
  EXPECT_EQ(rig.texts.back(), "Auto disarmed");
}

TEST(PlaneMission, EndsWithAReturnInTheAir) {
  auto rig = rig_of(ardu_plane);
  rig.load(
      {item_at(messages::MAV_CMD_NAV_TAKEOFF, {400, 0, -60}), item_at(messages::MAV_CMD_NAV_WAYPOINT, {600, 0, -80})});
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  rig.arm();
  ASSERT_TRUE(rig.wait_until([&] { return rig.mode() == FlightMode::rtl; }, seconds{120}));
  EXPECT_THAT(rig.texts, Contains("Mission complete, changing mode to RTL"));
}

TEST(PlaneMission, HoldsItsCircleForATime) {
  auto rig = rig_of(px4_plane);
  rig.load({item_at(messages::MAV_CMD_NAV_TAKEOFF, {400, 0, -60}),
            item_at(messages::MAV_CMD_NAV_LOITER_TIME, {600, 0, -60}, {30}),
            item_at(messages::MAV_CMD_NAV_WAYPOINT, {0, 600, -60})});
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  rig.arm();
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 600, 0) < 96; }, seconds{90}));
  const auto there = rig.now();
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 2; }, seconds{60}));
  EXPECT_NEAR(std::chrono::duration<double>{rig.now() - there}.count(), 30, 0.2);
}

}  // namespace
}  // namespace ponte::sim
