#include "ponte/sim/telemetry.hpp"

#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/sim/telemetry_messages.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace ponte::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

using Counts = std::map<std::string, int>;

Counts counts(const TestStation& station) {
  Counts result;
  for (const auto& frame : station.frames())
    ++result[std::string{messages::dialect.find(mavlink::parse_frame(frame.bytes())->message)->name}];
  return result;
}

void request(TestStation& station, std::uint8_t stream, std::uint16_t rate, std::uint8_t system = 1) {
  station.send(messages::RequestDataStream{
      .target_system = system, .req_stream_id = stream, .req_message_rate = rate, .start_stop = 1});
}

/// What arrives in ten seconds in the air, after asking for a stream.
Counts stream(std::uint8_t number) {
  TestStation station{{}};
  station.wait(seconds{9});
  station.arm();
  station.wait(milliseconds{12500});
  request(station, number, 4);
  station.forget();
  station.wait(seconds{10});
  auto result = counts(station);
  EXPECT_EQ(result["HEARTBEAT"], 10);
  EXPECT_EQ(result["TIMESYNC"], 1);
  result.erase("HEARTBEAT");
  result.erase("TIMESYNC");
  for (const auto& [name, count] : result) EXPECT_EQ(count, 40) << name;
  return result;
}

std::set<std::string> names(const Counts& counts) {
  std::set<std::string> result;
  for (const auto& [name, count] : counts) result.insert(name);
  return result;
}

TEST(Telemetry, SendsOnlyHeartbeatAndTimesyncUnasked) {
  TestStation station{{}};
  station.wait(seconds{10});
  station.forget();
  station.wait(seconds{60});
  EXPECT_THAT(counts(station), ElementsAre(Pair("HEARTBEAT", 60), Pair("TIMESYNC", 6)));
}

TEST(Telemetry, SendsTheMessagesOfEachStream) {
  EXPECT_THAT(names(stream(1)), ElementsAre("RAW_IMU", "SCALED_PRESSURE"));
  EXPECT_THAT(names(stream(2)),
              UnorderedElementsAre("SYS_STATUS", "POWER_STATUS", "MEMINFO", "MISSION_CURRENT", "GPS_RAW_INT",
                                   "NAV_CONTROLLER_OUTPUT", "POSITION_TARGET_GLOBAL_INT"));
  EXPECT_THAT(names(stream(3)), ElementsAre("RC_CHANNELS", "SERVO_OUTPUT_RAW"));
  EXPECT_THAT(names(stream(6)), ElementsAre("GLOBAL_POSITION_INT", "LOCAL_POSITION_NED"));
  EXPECT_THAT(names(stream(10)), ElementsAre("ATTITUDE"));
  EXPECT_THAT(names(stream(11)), ElementsAre("VFR_HUD"));
  EXPECT_THAT(names(stream(12)),
              ElementsAre("AHRS", "BATTERY_STATUS", "EKF_STATUS_REPORT", "SYSTEM_TIME", "VIBRATION", "WIND"));
  EXPECT_THAT(names(stream(0)), SizeIs(21));
  EXPECT_THAT(names(stream(4)), IsEmpty());
}

TEST(Telemetry, StopsAStream) {
  TestStation station{{}};
  request(station, 0, 10);
  station.wait(seconds{5});
  station.send(messages::RequestDataStream{.target_system = 1, .req_message_rate = 10, .start_stop = 0});
  station.forget();
  station.wait(seconds{2});
  EXPECT_THAT(counts(station), ElementsAre(Pair("HEARTBEAT", 2)));
}

TEST(Telemetry, IgnoresRequestsToAnotherSystem) {
  TestStation station{{}};
  request(station, 0, 10, 2);
  station.wait(seconds{2});
  EXPECT_THAT(counts(station), ElementsAre(Pair("HEARTBEAT", 2)));
}

TEST(Telemetry, SendsOneMessageAtItsOwnInterval) {
  TestStation station{{}};
  station.wait(seconds{10});
  request(station, 0, 4);
  ASSERT_EQ(station.set_interval(messages::Attitude::info.id, 100'000), 0U);
  ASSERT_EQ(station.set_interval(messages::GlobalPositionInt::info.id, -1), 0U);
  ASSERT_EQ(station.set_interval(messages::ExtendedSysState::info.id, 1'000'000), 0U);
  station.forget();
  station.wait(seconds{10});
  auto received = counts(station);
  EXPECT_EQ(received["ATTITUDE"], 100);
  EXPECT_EQ(received["GLOBAL_POSITION_INT"], 0);
  EXPECT_EQ(received["EXTENDED_SYS_STATE"], 10);
  EXPECT_EQ(received["VFR_HUD"], 40);
  ASSERT_EQ(station.set_interval(messages::Attitude::info.id, 0), 0U) << "back to its stream";
  station.forget();
  station.wait(seconds{10});
  EXPECT_THAT(station.all<messages::Attitude>(), SizeIs(40));
}

TEST(Telemetry, WaitsForAPositionWithSomeMessages) {
  TestStation station{{}};
  request(station, 0, 4);
  station.wait(seconds{7});
  EXPECT_THAT(names(counts(station)),
              UnorderedElementsAre("AHRS", "ATTITUDE", "BATTERY_STATUS", "EKF_STATUS_REPORT", "MEMINFO", "POWER_STATUS",
                                   "VIBRATION", "GLOBAL_POSITION_INT", "GPS_RAW_INT", "HEARTBEAT", "MISSION_CURRENT",
                                   "NAV_CONTROLLER_OUTPUT", "RAW_IMU", "RC_CHANNELS", "SCALED_PRESSURE",
                                   "SERVO_OUTPUT_RAW", "STATUSTEXT", "SYSTEM_TIME", "SYS_STATUS", "VFR_HUD"));
}

TEST(Telemetry, TellsWhenItCouldBeArmed) {
  TestStation station{{}};
  request(station, 2, 1);
  station.wait(seconds{7});
  constexpr std::uint32_t prearm_check = messages::MAV_SYS_STATUS_PREARM_CHECK;
  EXPECT_EQ(station.last<messages::SysStatus>().onboard_control_sensors_present & prearm_check, prearm_check);
  EXPECT_EQ(station.last<messages::SysStatus>().onboard_control_sensors_health & prearm_check, 0U);
  station.wait(seconds{3});
  EXPECT_EQ(station.last<messages::SysStatus>().onboard_control_sensors_health & prearm_check, prearm_check);
}

TEST(Scaled, RoundsToTheNearestAndStaysWithinTheType) {
  EXPECT_EQ(scaled<std::int16_t>(1.26, 10), 13);
  EXPECT_EQ(scaled<std::int16_t>(-1.26, 10), -13);
  EXPECT_EQ(scaled<std::int16_t>(1e9, 10), 32767);
  EXPECT_EQ(scaled<std::uint8_t>(-1, 10), 0);
}

TEST(CompassDegrees, GoFromNorthByEast) {
  EXPECT_EQ(compass_degrees(0), 0);
  EXPECT_NEAR(compass_degrees(-std::numbers::pi / 2), 270, 1e-9);
}

}  // namespace
}  // namespace ponte::sim
