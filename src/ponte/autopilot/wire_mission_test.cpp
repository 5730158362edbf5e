#include "ponte/autopilot/wire_mission.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

vehicle::Place place(double latitude, double longitude) {
  return {radians_from_degrees(latitude), radians_from_degrees(longitude)};
}
constexpr vehicle::Altitude above_home{Metres{40}, vehicle::AltitudeFrame::home};

/// A mission of every kind of item, one of each.
vehicle::Mission mission() {
  vehicle::Mission result{.home = vehicle::Home{place(-30.06898, -51.12179), Metres{50}}};
  const auto add = [&](vehicle::Action action) { result.items.push_back({.action = std::move(action), .name = {}}); };
  add(vehicle::TakeOffItem{.altitude = above_home});
  add(vehicle::WaypointItem{.place = place(-30.0699, -51.12096), .altitude = above_home, .dwell = vehicle::Seconds{5}});
  add(vehicle::SpeedItem{.kind = vehicle::SpeedKind::ground, .speed = MetresPerSecond{7.5}});
  add(vehicle::JumpItem{.target = 1, .times = 2});
  add(vehicle::LoiterItem{.place = place(-30.07, -51.12), .altitude = above_home, .lasts = vehicle::Turns{3}});
  add(vehicle::ReturnItem{});
  return result;
}

std::vector<WireItem> wire(Stack stack, PlanType type, const vehicle::Mission& mission) {
  auto result = to_wire(stack, type, mission);
  EXPECT_TRUE(result.has_value());
  return result.value_or(std::vector<WireItem>{});
}

TEST(ToWire, BeginsWithHomeForArduPilotAndShiftsJumps) {
  const auto items = wire(Stack::ardupilot_copter, PlanType::mission, mission());
  ASSERT_THAT(items, SizeIs(7));
  EXPECT_EQ(items[0].command, messages::MAV_CMD_NAV_WAYPOINT);
  EXPECT_EQ(items[0].frame, messages::MAV_FRAME_GLOBAL);
  EXPECT_EQ(items[0].x, -300'689'800);
  EXPECT_EQ(items[0].y, -511'217'900);
  EXPECT_EQ(items[0].z, 50);
  EXPECT_EQ(items[4].command, messages::MAV_CMD_DO_JUMP);
  EXPECT_EQ(items[4].param1, 2);
  EXPECT_EQ(items[4].param2, 2);
}

TEST(ToWire, HasNoHomeForPx4) {
  const auto items = wire(Stack::px4, PlanType::mission, mission());
  ASSERT_THAT(items, SizeIs(6));
  EXPECT_EQ(items[1].command, messages::MAV_CMD_NAV_WAYPOINT);
  EXPECT_EQ(items[1].frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT);
  EXPECT_EQ(items[1].param1, 5);
  EXPECT_EQ(items[1].x, -300'699'000);
  EXPECT_EQ(items[1].y, -511'209'600);
  EXPECT_EQ(items[3].param1, 1);
}

TEST(ToWire, LeavesYawToPx4AsNanAndToArduPilotAsZero) {
  EXPECT_TRUE(std::isnan(wire(Stack::px4, PlanType::mission, mission())[0].param4));
  EXPECT_EQ(wire(Stack::ardupilot_copter, PlanType::mission, mission())[1].param4, 0);
}

TEST(ToWire, MakesNothingOfAPlanWithoutItems) {
  for (const auto type : {PlanType::mission, PlanType::fence, PlanType::rally})
    EXPECT_THAT(wire(Stack::ardupilot_copter, type, vehicle::Mission{}), IsEmpty());
}

TEST(ToWire, RefusesWhatTheIntegersCannotSay) {
  vehicle::Mission with_fraction;
  vehicle::OtherItem item{.command = messages::MAV_CMD_DO_SET_SERVO, .frame = 2, .parameters = {9, 1500, 0, 0, 0.5}};
  with_fraction.items.push_back({.action = item, .name = {}});
  EXPECT_EQ(to_wire(Stack::px4, PlanType::mission, with_fraction),
            fail(WireRefusal{0, "parameter 5 or 6 has no place and is not a whole number"}));
  item.parameters[4] = 1e10;
  with_fraction.items[0].action = item;
  EXPECT_EQ(to_wire(Stack::ardupilot_copter, PlanType::mission, with_fraction),
            fail(WireRefusal{1, "parameter 5 or 6 is too large"}));
}

TEST(FromWire, IsTheInverseForBothAutopilots) {
  for (const auto stack : {Stack::ardupilot_copter, Stack::px4}) {
    vehicle::Mission back;
    ASSERT_TRUE(from_wire(stack, PlanType::mission, wire(stack, PlanType::mission, mission()), back).has_value());
    auto expected = mission();
    if (stack == Stack::px4) {
      expected.home.reset();
    } else {  // it chooses where its nose points, which ArduPilot says with 0
      std::get<vehicle::TakeOffItem>(expected.items[0].action).yaw = Radians{};
      std::get<vehicle::WaypointItem>(expected.items[1].action).yaw = Radians{};
    }
    EXPECT_EQ(back, expected);
  }
}

TEST(FromWire, KeepsAJumpToNowhereAsItIs) {
  const WireItem jump{.frame = 2, .command = messages::MAV_CMD_DO_JUMP, .param1 = 9, .param2 = 1};
  vehicle::Mission back;
  ASSERT_TRUE(from_wire(Stack::px4, PlanType::mission, std::array{jump}, back).has_value());
  ASSERT_THAT(back.items, SizeIs(1));
  EXPECT_TRUE(std::holds_alternative<vehicle::OtherItem>(back.items[0].action));
  EXPECT_EQ(wire(Stack::px4, PlanType::mission, back)[0].param1, 9);
}

TEST(Fence, GoesThereAndBack) {
  vehicle::Mission mission;
  mission.fence_return = vehicle::RallyPoint{place(-30.1, -51.1), above_home};
  mission.fence_polygons = {{.corners = {place(-30, -51), place(-30.2, -51), place(-30.2, -51.2)}},
                            {.corners = {place(-30, -51), place(-30.1, -51), place(-30.1, -51.1)}, .inclusion = false}};
  mission.fence_circles = {{.centre = place(-30.05, -51.05), .radius = Metres{75}, .inclusion = false}};
  const auto items = wire(Stack::ardupilot_copter, PlanType::fence, mission);
  ASSERT_THAT(items, SizeIs(8));
  EXPECT_EQ(items[1].command, messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION);
  EXPECT_EQ(items[1].param1, 3);
  EXPECT_EQ(items[7].param1, 75);
  vehicle::Mission back;
  ASSERT_TRUE(from_wire(Stack::ardupilot_copter, PlanType::fence, items, back).has_value());
  EXPECT_EQ(back, mission);
}

TEST(Fence, IsRefusedWhereItsCornersDoNotBelongTogether) {
  WireItem corner{.command = messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, .param1 = 3};
  std::vector<WireItem> items(3, corner);
  vehicle::Mission back;
  EXPECT_TRUE(from_wire(Stack::px4, PlanType::fence, items, back).has_value());
  items[2].param1 = 4;
  EXPECT_EQ(from_wire(Stack::px4, PlanType::fence, items, back),
            fail(WireRefusal{0, "the corners of a polygon do not belong together"}));
  items.pop_back();
  EXPECT_EQ(from_wire(Stack::px4, PlanType::fence, items, back),
            fail(WireRefusal{0, "a polygon has fewer corners than it says, or than three"}));
  items = {WireItem{.command = messages::MAV_CMD_NAV_WAYPOINT}};
  EXPECT_EQ(from_wire(Stack::px4, PlanType::fence, items, back),
            fail(WireRefusal{0, "the command is none of a fence"}));
}

TEST(Rally, GoesThereAndBack) {
  vehicle::Mission mission;
  mission.rally_points = {{place(-30, -51), above_home},
                          {place(-30.1, -51), {Metres{90}, vehicle::AltitudeFrame::msl}}};
  for (const auto stack : {Stack::ardupilot_plane, Stack::px4}) {
    const auto items = wire(stack, PlanType::rally, mission);
    ASSERT_THAT(items, SizeIs(2));
    EXPECT_EQ(items[0].command, messages::MAV_CMD_NAV_RALLY_POINT);
    vehicle::Mission back;
    ASSERT_TRUE(from_wire(stack, PlanType::rally, items, back).has_value());
    EXPECT_EQ(back, mission);
  }
}

}  // namespace
}  // namespace ponte::autopilot
