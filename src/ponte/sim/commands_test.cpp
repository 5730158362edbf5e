#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/ping.hpp"
#include "ponte/mavlink/autopilots/set_mode.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr auto accepted = unsigned{messages::MAV_RESULT_ACCEPTED};
constexpr auto denied = unsigned{messages::MAV_RESULT_DENIED};
constexpr auto unsupported = unsigned{messages::MAV_RESULT_UNSUPPORTED};
constexpr auto failed = unsigned{messages::MAV_RESULT_FAILED};
constexpr unsigned no_answer = 255;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A vehicle that has its position and waits to be told what to do.
class CommandsTest : public ::testing::Test {
 protected:
  CommandsTest() { station_.wait(seconds{9}); }

  void take_off() {
    station_.set_mode(FlightMode::guided);
    station_.arm();
    station_.take_off(10);
    station_.wait(seconds{20});
  }

  std::uint32_t mode() {
    station_.wait(seconds{1});
    return station_.last<messages::Heartbeat>().custom_mode;
  }

  TestStation station_{{.fly_square = false}};
};

TEST_F(CommandsTest, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(station_.command(999), unsupported);
  EXPECT_EQ(station_.command(0), unsupported);
}

TEST_F(CommandsTest, IgnoresCommandsToAnotherSystem) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {1}, 9), no_answer);
  EXPECT_FALSE(station_.truth().armed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {1}, 0), accepted) << "to all";
}

TEST_F(CommandsTest, IgnoresItsOwnFramesWhenTheyComeBack) {
  station_.speak_as(mavlink::SystemId{1}, mavlink::ComponentId{1});
  EXPECT_EQ(station_.arm(), no_answer);
  station_.speak_as(mavlink::SystemId{1}, mavlink::ComponentId{191});
  EXPECT_EQ(station_.arm(), accepted) << "a companion computer on board";
}

TEST_F(CommandsTest, ArmsAndDisarmsMoreThanOnce) {
  EXPECT_EQ(station_.arm(), accepted);
  EXPECT_EQ(station_.arm(), accepted);
  EXPECT_TRUE(station_.truth().armed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {0}), accepted);
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {0}), accepted);
  EXPECT_FALSE(station_.truth().armed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {2}), unsupported);
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {nan}), unsupported);
}

TEST_F(CommandsTest, ArmsInNoModeThatFliesByItself) {
  for (const auto mode : {FlightMode::automatic, FlightMode::rtl, FlightMode::land}) {
    ASSERT_EQ(station_.set_mode(mode), accepted);
    EXPECT_EQ(station_.arm(), failed);
  }
  EXPECT_THAT(station_.texts(), Contains("Arm: RTL mode not armable"));
}

TEST_F(CommandsTest, DoesNotDisarmInTheAir) {
  take_off();
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {0}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {0, 21196}), failed) << "not by force either";
  EXPECT_TRUE(station_.truth().airborne);
}

TEST_F(CommandsTest, NeverSkipsAnArmingCheck) {
  TestStation early{{}};
  early.wait(seconds{3});
  EXPECT_EQ(early.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {1, 21196}), failed);
}

TEST_F(CommandsTest, TakesOffInGuidedArmedAndFromTheGroundOnly) {
  EXPECT_EQ(station_.take_off(10), failed) << "not GUIDED";
  station_.set_mode(FlightMode::guided);
  EXPECT_EQ(station_.take_off(10), failed) << "not armed";
  station_.arm();
  EXPECT_EQ(station_.take_off(nan), denied);
  EXPECT_EQ(station_.take_off(-3), failed);
  EXPECT_EQ(station_.take_off(1e30F), failed);
  EXPECT_EQ(station_.take_off(10), accepted);
  station_.wait(seconds{5});
  EXPECT_EQ(station_.take_off(20), failed) << "in the air";
}

TEST_F(CommandsTest, StaysOnTheGroundWhenTheTakeOffIsCalledOff) {
  station_.set_mode(FlightMode::guided);
  station_.arm();
  ASSERT_EQ(station_.take_off(10), accepted);
  ASSERT_EQ(station_.set_mode(FlightMode::land), accepted);
  station_.wait(seconds{5});
  EXPECT_FALSE(station_.truth().airborne);

  station_.set_mode(FlightMode::guided);
  station_.arm();
  ASSERT_EQ(station_.take_off(10), accepted);
  ASSERT_EQ(station_.command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {0}), accepted);
  ASSERT_EQ(station_.arm(), accepted);
  station_.wait(seconds{5});
  EXPECT_FALSE(station_.truth().airborne);
}

TEST_F(CommandsTest, ChangesModeByCommand) {
  for (const auto mode : {FlightMode::guided, FlightMode::automatic, FlightMode::loiter, FlightMode::rtl,
                          FlightMode::land, FlightMode::stabilize}) {
    EXPECT_EQ(station_.set_mode(mode), accepted);
    EXPECT_EQ(this->mode(), flight_mode_info({}, mode).custom_mode);
  }
  EXPECT_EQ(station_.command(messages::MAV_CMD_NAV_RETURN_TO_LAUNCH), accepted);
  EXPECT_EQ(mode(), 6U);
  EXPECT_EQ(station_.command(messages::MAV_CMD_NAV_LAND), accepted);
  EXPECT_EQ(mode(), 9U);
}

TEST_F(CommandsTest, TellsAnotherModeWithoutDelay) {
  station_.forget();
  EXPECT_EQ(station_.set_mode(FlightMode::guided), accepted);
  EXPECT_EQ(station_.set_mode(FlightMode::guided), accepted);
  ASSERT_EQ(station_.all<messages::Heartbeat>().size(), 1U);
  EXPECT_EQ(station_.last<messages::Heartbeat>().custom_mode, 4U);
}

TEST_F(CommandsTest, PausesNoMissionThatItDoesNotFly) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_PAUSE_CONTINUE, {0}), failed);
  EXPECT_EQ(station_.texts().back(), "Failed to pause");
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_PAUSE_CONTINUE, {1}), failed);
  EXPECT_EQ(station_.texts().back(), "Failed to resume");
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_PAUSE_CONTINUE, {2}), denied);
}

TEST_F(CommandsTest, ChangesModeByTheOldMessage) {
  station_.send(messages::SetMode{.target_system = 1, .base_mode = 1, .custom_mode = 4});
  EXPECT_EQ(station_.last<messages::CommandAck>().command, 11);
  EXPECT_EQ(station_.last<messages::CommandAck>().result, accepted);
  EXPECT_EQ(mode(), 4U);
  station_.send(messages::SetMode{.target_system = 1, .base_mode = 0, .custom_mode = 5});
  EXPECT_EQ(station_.last<messages::CommandAck>().result, denied);
  station_.forget();
  station_.send(messages::SetMode{.target_system = 2, .base_mode = 1, .custom_mode = 5});
  EXPECT_THAT(station_.frames(), IsEmpty());
  EXPECT_EQ(mode(), 4U);
}

TEST_F(CommandsTest, RefusesModesThatItHasNot) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {1, 99}), failed);
  EXPECT_THAT(station_.texts(), Contains("No such mode 99"));
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {1, 4.5F}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {1, -4}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {1, 1e30F}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {1, nan}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {0, 4}), denied);
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {nan, 4}), denied);
  EXPECT_EQ(mode(), 0U);
}

TEST_F(CommandsTest, HasNoMissionToFly) {
  take_off();
  EXPECT_EQ(station_.set_mode(FlightMode::automatic), failed);
  EXPECT_THAT(station_.texts(), Contains("Mode change to AUTO failed: init failed"));
  EXPECT_EQ(mode(), 4U);
}

TEST_F(CommandsTest, SendsAMessageOnRequest) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {148}), accepted);
  EXPECT_EQ(station_.last<messages::AutopilotVersion>().flight_sw_version, 67567616U);
  station_.forget();
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {242}), accepted);
  const auto home = station_.last<messages::HomePosition>();
  EXPECT_EQ(home.altitude, 50'000);
  EXPECT_TRUE(std::isnan(home.q[0]));
  station_.forget();
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {245}), accepted);
  EXPECT_THAT(station_.all<messages::ExtendedSysState>(), SizeIs(1));
  station_.wait(seconds{5});
  EXPECT_THAT(station_.all<messages::ExtendedSysState>(), SizeIs(1)) << "once";
}

TEST_F(CommandsTest, SendsNoMessageThatItDoesNotKnow) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {300}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {nan}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {-1}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {1e9F}), failed);
}

TEST_F(CommandsTest, HasNoHomeBeforeItsPosition) {
  TestStation early{{}};
  early.wait(seconds{3});
  EXPECT_EQ(early.command(messages::MAV_CMD_REQUEST_MESSAGE, {242}), accepted);
  EXPECT_THAT(early.all<messages::HomePosition>(), IsEmpty());
}

TEST_F(CommandsTest, RefusesIntervalsThatItCannotKeep) {
  constexpr auto attitude = messages::Attitude::info.id;
  EXPECT_EQ(station_.set_interval(attitude, 1), denied);
  EXPECT_THAT(station_.texts(), Contains("Requested rate for message ID 30 too fast. Increas"));
  EXPECT_EQ(station_.set_interval(attitude, nan), denied);
  EXPECT_EQ(station_.set_interval(mavlink::MessageId{300}, 1e6F), denied);
  station_.wait(seconds{5});
  EXPECT_THAT(station_.all<messages::Attitude>(), IsEmpty());
  EXPECT_EQ(station_.set_interval(attitude, 1e30F), accepted) << "the longest there is";
  EXPECT_EQ(station_.set_interval(attitude, 20'000), accepted);
}

TEST_F(CommandsTest, RebootsOnTheGroundOnly) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, {0}), unsupported);
  EXPECT_EQ(station_.command(messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, {2}), unsupported);
  take_off();
  EXPECT_EQ(station_.command(messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, {1}), failed);
}

TEST_F(CommandsTest, IsSilentAboutMessagesThatAskForNothing) {
  station_.forget();
  station_.send(messages::Ping{.time_usec = 1, .seq = 1});
  station_.send(messages::Heartbeat{.type = 6, .autopilot = 8, .system_status = 4});
  EXPECT_THAT(station_.frames(), IsEmpty());
}

TEST_F(CommandsTest, TurnsItsNose) {
  take_off();
  const auto heading = [&] { return degrees_from_radians(station_.truth().attitude.heading); };
  EXPECT_EQ(station_.command(messages::MAV_CMD_CONDITION_YAW, {90}), accepted);
  station_.wait(seconds{10});
  EXPECT_NEAR(heading(), 90, 1);
  EXPECT_EQ(station_.command(messages::MAV_CMD_CONDITION_YAW, {30, 0, -1, 1}), accepted) << "to the left";
  station_.wait(seconds{10});
  EXPECT_NEAR(heading(), 60, 1);
  EXPECT_EQ(station_.command(messages::MAV_CMD_CONDITION_YAW, {400}), failed);
  EXPECT_EQ(station_.command(messages::MAV_CMD_CONDITION_YAW, {0, 0, 0, 2}), failed);
}

}  // namespace
}  // namespace ponte::sim
