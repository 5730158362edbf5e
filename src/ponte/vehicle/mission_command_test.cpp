#include "ponte/vehicle/mission_command.hpp"

#include "ponte/core/random.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::vehicle {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Place zurich{radians_from_degrees(47.397742), radians_from_degrees(8.545594)};
constexpr Altitude forty_metres_above_home{Metres{40}, AltitudeFrame::home};

TEST(Interpret, AWaypointWithEveryParameter) {
  const WaypointItem expected{.place = zurich,
                              .altitude = forty_metres_above_home,
                              .dwell = Seconds{2.5},
                              .acceptance_radius = Metres{3},
                              .pass_radius = Metres{-20},
                              .yaw = radians_from_degrees(270)};
  const MissionCommand command{16, 3, {2.5, 3, -20, 270, 47.397742, 8.545594, 40}};
  EXPECT_EQ(interpret(command), Action{expected});
  EXPECT_EQ(express(expected), command);
}

TEST(Interpret, ZeroZeroIsNoPlace) {
  const TakeOffItem expected{.place = {}, .altitude = forty_metres_above_home, .yaw = Radians{}};
  EXPECT_EQ(interpret({22, 3, {0, 0, 0, 0, 0, 0, 40}}), Action{expected});
  EXPECT_TRUE(std::isnan(express(expected).parameters[4]));
}

TEST(Interpret, AnAbsentYawIsNotNorth) {
  const auto own_choice = interpret({16, 3, {0, 0, 0, nan, 47.397742, 8.545594, 40}});
  EXPECT_EQ(std::get<WaypointItem>(own_choice).yaw, std::nullopt);
  const auto north = interpret({16, 3, {0, 0, 0, 0, 47.397742, 8.545594, 40}});
  EXPECT_EQ(std::get<WaypointItem>(north).yaw, Radians{0});
}

TEST(Interpret, TheFramesOfIntegerMessagesMeanTheSame) {
  for (const auto& [integer, plain] : {std::pair{5, 0}, {6, 3}, {11, 10}})
    EXPECT_EQ(interpret({16, static_cast<std::uint8_t>(integer), {0, 0, 0, 0, 1, 2, 3}}),
              interpret({16, static_cast<std::uint8_t>(plain), {0, 0, 0, 0, 1, 2, 3}}));
}

TEST(Interpret, WhatAnItemCannotSayStaysAsItCame) {
  const MissionCommand commands[]{
      {16, 3, {-1, 0, 0, 0, 47, 8, 40}},
      {82, 3, {0, 0, 0, 0, 47, 8, 40}},      // a spline waypoint
      {16, 1, {0, 0, 0, 0, 100, 200, -40}},  // local coordinates
      {16, 3, {0, 0, 0, 0, 47, 8, nan}},     // a waypoint without an altitude
      {16, 3, {0, 0, 0, 0, 0, 0, 40}},       // a waypoint where the vehicle is
      {16, 3, {0, 0, 0, 0, 147, 8, 40}},     // beyond the pole
      {16, 3, {std::numeric_limits<double>::infinity(), 0, 0, 0, 47, 8, 40}},
      {22, 3, {0, 7, 0, 0, 47, 8, 40}},   // take-off with a flag
      {18, 3, {2, 1, 0, 0, 47, 8, 40}},   // heading required
      {178, 2, {0, -2, -1, 0, 0, 0, 0}},  // default speed
      {178, 2, {9, 5, -1, 0, 0, 0, 0}},
      {177, 2, {-1, 2, 0, 0, 0, 0, 0}},
      {177, 2, {2.5, 2, 0, 0, 0, 0, 0}},
      {93, 2, {0, 12, 30, 0, 0, 0, 0}},  // until half past twelve
      {2000, 2, {0, 1, -4, 0, 0, 0, 0}},
      {31000, 3, {1, 2, 3, 4, 5, 6, 7}},
  };
  for (const auto& command : commands) {
    EXPECT_EQ(interpret(command), Action{command}) << command.command;
    EXPECT_EQ(express(interpret(command)), command) << command.command;
  }
}

TEST(Interpret, KnowsTheItemsWithoutAPlace) {
  EXPECT_EQ(interpret({20, 3, {}}), Action{ReturnItem{}});
  EXPECT_EQ(interpret({20, 2, {nan, nan, nan, nan, nan, nan, nan}}), Action{ReturnItem{}});
  EXPECT_EQ(interpret({178, 2, {1, 5, -1}}), (Action{SpeedItem{SpeedKind::ground, MetresPerSecond{5}, {}}}));
  EXPECT_EQ(interpret({178, 2, {0, 5, 60}}), (Action{SpeedItem{SpeedKind::air, MetresPerSecond{5}, Percent{60}}}));
  EXPECT_EQ(interpret({177, 2, {3, -1}}), (Action{JumpItem{3, {}}}));
  EXPECT_EQ(interpret({177, 2, {3, 2}}), (Action{JumpItem{3, 2}}));
  EXPECT_EQ(interpret({93, 2, {30, -1, -1, -1}}), Action{DelayItem{Seconds{30}}});
  EXPECT_EQ(interpret({206, 2, {25, 0, 1}}), (Action{CameraDistanceItem{Metres{25}, true}}));
  EXPECT_EQ(interpret({2000, 2, {0, 2, 10}}), (Action{TakePicturesItem{Seconds{2}, 10}}));
  EXPECT_EQ(interpret({2001, 2, {}}), Action{StopPicturesItem{}});
  EXPECT_EQ(interpret({197, 2, {}}), Action{LookAtItem{}});
  EXPECT_EQ(interpret({205, 2, {-90, 0, 45, 0, 0, 0, 2}}),
            (Action{GimbalItem{radians_from_degrees(-90), {}, radians_from_degrees(45)}}));
}

TEST(HasPlace, OfCommandsOnTheirLimits) {
  constexpr std::uint16_t placed[]{16, 22, 82, 195, 5000, 5004, 31000, 31009};
  constexpr std::uint16_t placeless[]{20, 93, 177, 206, 4999, 5005, 30999, 31010};
  for (const auto command : placed) EXPECT_TRUE(has_place(command)) << command;
  for (const auto command : placeless) EXPECT_FALSE(has_place(command)) << command;
}

TEST(Interpret, LoitersInEachWay) {
  EXPECT_EQ(interpret({17, 3, {0, 0, 50, nan, 47.397742, 8.545594, 40}}),
            (Action{LoiterItem{zurich, forty_metres_above_home, Unlimited{}, Metres{50}, {}}}));
  EXPECT_EQ(interpret({18, 3, {3, 0, -50, 0, 47.397742, 8.545594, 40}}),
            (Action{LoiterItem{zurich, forty_metres_above_home, Turns{3}, Metres{-50}, {}}}));
  EXPECT_EQ(interpret({19, 3, {60, 0, 0, 0, 47.397742, 8.545594, 40}}),
            (Action{LoiterItem{zurich, forty_metres_above_home, Seconds{60}, Metres{0}, {}}}));
}

/// Half of the time a number that commands treat as special.
double telling_number(Random& random) {
  constexpr double special[]{0, 1, -1, 2, 3, 47.5, 180, -90, nan, 65535, 1e9};
  if (random.chance(0.8)) return special[random.below(std::size(special))];
  return static_cast<double>(random.below(2'000'000)) / 1e4 - 100;
}

TEST(InterpretSeeded, LosesNothingOfAnyCommand) {
  constexpr std::uint16_t commands[]{16,  17,  18,  19,  20,  21,  22,  82,   93,  112,
                                     177, 178, 195, 197, 201, 205, 206, 2000, 2001};
  const auto seed = chosen_seed();
  SCOPED_TRACE(testing::Message() << "PONTE_SEED=" << seed);
  Random random{seed};
  for (int i = 0; i < 50'000; ++i) {
    MissionCommand command{
        commands[random.below(std::size(commands))], static_cast<std::uint8_t>(random.below(12)), {}};
    for (auto& parameter : command.parameters) parameter = telling_number(random);
    const auto action = interpret(command);
    const auto written = express(action);
    // The same meaning again, and, but for what 0 and NaN both leave to the vehicle, the same numbers.
    ASSERT_EQ(interpret(written), action) << command.command;
    for (std::size_t p = 0; p < command.parameters.size(); ++p) {
      const double came = command.parameters[p];
      const bool both_nothing = !(std::abs(came) > 0) && !(std::abs(written.parameters[p]) > 0);
      ASSERT_TRUE(written.parameters[p] == came || both_nothing) << command.command << " parameter " << p + 1;
    }
  }
}

}  // namespace
}  // namespace ponte::vehicle
