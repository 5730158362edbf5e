#include "ponte/sim/vehicle.hpp"

#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr auto accepted = unsigned{messages::MAV_RESULT_ACCEPTED};
constexpr auto failed = unsigned{messages::MAV_RESULT_FAILED};

void request_all(TestStation& station, std::uint16_t rate) {
  station.send(messages::RequestDataStream{
      .target_system = 1, .target_component = 1, .req_message_rate = rate, .start_stop = 1});
}

std::vector<int> states(const TestStation& station) {
  std::vector<int> result;
  for (const auto& each : station.all<messages::Heartbeat>()) result.push_back(each.system_status);
  return result;
}

bool is_airborne(const TestStation& station) { return station.truth().airborne; }
bool is_armed(const TestStation& station) { return station.truth().armed; }

TEST(Vehicle, BootsAndThenStandsBy) {
  TestStation station{{}};
  station.wait(seconds{5});
  EXPECT_THAT(states(station), ElementsAre(1, 1, 3, 3, 3));
  EXPECT_THAT(station.texts(), ElementsAre("ArduPilot Ready"));
  const auto heartbeats = station.all<messages::Heartbeat>();
  EXPECT_EQ(heartbeats.front().base_mode, 89);
  EXPECT_EQ(
      heartbeats.back(),
      (messages::Heartbeat{
          .type = 2, .autopilot = 3, .base_mode = 81, .custom_mode = 0, .system_status = 3, .mavlink_version = 3}));
}

TEST(Vehicle, LearnsTheTimeFirstAndItsPositionLater) {
  TestStation station{{}};
  request_all(station, 5);
  station.wait(seconds{10});

  std::vector<int> fixes;
  for (const auto& gps : station.all<messages::GpsRawInt>()) {
    if (fixes.empty() || fixes.back() != gps.fix_type) fixes.push_back(gps.fix_type);
    EXPECT_EQ(gps.lat == 0, gps.fix_type < 2);
    EXPECT_EQ(gps.eph == 65535, gps.fix_type < 2);
  }
  EXPECT_THAT(fixes, ElementsAre(0, 1, 2, 3));

  const VehicleConfig config;
  for (const auto& time : station.all<messages::SystemTime>()) {
    if (time.time_boot_ms < 5000)
      EXPECT_EQ(time.time_unix_usec, 0U);
    else
      EXPECT_EQ(time.time_unix_usec,
                static_cast<std::uint64_t>(unix_us(config.power_on + milliseconds{time.time_boot_ms})));
  }
  for (const auto& position : station.all<messages::GlobalPositionInt>()) {
    EXPECT_EQ(position.lat == 0, position.time_boot_ms < 8000) << position.time_boot_ms;
    EXPECT_EQ(position.lon == 0, position.time_boot_ms < 8000);
  }
  EXPECT_THAT(station.texts(), ElementsAre("ArduPilot Ready", "EKF3 IMU0 origin set", "EKF3 IMU0 is using GPS"));
  EXPECT_EQ(station.last<messages::HomePosition>().latitude, -300689800);
  EXPECT_EQ(station.last<messages::HomePosition>().longitude, -511217900);
}

TEST(Vehicle, RefusesToArmTooEarly) {
  TestStation station{{}};
  station.wait(seconds{2});
  EXPECT_EQ(station.arm(), failed);
  EXPECT_EQ(station.last<messages::Statustext>().severity, 2);
  EXPECT_THAT(station.texts(), ElementsAre("Arm: System not initialised"));
  station.wait(seconds{5});
  EXPECT_EQ(station.arm(), failed);
  EXPECT_THAT(station.texts(), Contains("Arm: Need Position Estimate"));
  EXPECT_FALSE(station.truth().armed);
  station.wait(seconds{2});
  EXPECT_EQ(station.arm(), accepted);
}

TEST(Vehicle, FliesItsSquareRoundAfterRoundAndLands) {
  const VehicleConfig config{};
  TestStation station{config};
  station.wait(seconds{9});
  ASSERT_EQ(station.arm(), accepted);
  station.forget();
  station.wait(seconds{1});
  EXPECT_EQ(station.last<messages::Heartbeat>().base_mode, 217);
  EXPECT_EQ(station.last<messages::Heartbeat>().custom_mode, 4U) << "GUIDED";
  EXPECT_EQ(station.last<messages::Heartbeat>().system_status, 3) << "on the ground, armed or not";

  const double side = config.square.side.value;
  ASSERT_TRUE(station.wait_until([&] { return -station.place().down > config.square.height.value - 1; }, seconds{30}));
  EXPECT_LT(horizontal(station.place()), 0.1) << "straight up";
  constexpr std::array<NorthEastDown, 4> corners{{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}};
  for (int round = 0; round < 2; ++round)
    for (const auto& corner : corners) {
      const auto away = [&] { return horizontal(station.place() - corner * side); };
      ASSERT_TRUE(station.wait_until([&] { return away() < 1; }, seconds{40})) << round << ' ' << corner.north;
      EXPECT_NEAR(-station.place().down, config.square.height.value, 0.5);
      EXPECT_EQ(station.last<messages::Heartbeat>().system_status, 4);
    }

  ASSERT_EQ(station.set_mode(FlightMode::land), accepted);
  station.forget();
  ASSERT_TRUE(station.wait_until([&] { return !is_airborne(station); }, seconds{60}));
  EXPECT_TRUE(is_armed(station));
  ASSERT_TRUE(station.wait_until([&] { return !is_armed(station); }, seconds{2}));
  station.wait(seconds{10});
  EXPECT_THAT(station.texts(), ElementsAre("Disarming motors"));
  EXPECT_EQ(station.last<messages::Heartbeat>().system_status, 3);
  EXPECT_EQ(station.last<messages::Heartbeat>().custom_mode, 9U);
  EXPECT_EQ(station.last<messages::Heartbeat>().base_mode & 128, 0);
  EXPECT_FALSE(is_airborne(station));
  EXPECT_EQ(station.lost(), 0U);
}

TEST(Vehicle, StaysOnTheLinesOfItsSquare) {
  const VehicleConfig config{};
  TestStation station{config};
  station.wait(seconds{9});
  station.arm();
  station.wait(seconds{40});
  const double side = config.square.side.value;
  for (int i = 0; i < 3000; ++i) {
    station.wait(Airframe::step_length);
    const auto place = station.place();
    const double outside = std::max({-place.north, place.north - side, -place.east, place.east - side});
    const double inside = std::min({place.north, side - place.north, place.east, side - place.east});
    EXPECT_LT(outside, 1.5);
    EXPECT_LT(inside, 1.5);
    EXPECT_LT(horizontal(station.truth().velocity), config.square.speed.value * 1.03);
  }
}

TEST(Vehicle, ReturnsHomeAndLandsThere) {
  TestStation station{{}};
  station.wait(seconds{9});
  station.arm();
  ASSERT_TRUE(station.wait_until([&] { return station.place().north > 55; }, seconds{60}));
  ASSERT_EQ(station.set_mode(FlightMode::rtl), accepted);
  ASSERT_TRUE(station.wait_until([&] { return !is_armed(station); }, seconds{90}));
  EXPECT_LT(horizontal(station.place()), 0.3);
  EXPECT_EQ(station.place().down, 0);
  station.wait(seconds{60});
  EXPECT_FALSE(is_armed(station)) << "a new flight needs a new command";
}

TEST(Vehicle, RisesBeforeItReturnsFromLowHeight) {
  TestStation station{{.square = {.height = Metres{5}}}};
  station.wait(seconds{9});
  station.arm();
  ASSERT_TRUE(station.wait_until([&] { return station.place().north > 30; }, seconds{60}));
  station.set_mode(FlightMode::rtl);
  double highest{};
  station.wait_until(
      [&] {
        highest = std::max(highest, -station.place().down);
        return !is_armed(station);
      },
      seconds{90});
  EXPECT_NEAR(highest, 15, 0.3);
  EXPECT_FALSE(is_armed(station));
}

TEST(Vehicle, PausesItsSquareInLoiterAndGoesOnInGuided) {
  TestStation station{{}};
  station.wait(seconds{9});
  station.arm();
  station.wait(seconds{20});
  ASSERT_EQ(station.set_mode(FlightMode::loiter), accepted);
  station.wait(seconds{10});
  const auto place = station.place();
  station.wait(seconds{20});
  EXPECT_LT(horizontal(station.place() - place), 0.1);
  ASSERT_EQ(station.set_mode(FlightMode::guided), accepted);
  station.wait(seconds{5});
  EXPECT_GT(horizontal(station.place() - place), 5);
}

TEST(Vehicle, TakesOffAndHoldsWithoutASquare) {
  TestStation station{{.fly_square = false}};
  station.wait(seconds{9});
  ASSERT_EQ(station.set_mode(FlightMode::guided), accepted);
  ASSERT_EQ(station.arm(), accepted);
  ASSERT_EQ(station.set_interval(messages::ExtendedSysState::info.id, 100'000), accepted);
  station.wait(seconds{5});
  EXPECT_FALSE(is_airborne(station));
  ASSERT_EQ(station.take_off(10), accepted);
  station.wait(seconds{60});
  EXPECT_NEAR(-station.place().down, 10, 0.1);
  EXPECT_LT(horizontal(station.place()), 0.1);
  station.set_mode(FlightMode::land);
  station.wait(seconds{60});

  std::vector<int> seen;
  for (const auto& each : station.all<messages::ExtendedSysState>()) {
    EXPECT_EQ(each.vtol_state, 3);
    if (seen.empty() || seen.back() != each.landed_state) seen.push_back(each.landed_state);
  }
  EXPECT_THAT(seen, ElementsAre(1, 3, 2, 4, 1)) << "ground, take-off, air, landing, ground";
}

TEST(Vehicle, DisarmsWhenNothingHappens) {
  TestStation station{{.fly_square = false}};
  station.wait(seconds{9});
  station.arm();
  station.wait(milliseconds{9900});
  EXPECT_TRUE(is_armed(station));
  station.wait(milliseconds{200});
  EXPECT_FALSE(is_armed(station));
}

TEST(Vehicle, TakesTheHeightOfItsSquareFromATakeOffCommand) {
  TestStation station{{}};
  station.wait(seconds{9});
  station.arm();
  ASSERT_EQ(station.take_off(12), accepted);
  station.wait(seconds{30});
  EXPECT_NEAR(-station.place().down, 12, 0.3);
  EXPECT_GT(horizontal(station.place()), 10);
}

TEST(Vehicle, StartsAnewAfterAReboot) {
  TestStation station{{}};
  request_all(station, 4);
  station.wait(seconds{9});
  station.set_mode(FlightMode::guided);
  ASSERT_EQ(station.command(messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, {1}), accepted);
  station.forget();
  station.wait(milliseconds{380});
  EXPECT_EQ(station.command(messages::MAV_CMD_REQUEST_MESSAGE, {0}), 255U) << "it is off";
  EXPECT_THAT(station.frames(), IsEmpty());

  station.wait(seconds{9});
  EXPECT_THAT(states(station), ElementsAre(1, 1, 3, 3, 3, 3, 3, 3));
  EXPECT_EQ(station.last<messages::Heartbeat>().custom_mode, 0U);
  EXPECT_EQ(mavlink::parse_frame(station.frames().front().bytes())->sequence, 0);
  EXPECT_THAT(station.all<messages::SystemTime>(), IsEmpty()) << "rates are lost";
  EXPECT_THAT(station.texts(), Contains("EKF3 IMU0 is using GPS"));
  ASSERT_EQ(station.command(messages::MAV_CMD_REQUEST_MESSAGE, {2}), accepted);
  const auto time = station.last<messages::SystemTime>();
  EXPECT_EQ(time.time_boot_ms, 8980U);
  const auto since_power_on = station.now() - Timestamp{};
  EXPECT_EQ(time.time_unix_usec,
            static_cast<std::uint64_t>(
                unix_us(VehicleConfig{}.power_on + since_power_on / seconds{1} * seconds{1} + milliseconds{380})));
}

TEST(Vehicle, NumbersItsFramesWithoutGaps) {
  TestStation station{{}};
  request_all(station, 10);
  station.wait(seconds{30});
  std::uint8_t expected{};
  for (const auto& frame : station.frames()) ASSERT_EQ(mavlink::parse_frame(frame.bytes())->sequence, expected++);
}

TEST(Vehicle, SpeaksMavlink1) {
  TestStation station{{.version = mavlink::Version::v1}};
  request_all(station, 4);
  station.wait(seconds{9});
  EXPECT_EQ(station.arm(), accepted) << "asked in MAVLink 2";
  EXPECT_EQ(station.last<messages::CommandAck>().target_system, 0) << "an extension";
  station.send(messages::CommandLong{.target_system = 1, .target_component = 1, .command = 999}, mavlink::Version::v1);
  EXPECT_EQ(station.last<messages::CommandAck>().command, 999);
  station.wait(seconds{60});
  EXPECT_TRUE(is_airborne(station));
}

TEST(Vehicle, AnswersInMavlink2WhatIsAskedInMavlink1) {
  TestStation station{{}};
  station.send(messages::CommandLong{.target_system = 1, .target_component = 1, .command = 999}, mavlink::Version::v1);
  EXPECT_EQ(station.last<messages::CommandAck>(),
            (messages::CommandAck{.command = 999, .result = 3, .target_system = 255, .target_component = 190}));
}

TEST(Vehicle, AnswersAndAsksForTheTime) {
  TestStation station{{.system = mavlink::SystemId{7}}};
  station.wait(seconds{10});
  EXPECT_THAT(station.all<messages::Timesync>(), ElementsAre(messages::Timesync{.tc1 = 0, .ts1 = 10'000'000'007}));
  station.wait(milliseconds{3});
  station.send(messages::Timesync{.tc1 = 0, .ts1 = 42});
  EXPECT_EQ(station.last<messages::Timesync>(), (messages::Timesync{.tc1 = 10'003'000'000, .ts1 = 42}));
  station.send(messages::Timesync{.tc1 = 5, .ts1 = 10'000'000'007});
  EXPECT_THAT(station.all<messages::Timesync>(), SizeIs(2)) << "an answer needs none";
}

std::vector<std::byte> recorded(const VehicleConfig& config) {
  TestStation station{config};
  request_all(station, 10);
  station.wait(seconds{9});
  station.arm();
  station.wait(seconds{60});
  station.set_mode(FlightMode::rtl);
  station.wait(seconds{60});
  std::vector<std::byte> bytes;
  for (const auto& frame : station.frames()) bytes.insert(bytes.end(), frame.bytes().begin(), frame.bytes().end());
  return bytes;
}

TEST(Vehicle, SendsTheSameBytesForTheSameSeed) {
  const auto first = recorded({.seed = 42});
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_EQ(first, recorded({.seed = 42}));
  EXPECT_NE(first, recorded({.seed = 43}));
}

TEST(Vehicle, SendsTheSameHoweverLateItIsCalled) {
  Vehicle often{{}};
  Vehicle seldom{{}};
  Outbox<mavlink::FrameBuffer> frames{1000};
  std::vector<std::byte> expected;
  std::vector<std::byte> late;
  const auto append = [](std::vector<std::byte>& to) {
    return
        [&to](const mavlink::FrameBuffer& frame) { to.insert(to.end(), frame.bytes().begin(), frame.bytes().end()); };
  };
  while (often.next_deadline() <= Timestamp{seconds{20}}) {
    often.on_tick(often.next_deadline(), frames);
    frames.drain(append(expected));
  }
  for (int second = 4; second <= 20; second += 4) {
    seldom.on_tick(Timestamp{seconds{second}}, frames);
    frames.drain(append(late));
  }
  EXPECT_EQ(late, expected);
}

TEST(Vehicle, LetsAnHourGoBy) {
  Vehicle vehicle{{}};
  Outbox<mavlink::FrameBuffer> out{Vehicle::frames_per_step};
  vehicle.on_tick(Timestamp{hours{1}}, out);
  EXPECT_EQ(vehicle.steps(), 180'000U);
  EXPECT_EQ(vehicle.next_deadline(), Timestamp{hours{1} + Airframe::step_length});
}

TEST(Vehicle, StaysOnItsSquareForTheLengthOfABattery) {
  TestStation station{{}};
  station.wait(seconds{9});
  station.arm();
  station.wait(minutes{55});
  EXPECT_TRUE(is_airborne(station));
  EXPECT_LT(std::abs(station.place().north - 30), 32);
  EXPECT_LT(std::abs(station.place().east - 30), 32);
  EXPECT_NEAR(-station.place().down, 20, 0.3);
  EXPECT_LT(station.truth().battery.remaining, 0.3);
  EXPECT_GT(station.truth().battery.remaining, 0);
}

}  // namespace
}  // namespace ponte::sim
