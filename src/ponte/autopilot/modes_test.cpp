#include "ponte/autopilot/modes.hpp"

#include "ponte/core/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace ponte::autopilot {
namespace {

using namespace std::string_view_literals;
using vehicle::Mode;
using enum vehicle::ModeKind;

constexpr std::uint8_t generic = 0, ardupilot = 3, invalid = 8, px4_autopilot = 12;  // MAV_AUTOPILOT

struct Expected {
  std::uint32_t custom_mode;
  std::string_view name;
  vehicle::ModeKind kind;
  std::uint8_t variant;
};

void expect_modes(Stack stack, const std::vector<Expected>& expected) {
  for (const auto& each : expected) {
    const Mode wanted{each.kind, each.variant, each.name};
    EXPECT_EQ(mode_from(stack, each.custom_mode), wanted)
        << each.custom_mode << ' ' << mode_from(stack, each.custom_mode).name.view();
  }
  EXPECT_EQ(modes_of(stack).size(), expected.size()) << "a mode without its test";
}

TEST(Modes, OfArduCopter) {
  expect_modes(Stack::ardupilot_copter, {{0, "STABILIZE", manual, 0},
                                         {1, "ACRO", manual, 0},
                                         {2, "ALT_HOLD", manual, 0},
                                         {3, "AUTO", mission, 0},
                                         {4, "GUIDED", guided, 0},
                                         {5, "LOITER", hold, 0},
                                         {6, "RTL", return_home, 0},
                                         {7, "CIRCLE", hold, 0},
                                         {9, "LAND", land, 0},
                                         {11, "DRIFT", other, 11},
                                         {13, "SPORT", manual, 0},
                                         {14, "FLIP", other, 14},
                                         {15, "AUTOTUNE", other, 15},
                                         {16, "POSHOLD", hold, 0},
                                         {17, "BRAKE", hold, 0},
                                         {18, "THROW", other, 18},
                                         {19, "AVOID_ADSB", other, 19},
                                         {20, "GUIDED_NOGPS", other, 20},
                                         {21, "SMART_RTL", smart_return, 0},
                                         {22, "FLOWHOLD", other, 22},
                                         {23, "FOLLOW", other, 23},
                                         {24, "ZIGZAG", other, 24},
                                         {25, "SYSTEMID", other, 25},
                                         {26, "AUTOROTATE", other, 26},
                                         {27, "AUTO_RTL", other, 27},
                                         {28, "TURTLE", other, 28}});
}

TEST(Modes, OfArduPlane) {
  expect_modes(Stack::ardupilot_plane, {{0, "MANUAL", manual, 0},
                                        {1, "CIRCLE", hold, 0},
                                        {2, "STABILIZE", manual, 0},
                                        {3, "TRAINING", other, 3},
                                        {4, "ACRO", other, 4},
                                        {5, "FBWA", manual, 0},
                                        {6, "FBWB", manual, 0},
                                        {7, "CRUISE", guided, 0},
                                        {8, "AUTOTUNE", other, 8},
                                        {10, "AUTO", mission, 0},
                                        {11, "RTL", return_home, 0},
                                        {12, "LOITER", hold, 0},
                                        {13, "TAKEOFF", take_off, 0},
                                        {14, "AVOID_ADSB", other, 14},
                                        {15, "GUIDED", guided, 0},
                                        {16, "INITIALISING", none, 0},
                                        {17, "QSTABILIZE", other, 17},
                                        {18, "QHOVER", other, 18},
                                        {19, "QLOITER", hold, 0},
                                        {20, "QLAND", land, 0},
                                        {21, "QRTL", vtol_return, 0},
                                        {22, "QAUTOTUNE", other, 22},
                                        {23, "QACRO", other, 23},
                                        {24, "THERMAL", other, 24},
                                        {25, "LOITER_ALT_QLAND", other, 25},
                                        {26, "AUTOLAND", land, 0}});
}

TEST(Modes, OfPx4) {
  expect_modes(Stack::px4, {{0x00010000, "MANUAL", manual, 0},
                            {0x00020000, "ALTCTL", manual, 0},
                            {0x00030000, "POSCTL", manual, 0},
                            {0x01030000, "POSCTL.ORBIT", hold, 0},
                            {0x02030000, "POSCTL.SLOW", manual, 0},
                            {0x01040000, "AUTO.READY", other, 33},
                            {0x02040000, "AUTO.TAKEOFF", take_off, 0},
                            {0x03040000, "AUTO.LOITER", hold, 0},
                            {0x04040000, "AUTO.MISSION", mission, 0},
                            {0x05040000, "AUTO.RTL", return_home, 0},
                            {0x06040000, "AUTO.LAND", land, 0},
                            {0x08040000, "AUTO.FOLLOW_TARGET", guided, 0},
                            {0x09040000, "AUTO.PRECLAND", other, 41},
                            {0x0A040000, "AUTO.VTOL_TAKEOFF", other, 42},
                            {0x0B040000, "AUTO.EXTERNAL1", other, 43},
                            {0x0C040000, "AUTO.EXTERNAL2", other, 44},
                            {0x0D040000, "AUTO.EXTERNAL3", other, 45},
                            {0x0E040000, "AUTO.EXTERNAL4", other, 46},
                            {0x0F040000, "AUTO.EXTERNAL5", other, 47},
                            {0x10040000, "AUTO.EXTERNAL6", other, 48},
                            {0x11040000, "AUTO.EXTERNAL7", other, 49},
                            {0x12040000, "AUTO.EXTERNAL8", other, 50},
                            {0x13040000, "AUTO.GUIDED_COURSE", other, 51},
                            {0x00050000, "ACRO", manual, 0},
                            {0x00060000, "OFFBOARD", guided, 0},
                            {0x00070000, "STABILIZED", manual, 0},
                            {0x00080000, "RATTITUDE", other, 8},
                            {0x00090000, "SIMPLE", other, 9},
                            {0x000A0000, "TERMINATION", other, 10},
                            {0x000B0000, "ALTITUDE_CRUISE", other, 11}});
}

TEST(Modes, OfAKindAreThoseThatNeedNoPilot) {
  const auto name = [](Stack stack, vehicle::ModeKind kind) {
    const auto mode = custom_mode_for(stack, kind);
    return mode ? std::string{mode_from(stack, *mode).name.view()} : "none";
  };
  EXPECT_EQ(name(Stack::ardupilot_copter, hold), "LOITER");
  EXPECT_EQ(name(Stack::ardupilot_copter, guided), "GUIDED");
  EXPECT_EQ(name(Stack::ardupilot_copter, take_off), "none");
  EXPECT_EQ(name(Stack::ardupilot_plane, hold), "LOITER");
  EXPECT_EQ(name(Stack::ardupilot_plane, guided), "GUIDED");
  EXPECT_EQ(name(Stack::ardupilot_plane, land), "AUTOLAND");
  EXPECT_EQ(name(Stack::px4, hold), "AUTO.LOITER");
  EXPECT_EQ(name(Stack::px4, guided), "OFFBOARD");
  EXPECT_EQ(name(Stack::px4, mission), "AUTO.MISSION");
  EXPECT_EQ(name(Stack::px4, other), "none");
  EXPECT_EQ(name(Stack::unknown, hold), "none");
}

TEST(Modes, AreFoundByName) {
  EXPECT_EQ(custom_mode_named(Stack::ardupilot_copter, "RTL"), 6);
  EXPECT_EQ(custom_mode_named(Stack::px4, "AUTO.RTL"), 0x0504'0000);
  EXPECT_EQ(custom_mode_named(Stack::px4, "RTL"), std::nullopt);
}

TEST(Modes, AreNamedByNumberWhereNoTableHasThem) {
  EXPECT_EQ(mode_from(Stack::ardupilot_copter, 8), (Mode{other, 8, "mode 8"sv}));
  EXPECT_EQ(mode_from(Stack::ardupilot_plane, 9), (Mode{other, 9, "mode 9"sv}));
  EXPECT_EQ(mode_from(Stack::ardupilot_copter, 127), (Mode{other, 127, "mode 127"sv}));
  EXPECT_EQ(mode_from(Stack::px4, 0x07040000), (Mode{other, 39, "mode 117702656"sv}));
  EXPECT_EQ(mode_from(Stack::unknown, 4), (Mode{other, 4, "mode 4"sv}));
  EXPECT_EQ(mode_from(Stack::ardupilot_copter, 4294967295), (Mode{other, 127, "mode 4294967295"sv}));
}

TEST(Modes, AreAscendingSoThatTheyAreFound) {
  for (const auto stack : {Stack::ardupilot_copter, Stack::ardupilot_plane, Stack::px4})
    EXPECT_TRUE(std::ranges::is_sorted(modes_of(stack), std::ranges::less{}, &ModeRow::custom_mode));
  EXPECT_TRUE(modes_of(Stack::unknown).empty());
}

TEST(Modes, OfKindOtherHaveDifferentVariantsThatFitTheDli) {
  constexpr int largest_variant = 255 - 64;
  for (const auto stack : {Stack::ardupilot_copter, Stack::ardupilot_plane, Stack::px4}) {
    std::set<std::uint8_t> variants;
    for (const auto& row : modes_of(stack)) {
      if (row.kind != other) continue;
      const auto mode = mode_from(stack, row.custom_mode);
      EXPECT_TRUE(variants.insert(mode.variant).second) << row.name;
      EXPECT_LE(mode.variant, largest_variant) << row.name;
    }
  }
}

TEST(Modes, TableFollowsFromAutopilotAndAirframe) {
  std::map<Stack, std::set<int>> airframes;
  for (int type = 0; type <= 255; ++type) airframes[stack_of(ardupilot, static_cast<std::uint8_t>(type))].insert(type);
  EXPECT_EQ(airframes[Stack::ardupilot_copter], (std::set{2, 3, 4, 13, 14, 15, 29, 35}));
  EXPECT_EQ(airframes[Stack::ardupilot_plane], (std::set{1, 19, 20, 21, 22, 23, 24, 25}));
  constexpr std::uint8_t quadrotor = 2, rover = 10;
  EXPECT_EQ(stack_of(px4_autopilot, quadrotor), Stack::px4);
  EXPECT_EQ(stack_of(px4_autopilot, rover), Stack::px4);
  EXPECT_EQ(stack_of(generic, quadrotor), Stack::unknown);
  EXPECT_EQ(stack_of(invalid, quadrotor), Stack::unknown);
}

}  // namespace
}  // namespace ponte::autopilot
