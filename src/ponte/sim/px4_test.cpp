#include "ponte/mavlink/autopilots/command_cancel.hpp"
#include "ponte/mavlink/autopilots/command_int.hpp"
#include "ponte/mavlink/autopilots/current_mode.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/ping.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/sim/telemetry_messages.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

/// Where PX4 is unlike ArduPilot.
namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::SizeIs;

constexpr auto accepted = unsigned{messages::MAV_RESULT_ACCEPTED};
constexpr auto denied = unsigned{messages::MAV_RESULT_DENIED};
constexpr auto rejected = unsigned{messages::MAV_RESULT_TEMPORARILY_REJECTED};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class Px4Test : public ::testing::Test {
 protected:
  Px4Test() {
    station_.wait(seconds{9});
    station_.forget();
  }

  unsigned set_mode(float main, float sub) { return station_.command(messages::MAV_CMD_DO_SET_MODE, {1, main, sub}); }
  messages::Heartbeat heartbeat() {
    station_.wait(seconds{1});
    return station_.last<messages::Heartbeat>();
  }

  TestStation station_{{.personality = Personality::px4, .fly_square = false}};
};

TEST_F(Px4Test, SendsAllByItselfAndIgnoresRequestsForStreams) {
  station_.send(messages::RequestDataStream{.target_system = 1, .req_message_rate = 1, .start_stop = 0});
  station_.wait(seconds{10});
  std::map<std::string_view, int> counts;
  for (const auto& frame : station_.frames())
    ++counts[messages::dialect.find(mavlink::parse_frame(frame.bytes())->message)->name];
  EXPECT_EQ(counts["ATTITUDE"], 500);
  EXPECT_EQ(counts["SERVO_OUTPUT_RAW"], 500);
  EXPECT_EQ(counts["GPS_RAW_INT"], 50);
  EXPECT_EQ(counts["VFR_HUD"], 40);
  EXPECT_EQ(counts["HEARTBEAT"], 10);
  EXPECT_EQ(counts["BATTERY_STATUS"], 5);
  EXPECT_EQ(counts["PING"], 1);
  EXPECT_EQ(counts["TIMESYNC"], 0);
}

TEST_F(Px4Test, RefusesToArmBeforeItIsWell) {
  TestStation early{{.personality = Personality::px4}};
  early.wait(seconds{2});
  EXPECT_EQ(early.last<messages::Heartbeat>().system_status, messages::MAV_STATE_UNINIT);
  EXPECT_EQ(early.arm(), rejected);
  EXPECT_THAT(early.texts(), Contains("Arming denied: Resolve system health failures firs"));
  EXPECT_THAT(early.texts(), Contains("t\t"));
  const auto pieces = early.all<messages::Statustext>();
  ASSERT_GE(pieces.size(), 2U);
  EXPECT_EQ(pieces[pieces.size() - 2].id, pieces.back().id);
  EXPECT_EQ(pieces.back().chunk_seq, 1);
}

TEST_F(Px4Test, TellsItsStateFromDisarmedToArmed) {
  EXPECT_EQ(heartbeat().custom_mode, 0x0304'0000U);
  EXPECT_EQ(heartbeat().base_mode, 29);
  EXPECT_EQ(heartbeat().system_status, messages::MAV_STATE_STANDBY);
  ASSERT_EQ(station_.arm(), accepted);
  EXPECT_EQ(heartbeat().base_mode, 157);
  EXPECT_EQ(heartbeat().system_status, messages::MAV_STATE_ACTIVE) << "on the ground, too";
}

TEST_F(Px4Test, HasMainAndSubModes) {
  ASSERT_EQ(set_mode(4, 6), accepted);
  EXPECT_EQ(heartbeat().custom_mode, 0x0604'0000U);
  station_.wait(seconds{2});
  EXPECT_EQ(station_.last<messages::CurrentMode>().custom_mode, 0x0604'0000U);
  EXPECT_EQ(set_mode(4, 4), rejected) << "there is no mission";
  EXPECT_EQ(set_mode(4, 99), rejected);
  EXPECT_EQ(set_mode(77, 0), rejected);
  EXPECT_EQ(station_.command(messages::MAV_CMD_DO_SET_MODE, {0, 4, 4}), denied);
}

TEST_F(Px4Test, TakesOffToItsOwnHeightAndThenHolds) {
  EXPECT_EQ(station_.take_off(nan), rejected) << "not armed";
  ASSERT_EQ(station_.arm(), accepted);
  ASSERT_EQ(station_.take_off(nan), accepted);
  EXPECT_EQ(heartbeat().custom_mode, 0x0204'0000U);
  station_.wait(seconds{10});
  EXPECT_NEAR(-station_.place().down, 2.5, 0.5);
  EXPECT_EQ(heartbeat().custom_mode, 0x0304'0000U);
}

TEST_F(Px4Test, KnowsItsPositionSoonAfterItsStart) {
  TestStation station{{.personality = Personality::px4}};
  station.wait(milliseconds{3400});
  EXPECT_EQ(station.arm(), rejected);
  station.wait(milliseconds{200});
  EXPECT_EQ(station.arm(), accepted);
}

TEST(MissionItemReachedOfPx4, IsToldForTenSeconds) {
  Snapshot snapshot{.since_boot = seconds{30}};
  EXPECT_FALSE(mission_item_reached_px4(snapshot));
  snapshot.reached = {.item = 3, .at = seconds{20}};
  EXPECT_EQ(mission_item_reached_px4(snapshot)->seq, 3);
  snapshot.since_boot += Airframe::step_length;
  EXPECT_FALSE(mission_item_reached_px4(snapshot));
  EXPECT_EQ(mission_item_reached(snapshot)->seq, 3) << "when it is asked for";
}

TEST_F(Px4Test, LooksAtTheComponentThatACommandIsFor) {
  station_.send(messages::CommandLong{
      .target_system = 1, .target_component = 99, .command = messages::MAV_CMD_COMPONENT_ARM_DISARM, .param1 = 1});
  EXPECT_FALSE(station_.truth().armed);
}

TEST_F(Px4Test, AnswersAPing) {
  station_.send(messages::Ping{.time_usec = 123, .seq = 7});
  const auto answer = station_.last<messages::Ping>();
  EXPECT_EQ(answer.time_usec, 123U);
  EXPECT_EQ(answer.seq, 7U);
  EXPECT_EQ(answer.target_system, 255);
}

TEST_F(Px4Test, CalibratesForAWhile) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_PREFLIGHT_CALIBRATION, {1}), unsigned{messages::MAV_RESULT_IN_PROGRESS});
  EXPECT_EQ(station_.command(messages::MAV_CMD_PREFLIGHT_CALIBRATION, {1}), rejected) << "one at a time";
  station_.forget();
  station_.wait(seconds{3});
  ASSERT_THAT(station_.all<messages::CommandAck>(), SizeIs(1));
  EXPECT_EQ(station_.last<messages::CommandAck>().result, accepted);
}

TEST_F(Px4Test, CancelsWhatRuns) {
  station_.command(messages::MAV_CMD_PREFLIGHT_CALIBRATION, {1});
  station_.forget();
  station_.send(messages::CommandCancel{
      .target_system = 1, .target_component = 1, .command = messages::MAV_CMD_PREFLIGHT_CALIBRATION});
  EXPECT_EQ(station_.last<messages::CommandAck>().result, messages::MAV_RESULT_CANCELLED);
  station_.wait(seconds{3});
  EXPECT_THAT(station_.all<messages::CommandAck>(), SizeIs(1));
}

TEST_F(Px4Test, StartsAMissionOnlyIfThereIsOne) {
  EXPECT_EQ(station_.command(messages::MAV_CMD_MISSION_START), denied);
  EXPECT_EQ(station_.command(messages::MAV_CMD_MISSION_START, {nan}), denied);
}

TEST_F(Px4Test, IsRepositionedByEitherCommand) {
  station_.arm();
  station_.take_off(60);  // above the sea: 10 m above home
  station_.wait(seconds{15});
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_REPOSITION, {-1, 1, 0, nan, -30.0680F, -51.12179F, 65}), accepted);
  station_.wait(seconds{60});
  EXPECT_GT(station_.place().north, 80);
  EXPECT_NEAR(-station_.place().down, 15, 1);
  station_.send(messages::CommandInt{.target_system = 1,
                                     .target_component = 1,
                                     .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
                                     .command = messages::MAV_CMD_DO_REPOSITION,
                                     .param1 = -1,
                                     .param2 = 1,
                                     .param4 = nan,
                                     .x = -300'689'800,
                                     .y = -511'217'900,
                                     .z = 20});
  EXPECT_EQ(station_.last<messages::CommandAck>().result, accepted);
  station_.wait(seconds{60});
  EXPECT_NEAR(station_.place().north, 0, 1);
  EXPECT_NEAR(-station_.place().down, 20, 1);
}

TEST_F(Px4Test, FliesRoundAPlace) {
  station_.arm();
  station_.take_off(70);
  station_.wait(seconds{20});
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_ORBIT, {30, 5, 0, nan, -30.06898F, -51.12179F, 70}), accepted);
  EXPECT_EQ(heartbeat().custom_mode, 0x0103'0000U) << "POSCTL.ORBIT";
  station_.wait(seconds{40});
  for (int i = 0; i < 8; ++i, station_.wait(seconds{5}))
    EXPECT_NEAR(std::hypot(station_.place().north, station_.place().east), 30, 2) << i;
  EXPECT_NEAR(-station_.place().down, 20, 1);
}

}  // namespace
}  // namespace ponte::sim
