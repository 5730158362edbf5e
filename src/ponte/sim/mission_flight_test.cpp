#include "ponte/sim/mission_flight.hpp"

#include "ponte/sim/flight_rig.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr VehicleKind ardu_copter{Personality::ardupilot, AirframeType::copter};
constexpr VehicleKind px4_copter{Personality::px4, AirframeType::copter};

std::unique_ptr<Airframe> copter() { return std::make_unique<Copter>(CopterConfig{}, field, Radians{}); }

const auto take_off_item = item_at(messages::MAV_CMD_NAV_TAKEOFF, {0, 0, -20});
const auto land_item = item(messages::MAV_CMD_NAV_LAND);
MissionItem waypoint(double north, double east, double height = 20, float dwell = 0) {
  return item_at(messages::MAV_CMD_NAV_WAYPOINT, {north, east, -height}, {dwell});
}

/// In the air at the first item, with ArduCopter's way to start.
FlightRig started(std::vector<MissionItem> items) {
  FlightRig rig{ardu_copter, copter()};
  rig.load(std::move(items));
  rig.arm();
  EXPECT_TRUE(rig.start_mission());
  return rig;
}

double distance_to(const FlightRig& rig, double north, double east) {
  return horizontal(rig.place() - NorthEastDown{north, east, 0});
}

TEST(MissionFlight, IsPausedOnItsWayAndGoesOn) {
  auto rig = started({take_off_item, waypoint(200, 0), land_item});
  EXPECT_FALSE(rig.pause_mission()) << "while it takes off";
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 50; }, seconds{60}));
  EXPECT_TRUE(rig.pause_mission());
  rig.wait(seconds{60});
  EXPECT_LT(rig.place().north, 100);
  EXPECT_EQ(rig.current(), 2);
  EXPECT_EQ(rig.mode(), FlightMode::automatic);
  EXPECT_TRUE(rig.continue_mission());
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 3; }, seconds{60}));
  EXPECT_LT(distance_to(rig, 200, 0), 2);
  EXPECT_FALSE(rig.continue_mission()) << "while it lands";
}

TEST(MissionFlight, FliesFromTakeOffToLandingAsArduCopterTellsIt) {
  auto rig = started({take_off_item, waypoint(80, 0), waypoint(80, 60), land_item});
  EXPECT_EQ(rig.mode(), FlightMode::automatic);
  EXPECT_EQ(rig.flight().landed_state(rig.state()), LandedState::on_ground);
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 2; }, seconds{30}));
  EXPECT_NEAR(rig.height(), 20, 0.35);
  EXPECT_LT(distance_to(rig, 0, 0), 0.1);
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 3; }, seconds{30}));
  EXPECT_LT(distance_to(rig, 80, 0), 2);
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 4; }, seconds{30}));
  EXPECT_LT(distance_to(rig, 80, 60), 2);
  rig.wait(seconds{3});
  EXPECT_EQ(rig.flight().landed_state(rig.state()), LandedState::landing);
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{60}));
  EXPECT_LT(distance_to(rig, 80, 60), 5) << "where it came to a stop";

  EXPECT_EQ(rig.mode(), FlightMode::automatic);
  EXPECT_EQ(rig.current(), 1) << "after disarming";
  EXPECT_THAT(rig.reached, ElementsAre(1, 2, 3));
  EXPECT_THAT(rig.texts, ElementsAre("Mission: 1 Takeoff", "Mission: 2 WP", "Reached command #2", "Mission: 3 WP",
                                     "Reached command #3", "Mission: 4 Land", "Disarming motors"));
}

TEST(MissionFlight, FliesFromTakeOffToLandingAsPx4TellsIt) {
  FlightRig rig{px4_copter, copter()};
  rig.load({take_off_item, waypoint(40, 0), land_item});
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  rig.arm();
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 1; }, seconds{30}));
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{120}));
  EXPECT_THAT(rig.reached, ElementsAre(0, 1, 2));
  EXPECT_THAT(rig.texts, ElementsAre("Executing Mission\t", "Takeoff detected\t", "Landing detected\t",
                                     "Mission finished, landed\t", "Disarmed by landing\t"));
  EXPECT_TRUE(rig.flight().mission().is_finished());
  EXPECT_EQ(rig.current(), 2);
  EXPECT_EQ(rig.mode(), FlightMode::automatic);

  rig.arm();
  rig.wait(seconds{3});
  EXPECT_EQ(rig.current(), 0) << "a new flight begins at the beginning";
  EXPECT_TRUE(rig.is_flying());
}

TEST(MissionFlight, WaitsOnTheGroundOfArduCopterUntilItIsStarted) {
  FlightRig rig{ardu_copter, copter()};
  rig.load({take_off_item, waypoint(40, 0)});
  ASSERT_TRUE(rig.enter(FlightMode::guided));
  rig.arm();
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  rig.wait(seconds{9});
  EXPECT_FALSE(rig.is_flying());
  rig.wait(seconds{2});
  EXPECT_FALSE(rig.state().armed) << "DISARM_DELAY";
}

TEST(MissionFlight, StaysAtTheLastItemInTheAir) {
  auto rig = started({take_off_item, waypoint(30, 0)});
  rig.wait(seconds{60});
  EXPECT_TRUE(rig.flight().mission().is_finished());
  EXPECT_EQ(rig.mode(), FlightMode::automatic);
  EXPECT_LT(distance_to(rig, 30, 0), 5);
  EXPECT_LT(horizontal(rig.state().velocity), 0.01);
  EXPECT_TRUE(rig.state().armed);
}

TEST(MissionFlight, DwellsAtAWaypoint) {
  auto rig = started({take_off_item, waypoint(30, 0, 20, 7), waypoint(30, 30)});
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 30, 0) < 2; }, seconds{60}));
  const auto arrived = rig.now();
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 3; }, seconds{60}));
  EXPECT_NEAR(std::chrono::duration<double>{rig.now() - arrived}.count(), 7, 0.05);
}

TEST(MissionFlight, LoitersForATimeAndForTurnsAndWithoutEnd) {
  auto rig = started({take_off_item, item_at(messages::MAV_CMD_NAV_LOITER_TIME, {20, 0, -20}, {5}),
                      item_at(messages::MAV_CMD_NAV_LOITER_TURNS, {40, 0, -20}, {2, 0, -15}),
                      item_at(messages::MAV_CMD_NAV_LOITER_UNLIM, {0, 0, -20})});
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 20, 0) < 2; }, seconds{60}));
  const auto arrived = rig.now();
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 3; }, seconds{60}));
  EXPECT_NEAR(std::chrono::duration<double>{rig.now() - arrived}.count(), 5, 0.05);

  ASSERT_TRUE(rig.wait_until([&] { return std::abs(distance_to(rig, 40, 0) - 15) < 0.5; }, seconds{60}));
  double turned{};
  auto before = rig.place() - NorthEastDown{40, 0, 0};
  ASSERT_TRUE(rig.wait_until(
      [&] {
        const auto now = rig.place() - NorthEastDown{40, 0, 0};
        turned += wrapped(std::atan2(now.east, now.north) - std::atan2(before.east, before.north));
        before = now;
        return rig.current() == 4;
      },
      seconds{120}));
  EXPECT_NEAR(turned, -2 * 2 * std::numbers::pi, 0.8) << "anticlockwise, since the radius is negative";

  rig.wait(std::chrono::minutes{5});
  EXPECT_EQ(rig.current(), 4);
  EXPECT_LT(distance_to(rig, 0, 0), 0.1);
}

TEST(MissionFlight, ReturnsAndLandsWithinAuto) {
  auto rig = started({take_off_item, waypoint(50, 0), item(messages::MAV_CMD_NAV_RETURN_TO_LAUNCH)});
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{180}));
  EXPECT_LT(distance_to(rig, 0, 0), 0.6);
  EXPECT_EQ(rig.mode(), FlightMode::automatic);
  EXPECT_THAT(rig.texts, Contains("Mission: 3 RTL"));
}

TEST(MissionFlight, Px4ChangesToReturnMode) {
  FlightRig rig{px4_copter, copter()};
  rig.load({take_off_item, waypoint(30, 0), item(messages::MAV_CMD_NAV_RETURN_TO_LAUNCH)});
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  rig.arm();
  ASSERT_TRUE(rig.wait_until([&] { return rig.mode() == FlightMode::rtl; }, seconds{60}));
  ASSERT_TRUE(rig.wait_until([&] { return !rig.state().armed; }, seconds{180}));
  EXPECT_LT(distance_to(rig, 0, 0), 0.6);
  EXPECT_EQ(rig.mode(), FlightMode::loiter) << "where PX4 waits for what comes next";
}

TEST(MissionFlight, ChangesItsSpeedOnTheWay) {
  auto rig = started({take_off_item, item(messages::MAV_CMD_DO_CHANGE_SPEED, {1, 3, -1}), waypoint(200, 0),
                      item(messages::MAV_CMD_DO_CHANGE_SPEED, {1, 8, -1}), waypoint(400, 0)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 100.5; }, seconds{90}));
  EXPECT_NEAR(horizontal(rig.state().velocity), 3, 0.05);
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 300; }, seconds{90}));
  EXPECT_NEAR(horizontal(rig.state().velocity), 8, 0.1);
  EXPECT_THAT(rig.reached, ElementsAre(1, 2, 3, 4));
}

TEST(MissionFlight, PointsItsNoseToARegionOfInterest) {
  const auto ahead = item_at(messages::MAV_CMD_DO_SET_ROI_LOCATION, {0, 500, 0});
  auto rig =
      started({take_off_item, ahead, waypoint(60, 0), item(messages::MAV_CMD_DO_SET_ROI_NONE), waypoint(160, 0)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 50; }, seconds{60}));
  EXPECT_NEAR(rig.state().attitude.heading.value, std::atan2(500, -rig.place().north), 0.05);
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 140; }, seconds{60}));
  EXPECT_NEAR(rig.state().attitude.heading.value, 0, 0.05) << "along the way again";
}

TEST(MissionFlight, JumpsAsOftenAsItIsTold) {
  auto rig = started(
      {take_off_item, waypoint(20, 0), waypoint(0, 0), item(messages::MAV_CMD_DO_JUMP, {2, 2}), waypoint(0, 20)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 5; }, seconds{180}));
  EXPECT_THAT(rig.reached, ElementsAre(1, 2, 3, 2, 3, 2, 3));
}

TEST(MissionFlight, SurvivesJumpsThatLeadNowhere) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& jump : {item(messages::MAV_CMD_DO_JUMP, {3, -1}), item(messages::MAV_CMD_DO_JUMP, {99, 5}),
                           item(messages::MAV_CMD_DO_JUMP, {-4, -1}), item(messages::MAV_CMD_DO_JUMP, {nan, nan}),
                           item(messages::MAV_CMD_DO_JUMP, {0, 0})}) {
    auto rig = started({take_off_item, waypoint(10, 0), jump});
    rig.wait(seconds{60});
    EXPECT_TRUE(rig.flight().mission().is_finished()) << jump.param1 << ' ' << jump.param2;
    EXPECT_TRUE(rig.is_flying());
  }
}

TEST(MissionFlight, ConditionsHoldUpWhatComesAfterThem) {
  auto rig = started({take_off_item, item(messages::MAV_CMD_CONDITION_DISTANCE, {50}),
                      item(messages::MAV_CMD_DO_CHANGE_SPEED, {1, 2, -1}), item(messages::MAV_CMD_CONDITION_DELAY, {3}),
                      item(messages::MAV_CMD_DO_CHANGE_SPEED, {1, 4, -1}), waypoint(150, 0)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 90; }, seconds{60}));
  EXPECT_NEAR(horizontal(rig.state().velocity), 10, 0.2);
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 100.5; }, seconds{60}));
  const auto slow = rig.now();
  EXPECT_THAT(rig.reached, ElementsAre(1, 2, 3, 4));
  ASSERT_TRUE(rig.wait_until([&] { return rig.reached.size() == 5; }, seconds{60}));
  EXPECT_NEAR(std::chrono::duration<double>{rig.now() - slow}.count(), 3, 0.2);
}

TEST(MissionFlight, GoesToAnotherItemWhenItIsTold) {
  auto rig = started({take_off_item, waypoint(500, 0), waypoint(0, 40)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.place().north > 30; }, seconds{60}));
  EXPECT_FALSE(rig.set_item(9));
  ASSERT_TRUE(rig.set_item(3));
  EXPECT_EQ(rig.current(), 3);
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 0, 40) < 2; }, seconds{60}));
  EXPECT_THAT(rig.reached, ElementsAre(1));
}

TEST(MissionFlight, GoesOnWhereItWasInterrupted) {
  auto rig = started({take_off_item, waypoint(60, 0), waypoint(60, 60)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 3; }, seconds{60}));
  ASSERT_TRUE(rig.enter(FlightMode::loiter));
  rig.wait(seconds{20});
  EXPECT_EQ(rig.current(), 3);
  EXPECT_LT(horizontal(rig.state().velocity), 0.05);
  ASSERT_TRUE(rig.enter(FlightMode::automatic));
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 60, 60) < 2; }, seconds{60}));
}

TEST(MissionFlight, FliesOnAfterAnItemThatItDoesNotKnow) {
  auto rig = started({take_off_item, item_at(99, {10, 0, -20}), waypoint(20, 0)});
  ASSERT_TRUE(rig.wait_until([&] { return distance_to(rig, 20, 0) < 2; }, seconds{60}));
  EXPECT_EQ(rig.current(), 3);
}

TEST(MissionFlight, CountsHeightsFromHomeOrFromTheSea) {
  auto over_sea = waypoint(20, 0);
  over_sea.frame = messages::MAV_FRAME_GLOBAL;
  over_sea.z = 95;
  auto rig = started({take_off_item, over_sea});
  ASSERT_TRUE(rig.wait_until([&] { return rig.reached.size() == 2; }, seconds{60}));
  EXPECT_NEAR(rig.height(), 45, 1);
}

TEST(MissionFlight, HasNothingToFlyWithoutItems) {
  FlightRig rig{ardu_copter, copter()};
  rig.load({});
  ASSERT_TRUE(rig.enter(FlightMode::guided));
  rig.arm();
  EXPECT_FALSE(rig.start_mission());
  EXPECT_FALSE(rig.enter(FlightMode::automatic));
  EXPECT_FALSE(rig.set_item(1));
  EXPECT_EQ(rig.current(), 0);
  FlightRig px4{px4_copter, copter()};
  EXPECT_FALSE(px4.enter(FlightMode::automatic));
}

TEST(MissionFlight, SurvivesANewMissionInTheMiddleOfTheOldOne) {
  auto rig = started({take_off_item, waypoint(60, 0), waypoint(60, 60), waypoint(0, 60)});
  ASSERT_TRUE(rig.wait_until([&] { return rig.current() == 4; }, seconds{90}));
  rig.load({take_off_item, waypoint(30, 0)});
  rig.wait(seconds{1});
  EXPECT_TRUE(rig.is_flying());
  rig.load({});
  rig.wait(seconds{5});
  EXPECT_TRUE(rig.is_flying());
}

}  // namespace
}  // namespace ponte::sim
