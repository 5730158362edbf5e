#include "ponte/autopilot/command.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

constexpr Command place{.number = messages::MAV_CMD_DO_REPOSITION,
                        .x = -30.0689801,
                        .y = -51.1217902,
                        .z = 40,
                        .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Command, OfAPlaceGoesAsCommandIntToTheCentimetre) {
  EXPECT_EQ(carrier_for(place), Carrier::command_int);
  const auto message = to_command_int(place);
  EXPECT_EQ(message.x, -300'689'801);
  EXPECT_EQ(message.y, -511'217'902);
  EXPECT_EQ(message.frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT);
}

TEST(Command, OfNumbersGoesAsCommandLong) {
  EXPECT_EQ(carrier_for({.number = 400, .param1 = 1}), Carrier::command_long);
  const auto message = to_command_long({.number = 1000, .param1 = 1, .param4 = nan, .x = 12.5, .y = 3, .z = 7});
  EXPECT_EQ(message.param5, 12.5F);
  EXPECT_EQ(message.param7, 7);
  EXPECT_TRUE(std::isnan(message.param4));
}

TEST(Command, OfAPlaceThatIsLeftOpenGoesAsCommandLong) {
  auto open = place;
  open.x = open.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(carrier_for(open), Carrier::command_long);
}

TEST(Command, IsRecastOnlyWithWhatItMeans) {
  const auto above_sea = recast(place, Carrier::command_long, Metres{50});
  ASSERT_TRUE(above_sea);
  EXPECT_EQ(above_sea->z, 90) << "COMMAND_LONG has no frame, so it is above mean sea level";
  EXPECT_FALSE(recast(place, Carrier::command_long, std::nullopt)) << "the altitude of home is not known";
  EXPECT_TRUE(recast({.number = 400, .param1 = 1}, Carrier::command_int, std::nullopt));
  EXPECT_FALSE(recast({.number = 1000, .x = 12.5}, Carrier::command_int, std::nullopt)) << "not a whole number";
  EXPECT_FALSE(recast({.number = 22, .x = std::nan("")}, Carrier::command_int, std::nullopt));
}

TEST(Command, IsReframedBetweenHomeAndSea) {
  const auto above_sea = reframed(place, Metres{50});
  ASSERT_TRUE(above_sea);
  EXPECT_EQ(above_sea->z, 90);
  EXPECT_EQ(above_sea->frame, messages::MAV_FRAME_GLOBAL);
  EXPECT_EQ(reframed(*above_sea, Metres{50}), place);
  EXPECT_FALSE(reframed(place, std::nullopt));
  auto terrain = place;
  terrain.frame = messages::MAV_FRAME_GLOBAL_TERRAIN_ALT;
  EXPECT_FALSE(reframed(terrain, Metres{50}));
}

TEST(Command, IsRepeatedOnlyWhereTwiceIsOnce) {
  using enum Stack;
  EXPECT_TRUE(may_be_repeated({.number = messages::MAV_CMD_COMPONENT_ARM_DISARM, .param1 = 1}, px4));
  EXPECT_FALSE(may_be_repeated({.number = messages::MAV_CMD_COMPONENT_ARM_DISARM, .param1 = 1, .param2 = 21196}, px4));
  EXPECT_TRUE(may_be_repeated({.number = messages::MAV_CMD_CONDITION_YAW, .param1 = 90}, ardupilot_copter));
  EXPECT_FALSE(
      may_be_repeated({.number = messages::MAV_CMD_CONDITION_YAW, .param1 = 90, .param4 = 1}, ardupilot_copter));
  EXPECT_TRUE(may_be_repeated({.number = messages::MAV_CMD_MISSION_START}, ardupilot_copter));
  EXPECT_FALSE(may_be_repeated({.number = messages::MAV_CMD_MISSION_START}, px4))
      << "it begins at the first item again";
  EXPECT_FALSE(may_be_repeated({.number = messages::MAV_CMD_DO_REPEAT_RELAY}, px4));
  EXPECT_FALSE(may_be_repeated({.number = messages::MAV_CMD_IMAGE_START_CAPTURE}, px4));
  EXPECT_FALSE(may_be_repeated({.number = 42424}, px4)) << "nobody knows";
}

}  // namespace
}  // namespace ponte::autopilot
