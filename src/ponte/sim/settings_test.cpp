#include "ponte/sim/settings.hpp"

#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using std::chrono::seconds;

constexpr VehicleKind ardu_copter{Personality::ardupilot, AirframeType::copter};
constexpr VehicleKind ardu_plane{Personality::ardupilot, AirframeType::plane};
constexpr VehicleKind px4_copter{Personality::px4, AirframeType::copter};
constexpr VehicleKind px4_plane{Personality::px4, AirframeType::plane};

Parameters factory(VehicleKind kind) { return Parameters{kind.personality, kind.type}; }

TEST(Settings, OfArduCopterHaveTheRealDefaults) {
  const auto [flight, failsafes] = settings_of(ardu_copter, factory(ardu_copter));
  EXPECT_EQ(flight.handling.cruise_speed, MetresPerSecond{10});
  EXPECT_EQ(flight.handling.climb_rate, MetresPerSecond{2.5});
  EXPECT_EQ(flight.handling.descent_rate, MetresPerSecond{1.5});
  EXPECT_EQ(flight.handling.landing_rate, MetresPerSecond{0.5});
  EXPECT_EQ(flight.handling.landing_height, Metres{10});
  EXPECT_EQ(flight.return_height, Metres{15});
  EXPECT_EQ(flight.return_speed, MetresPerSecond{}) << "as WPNAV_SPEED";
  EXPECT_EQ(flight.disarms_idle_after, seconds{10});
  EXPECT_FALSE(flight.mode_takes_off);
  EXPECT_EQ(failsafes.low_volts, 10.5);
  EXPECT_EQ(failsafes.low_volts_last, seconds{10});
  EXPECT_EQ(failsafes.station_time_out, seconds{5});
  EXPECT_EQ(failsafes.station, FailsafeAction::none);
  EXPECT_EQ(failsafes.position, FailsafeAction::land);
  EXPECT_FALSE(failsafes.fence.is_enabled);
  EXPECT_TRUE(failsafes.fence.heeds_radius);
  EXPECT_EQ(failsafes.fence.most_height, Metres{100});
}

TEST(Settings, OfPx4HaveTheRealDefaults) {
  const auto [flight, failsafes] = settings_of(px4_copter, factory(px4_copter));
  EXPECT_EQ(flight.handling.cruise_speed, MetresPerSecond{5});
  EXPECT_EQ(flight.handling.most_speed, MetresPerSecond{12});
  EXPECT_EQ(flight.handling.climb_rate, MetresPerSecond{3});
  EXPECT_EQ(flight.handling.take_off_rate, MetresPerSecond{1.5});
  EXPECT_EQ(flight.return_height, Metres{30});
  EXPECT_NEAR(flight.return_cone_slope, 1, 1e-9) << "RTL_CONE_ANG is 45 degrees";
  EXPECT_EQ(flight.return_final_height, Metres{10});
  EXPECT_EQ(flight.return_final_wait, Duration{});
  EXPECT_EQ(flight.offboard_lost, FlightMode::position_hold);
  EXPECT_NEAR(failsafes.low_share, 0.15, 1e-6);
  EXPECT_EQ(failsafes.critical, FailsafeAction::warn);
  EXPECT_EQ(failsafes.station, FailsafeAction::none);
  EXPECT_EQ(failsafes.breach, FailsafeAction::hold);
  EXPECT_EQ(failsafes.fence.most_height, Metres{}) << "any";
  EXPECT_EQ(failsafes.hold_first, seconds{5});
}

TEST(Settings, OfPlanesDoNotListenToTheParametersOfCopters) {
  const auto ardupilot = factory(ardu_plane);
  for (const auto* name : {"RTL_ALT", "WPNAV_SPEED", "FS_GCS_ENABLE", "FS_EKF_ACTION"})
    EXPECT_FALSE(ardupilot.find(name)) << name;
  EXPECT_EQ(settings_of(ardu_plane, ardupilot).flight.handling.cruise_speed, MetresPerSecond{22});
  auto px4 = factory(px4_plane);  // which has them all
  px4.set("MPC_XY_CRUISE", 8);
  EXPECT_EQ(settings_of(px4_plane, px4).flight.handling.cruise_speed, MetresPerSecond{15});
  px4.set("FW_AIRSPD_TRIM", 18);
  EXPECT_EQ(settings_of(px4_plane, px4).flight.handling.cruise_speed, MetresPerSecond{18});
  EXPECT_EQ(settings_of(px4_copter, px4).flight.handling.cruise_speed, MetresPerSecond{8});
}

TEST(Settings, ReadTheSameNumberAsEachVehicleDoes) {
  auto copter = factory(ardu_copter);
  copter.set("BATT_FS_LOW_ACT", 1);
  EXPECT_EQ(settings_of(ardu_copter, copter).failsafes.low, FailsafeAction::land);
  auto plane = factory(ardu_plane);
  plane.set("BATT_FS_LOW_ACT", 1);
  EXPECT_EQ(settings_of(ardu_plane, plane).failsafes.low, FailsafeAction::rtl);
}

TEST(Settings, TakeNumbersThatStandForNothingAsTheLastOne) {
  auto parameters = factory(px4_copter);
  parameters.set("NAV_DLL_ACT", 2'000'000'000);
  EXPECT_EQ(settings_of(px4_copter, parameters).failsafes.station, FailsafeAction::terminate);
  parameters.set("NAV_DLL_ACT", -7);
  EXPECT_EQ(settings_of(px4_copter, parameters).failsafes.station, FailsafeAction::none);
}

TEST(Settings, KnowWhatLastsForEverAndWhatIsOff) {
  auto parameters = factory(px4_copter);
  parameters.set("RTL_LAND_DELAY", -1);
  parameters.set("COM_DISARM_LAND", -1);
  parameters.set("RTL_CONE_ANG", 0);
  const auto flight = settings_of(px4_copter, parameters).flight;
  EXPECT_EQ(flight.return_final_wait, Duration::max());
  EXPECT_EQ(flight.disarms_landed_after, Duration{});
  EXPECT_EQ(flight.return_cone_slope, 0);
}

}  // namespace
}  // namespace ponte::sim
