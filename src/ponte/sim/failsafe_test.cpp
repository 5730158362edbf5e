#include "ponte/sim/failsafe.hpp"

#include "ponte/sim/watched_flight.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr VehicleKind ardu_copter{Personality::ardupilot, AirframeType::copter};
constexpr VehicleKind px4_copter{Personality::px4, AirframeType::copter};

/// So small that hovering empties it within the test: 25 s of hovering are about an eighth of an ampere hour.
CopterConfig with_battery(double ampere_hours) {
  CopterConfig config;
  config.battery.capacity_ampere_hours = ampere_hours;
  return config;
}

TEST(Failsafe, DoesNothingByDefaultAboutBatteryAndStation) {
  WatchedFlight it{ardu_copter, with_battery(0.4)};
  it.lose_station();
  it.rig.wait(seconds{60});
  EXPECT_EQ(it.rig.mode(), FlightMode::guided) << "BATT_FS_LOW_ACT and FS_GCS_ENABLE are 0";
  EXPECT_THAT(it.rig.texts, Contains("Battery Failsafe"));
  EXPECT_EQ(it.failsafes().charge_state(), ChargeState::low);
}

TEST(Failsafe, BatteryHasTwoStagesInArduCopter) {
  WatchedFlight it{ardu_copter, with_battery(0.3)};
  it.set("BATT_FS_LOW_ACT", 2);
  it.set("BATT_FS_CRT_ACT", 1);
  it.set("BATT_CRT_VOLT", 10.1);
  it.rig.wait_until([&] { return it.rig.state().battery.volts < 10.5; }, seconds{90});
  it.rig.wait(milliseconds{9900});
  EXPECT_EQ(it.rig.mode(), FlightMode::guided) << "BATT_LOW_TIMER is 10 s";
  EXPECT_FALSE(it.failsafes().is_active());
  it.rig.wait(milliseconds{200});
  EXPECT_EQ(it.rig.mode(), FlightMode::rtl);
  EXPECT_TRUE(it.failsafes().is_active());
  ASSERT_TRUE(it.rig.wait_until([&] { return it.rig.mode() == FlightMode::land; }, seconds{60}));
  EXPECT_EQ(it.failsafes().charge_state(), ChargeState::critical);
  ASSERT_TRUE(it.rig.wait_until([&] { return !it.rig.state().armed; }, seconds{60}));
  EXPECT_TRUE(it.failsafes().is_active()) << "still after landing";
  EXPECT_EQ(it.failsafes().refuses_to_arm(), "Battery 1 critical voltage failsafe");
  ASSERT_EQ(it.rig.texts.size(), 5U);
  EXPECT_THAT(it.rig.texts[0], ::testing::StartsWith("Battery 1 is low 10."));
  EXPECT_THAT(it.rig.texts[0], ::testing::EndsWith(" mAh"));
  EXPECT_EQ(it.rig.texts[1], "Battery Failsafe");
  EXPECT_THAT(it.rig.texts[2], ::testing::StartsWith("Battery 1 is critical 9."));
  EXPECT_EQ(it.rig.texts[3], "Battery Failsafe");
}

TEST(Failsafe, BatteryOfPx4WarnsReturnsAndLands) {
  WatchedFlight it{px4_copter, with_battery(0.18)};
  it.set("COM_LOW_BAT_ACT", 3);
  ASSERT_TRUE(it.rig.wait_until([&] { return it.failsafes().charge_state() == ChargeState::low; }, seconds{60}));
  EXPECT_LT(it.rig.state().battery.remaining, 0.15);
  EXPECT_FALSE(it.failsafes().is_active());
  ASSERT_TRUE(it.rig.wait_until([&] { return it.failsafes().charge_state() == ChargeState::critical; }, seconds{60}));
  EXPECT_TRUE(it.failsafes().is_active());
  EXPECT_EQ(it.rig.mode(), FlightMode::loiter);
  ASSERT_TRUE(it.rig.wait_until([&] { return it.rig.mode() == FlightMode::land; }, seconds{6}))
      << "while it held, the charge fell to that of an emergency";
  EXPECT_THAT(it.rig.texts, ElementsAre("Low battery\t", "Critical battery\t",
                                        "Failsafe activated: entering Hold for 5 seconds\t", "Failsafe activated\t"));
  ASSERT_TRUE(it.rig.wait_until([&] { return !it.rig.state().armed; }, seconds{90}));
  it.rig.wait(milliseconds{40});
  EXPECT_FALSE(it.failsafes().is_active()) << "PX4 shows it only while it is armed";
}

TEST(Failsafe, BatteryOfPx4WarnsOnlyByDefault) {
  WatchedFlight it{px4_copter, with_battery(0.18)};
  it.rig.wait(seconds{30});
  EXPECT_EQ(it.failsafes().charge_state(), ChargeState::emergency);
  EXPECT_EQ(it.rig.mode(), FlightMode::loiter);
  EXPECT_FALSE(it.failsafes().is_active());
}

TEST(Failsafe, StationLossOfArduCopterReturnsAfterFiveSeconds) {
  WatchedFlight it{ardu_copter};
  it.set("FS_GCS_ENABLE", 1);
  it.lose_station();
  it.rig.wait(milliseconds{4900});
  EXPECT_EQ(it.rig.mode(), FlightMode::guided);
  it.rig.wait(milliseconds{200});
  EXPECT_EQ(it.rig.mode(), FlightMode::rtl);
  EXPECT_TRUE(it.failsafes().is_active());
  EXPECT_THAT(it.rig.texts, ElementsAre("GCS Failsafe"));
  it.failsafes().on_station_heartbeat(it.rig.now());
  it.rig.wait(seconds{1});
  EXPECT_THAT(it.rig.texts, ElementsAre("GCS Failsafe", "GCS Failsafe Cleared"));
  EXPECT_EQ(it.rig.mode(), FlightMode::rtl) << "it goes on with what it began";
}

TEST(Failsafe, StationLossOfPx4HoldsThenReturns) {
  WatchedFlight it{px4_copter};
  it.set("NAV_DLL_ACT", 2);
  it.lose_station();
  it.rig.wait(milliseconds{9900});
  EXPECT_FALSE(it.failsafes().is_active());
  it.rig.wait(milliseconds{200});
  EXPECT_TRUE(it.failsafes().is_active());
  EXPECT_EQ(it.rig.mode(), FlightMode::loiter);
  it.rig.wait(seconds{5});
  EXPECT_EQ(it.rig.mode(), FlightMode::rtl);
}

TEST(Failsafe, AStationThatWasNeverHeardIsNotMissed) {
  const Parameters parameters{Personality::ardupilot};
  auto settings = settings_of(ardu_copter, parameters);
  settings.failsafes.station = FailsafeAction::rtl;
  Failsafes failsafes{ardu_copter, settings.failsafes};
  Flight flight{ardu_copter, settings.flight, false, {}};
  Copter copter{{}, field, {}};
  Outbox<FlightFact> facts{8};
  for (int second = 0; second < 60; ++second) failsafes.step(seconds{second}, true, flight, copter, facts);
  EXPECT_FALSE(failsafes.is_active());
  EXPECT_TRUE(facts.empty());
}

TEST(Failsafe, PositionLossLandsWhereTheWindTakesIt) {
  for (const auto kind : {ardu_copter, px4_copter}) {
    WatchedFlight it{kind};
    it.rig.conditions().wind = {0, 3, 0};
    it.has_position = false;
    it.rig.wait(milliseconds{20});
    EXPECT_EQ(it.rig.mode(), FlightMode::land);
    EXPECT_TRUE(it.failsafes().is_active());
    ASSERT_TRUE(it.rig.wait_until([&] { return !it.rig.state().armed; }, seconds{60}));
    EXPECT_GT(it.rig.place().east, 20);
  }
  WatchedFlight it{ardu_copter};
  it.has_position = false;
  it.rig.wait(milliseconds{20});
  EXPECT_THAT(it.rig.texts, ElementsAre("EKF variance", "EKF Failsafe: changed to LAND Mode"));
}

TEST(Failsafe, ALandingThatLosesItsPositionGoesOnWithout) {
  WatchedFlight it{ardu_copter};
  ASSERT_TRUE(it.rig.enter(FlightMode::land));
  it.rig.wait(seconds{2});
  it.has_position = false;
  it.rig.conditions().wind = {0, 3, 0};
  ASSERT_TRUE(it.rig.wait_until([&] { return !it.rig.state().armed; }, seconds{60}));
  EXPECT_GT(it.rig.place().east, 20) << "nothing holds it in place any more";
}

TEST(Failsafe, FenceOfArduCopterIsOffByDefaultAndReturnsWhenOn) {
  WatchedFlight it{ardu_copter};
  ASSERT_TRUE(it.rig.guide({.position = displaced(field, {0, 0, -130})}));
  it.rig.wait(seconds{60});
  EXPECT_EQ(it.rig.mode(), FlightMode::guided);
  it.set("FENCE_ENABLE", 1);
  it.rig.wait(milliseconds{40});
  EXPECT_EQ(it.rig.mode(), FlightMode::rtl) << "FENCE_ALT_MAX is 100 m";
  EXPECT_THAT(it.rig.texts, ElementsAre("Max Alt fence breached"));
  EXPECT_TRUE(it.failsafes().is_active());
}

TEST(Failsafe, FenceOfPx4Holds) {
  WatchedFlight it{px4_copter};
  const std::vector items{item_at(messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, {0, 0, 0}, {40})};
  it.failsafes().set_fence(items);
  ASSERT_TRUE(it.rig.reposition({.position = displaced(field, {200, 0, -25})}));
  it.rig.wait(seconds{60});
  EXPECT_EQ(it.rig.mode(), FlightMode::loiter);
  EXPECT_LT(it.rig.place().north, 60) << "GF_ACTION is hold";
}

TEST(Failsafe, ALandingIsNotInterruptedByLess) {
  WatchedFlight it{ardu_copter};
  it.set("FS_GCS_ENABLE", 1);
  ASSERT_TRUE(it.rig.enter(FlightMode::land));
  it.lose_station();
  it.rig.wait(seconds{8});
  EXPECT_EQ(it.rig.mode(), FlightMode::land);
}

TEST(Failsafe, DisarmsOnTheGroundInsteadOfTakingOff) {
  WatchedFlight it{ardu_copter};
  ASSERT_TRUE(it.rig.enter(FlightMode::land));
  ASSERT_TRUE(it.rig.wait_until([&] { return !it.rig.state().armed; }, seconds{90}));
  it.set("FS_GCS_ENABLE", 1);
  ASSERT_TRUE(it.rig.enter(FlightMode::guided));
  it.rig.arm();
  it.lose_station();
  it.rig.wait(milliseconds{5100});
  EXPECT_FALSE(it.rig.state().armed);
}

TEST(Failsafe, TerminationStopsTheMotors) {
  WatchedFlight it{px4_copter};
  it.set("NAV_DLL_ACT", 5);
  it.lose_station();
  it.rig.wait(seconds{16});
  EXPECT_TRUE(it.failsafes().is_terminated());
}

}  // namespace
}  // namespace ponte::sim
