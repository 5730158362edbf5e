// Wind, faults and failsafes as a station sees them.
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/wind.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr auto accepted = unsigned{messages::MAV_RESULT_ACCEPTED};
constexpr auto failed = unsigned{messages::MAV_RESULT_FAILED};

/// Hovers 25 m above home, in GUIDED, at 40 s.
TestStation hovering(VehicleConfig config) {
  config.fly_square = false;
  TestStation station{config};
  station.send(messages::RequestDataStream{.target_system = 1, .req_message_rate = 5, .start_stop = 1});
  station.wait(seconds{9});
  EXPECT_EQ(station.set_mode(FlightMode::guided), accepted);
  EXPECT_EQ(station.arm(), accepted);
  EXPECT_EQ(station.take_off(25), accepted);
  station.wait(seconds{31});
  EXPECT_NEAR(-station.place().down, 25, 0.3);
  station.forget();
  return station;
}

std::vector<Fault> faults(std::string_view text) { return parse_faults(text).value(); }

unsigned mode(const TestStation& station) { return station.last<messages::Heartbeat>().custom_mode; }
unsigned status(const TestStation& station) { return station.last<messages::Heartbeat>().system_status; }

TEST(World, WindIsTold) {
  auto station = hovering({.wind = {.speed = MetresPerSecond{6}, .from = radians_from_degrees(250)}});
  station.wait(seconds{2});
  EXPECT_NEAR(station.last<messages::Wind>().direction, -110, 0.01);
  EXPECT_NEAR(station.last<messages::Wind>().speed, 6, 0.01);
  EXPECT_LT(horizontal(station.place()), 0.1);
}

TEST(World, ALowBatteryBringsItHome) {
  auto station = hovering({.faults = faults("battery-low@60s"), .parameters = {{"BATT_FS_LOW_ACT", 2}}});
  station.wait(seconds{25});
  EXPECT_EQ(mode(station), 4U);
  EXPECT_EQ(station.last<messages::BatteryStatus>().charge_state, messages::MAV_BATTERY_CHARGE_STATE_OK);
  station.wait(seconds{7});
  EXPECT_EQ(mode(station), 6U) << "RTL, after BATT_LOW_TIMER";
  EXPECT_EQ(status(station), unsigned{messages::MAV_STATE_CRITICAL});
  EXPECT_EQ(station.last<messages::BatteryStatus>().charge_state, messages::MAV_BATTERY_CHARGE_STATE_LOW);
  EXPECT_THAT(station.texts(), Contains("Battery Failsafe"));
  ASSERT_TRUE(station.wait_until([&] { return !station.truth().armed; }, seconds{90}));
  station.wait(seconds{1});
  EXPECT_EQ(status(station), unsigned{messages::MAV_STATE_CRITICAL}) << "still after landing";
  station.set_mode(FlightMode::guided);
  EXPECT_EQ(station.arm(), failed);
}

TEST(World, WithoutSatellitesItBelievesForAWhileAndThenLands) {
  auto station = hovering({.wind = {.speed = MetresPerSecond{3}}, .faults = faults("gps-loss@45s"), .noise = 0});
  station.wait(seconds{12});
  EXPECT_EQ(mode(station), 4U);
  EXPECT_EQ(station.last<messages::GpsRawInt>().fix_type, 1);
  EXPECT_NE(station.last<messages::GpsRawInt>().lat, 0) << "the last that it saw";
  station.wait(seconds{3});
  EXPECT_EQ(mode(station), 9U);
  EXPECT_THAT(station.texts(), Contains("EKF Failsafe: changed to LAND Mode"));
  ASSERT_TRUE(station.wait_until([&] { return !station.truth().armed; }, seconds{90}));
  EXPECT_GT(horizontal(station.place()), 40) << "carried off by the wind";
  const auto told = station.last<messages::GlobalPositionInt>();
  const Position believed{radians_from_degrees(told.lat * 1e-7), radians_from_degrees(told.lon * 1e-7), Metres{50}};
  EXPECT_GT(horizontal(offset_between(believed, station.truth().position)), 10);
}

TEST(World, FindsItsPositionAgainWhenTheSatellitesComeBack) {
  auto station = hovering({.faults = faults("gps-loss@45s+5s"), .noise = 0});
  station.wait(seconds{30});
  EXPECT_EQ(mode(station), 4U);
  EXPECT_EQ(station.last<messages::GpsRawInt>().fix_type, 3);
  EXPECT_LT(horizontal(station.place()), 0.1);
}

TEST(World, ALostStationBringsItHome) {
  auto station = hovering({.parameters = {{"FS_GCS_ENABLE", 1}}});
  const messages::Heartbeat heartbeat{.type = messages::MAV_TYPE_GCS};
  for (int i = 0; i < 10; ++i) {
    station.send(heartbeat);
    station.wait(seconds{1});
  }
  EXPECT_EQ(mode(station), 4U);
  station.wait(seconds{6});
  EXPECT_EQ(mode(station), 6U);
  EXPECT_THAT(station.texts(), Contains("GCS Failsafe"));
}

TEST(World, ALostLinkCarriesNothingEitherWay) {
  auto station = hovering({.faults = faults("link-loss@45s+10s")});
  station.wait(seconds{5});
  station.forget();
  station.wait(seconds{5});
  EXPECT_EQ(station.command(messages::MAV_CMD_NAV_LAND), 255U);
  EXPECT_THAT(station.frames(), IsEmpty());
  station.wait(seconds{6});
  EXPECT_EQ(mode(station), 4U);
  EXPECT_THAT(station.frames(), Not(IsEmpty()));
}

TEST(World, ACopterWithoutAMotorCrashes) {
  auto station = hovering({.faults = faults("motor@45s")});
  ASSERT_TRUE(station.wait_until([&] { return !station.truth().armed; }, seconds{20}));
  EXPECT_TRUE(station.truth().crashed);
  station.wait(seconds{1});
  EXPECT_THAT(station.texts(), Contains("Crash: Disarming"));
}

TEST(World, ARebootInTheAirLeavesItWhereItIs) {
  auto station = hovering({.faults = faults("reboot@45s")});
  const auto before = station.place();
  station.wait(seconds{20});
  EXPECT_THAT(station.texts(), Contains("ArduPilot Ready"));
  EXPECT_EQ(mode(station), 0U);
  EXPECT_LT(horizontal(station.place() - before), 0.1);
  EXPECT_TRUE(station.truth().armed);
  EXPECT_EQ(station.set_mode(FlightMode::rtl), accepted);
  ASSERT_TRUE(station.wait_until([&] { return !station.truth().armed; }, seconds{90}));
  EXPECT_LT(horizontal(station.place()), 1);
}

TEST(World, ARebootOfPx4InTheAirLetsItFall) {
  TestStation station{{.personality = Personality::px4, .faults = faults("reboot@40s"), .fly_square = false}};
  station.wait(seconds{9});
  ASSERT_EQ(station.arm(), accepted);
  ASSERT_EQ(station.take_off(80), accepted) << "to 80 m above the sea";
  station.wait(milliseconds{31'500});
  EXPECT_FALSE(station.truth().armed);
  EXPECT_TRUE(station.truth().airborne);
  EXPECT_NE(station.arm(), accepted) << "on its way down";
  EXPECT_NE(station.command(messages::MAV_CMD_DO_REPOSITION, {-1, 0, 0, 0, -30.07F, -51.12F, 100}), accepted);
  ASSERT_TRUE(station.wait_until([&] { return !station.truth().airborne; }, seconds{10}));
  EXPECT_TRUE(station.truth().crashed);
  station.wait(seconds{10});
  EXPECT_THAT(station.texts(), Contains("Ready for takeoff!\t"));
}

TEST(World, ATakeOffWithoutAMotorIsGivenUp) {
  for (const auto personality : {Personality::ardupilot, Personality::px4}) {
    TestStation station{{.personality = personality, .faults = faults("motor@1s"), .fly_square = false}};
    station.wait(seconds{9});
    if (personality == Personality::ardupilot) {
      ASSERT_EQ(station.set_mode(FlightMode::guided), accepted);
    }
    ASSERT_EQ(station.arm(), accepted);
    ASSERT_EQ(station.take_off(80), accepted);
    station.wait(seconds{9});
    EXPECT_TRUE(station.truth().armed);
    station.wait(milliseconds{1100});
    EXPECT_FALSE(station.truth().armed) << "DISARM_DELAY, COM_DISARM_PRFLT";
    EXPECT_FALSE(station.truth().airborne);
  }
}

TEST(World, IsTheSameForTheSameSeedWithGustsAndFaults) {
  const auto record = [](std::uint64_t seed) {
    auto station = hovering({.wind = {.speed = MetresPerSecond{5}, .gusts = 0.3},
                             .faults = faults("gps-loss@42s+30s,battery-low@50s,reboot@80s"),
                             .seed = seed});
    station.wait(seconds{60});
    std::vector<std::byte> bytes;
    for (const auto& frame : station.frames()) bytes.insert(bytes.end(), frame.bytes().begin(), frame.bytes().end());
    return bytes;
  };
  EXPECT_EQ(record(5), record(5));
  EXPECT_NE(record(5), record(6));
}

TEST(World, HasPlanesToo) {
  VehicleConfig config{.type = AirframeType::plane, .fly_square = false};
  TestStation station{config};
  station.wait(seconds{9});
  EXPECT_EQ(station.command(messages::MAV_CMD_DO_SET_MODE, {1, 13}), accepted) << "TAKEOFF";
  EXPECT_EQ(station.arm(), accepted);
  station.wait(seconds{60});
  EXPECT_NEAR(-station.place().down, 50, 2);
  EXPECT_EQ(station.last<messages::Heartbeat>().type, unsigned{messages::MAV_TYPE_FIXED_WING});
  EXPECT_EQ(station.command(messages::MAV_CMD_NAV_RETURN_TO_LAUNCH), accepted);
  station.wait(seconds{120});
  EXPECT_EQ(mode(station), 11U);
  EXPECT_NEAR(horizontal(station.place()), 60, 4);
}

}  // namespace
}  // namespace ponte::sim
