// Parameters govern how it flies, from the moment they are set.
#include "ponte/mavlink/autopilots/param_set.hpp"
#include "ponte/sim/test_station.hpp"
#include "ponte/sim/watched_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

namespace ponte::sim {
namespace {

constexpr VehicleKind ardu_copter{Personality::ardupilot, AirframeType::copter};
constexpr VehicleKind px4_copter{Personality::px4, AirframeType::copter};
constexpr VehicleKind px4_plane{Personality::px4, AirframeType::plane};

Position at(double north, double height) { return displaced(field, {north, 0, -height}); }

/// The fastest that a number gets within this time.
template <class Number>
double most(FlightRig& rig, Duration time, Number number) {
  double result{};
  for (const auto end = rig.now() + time; rig.now() < end; rig.step()) result = std::max(result, number(rig.state()));
  return result;
}

double speed(const AirframeState& state) { return horizontal(state.velocity); }
double climb(const AirframeState& state) { return -state.velocity.down; }
double sink(const AirframeState& state) { return state.velocity.down; }
double height(const AirframeState& state) { return -offset_between(field, state.position).down; }

TEST(TunedFlight, OfArduCopterHasItsSpeeds) {
  WatchedFlight it{ardu_copter};
  it.set("WPNAV_SPEED", 600);
  ASSERT_TRUE(it.rig.guide({.position = at(200, 25)}));
  EXPECT_NEAR(most(it.rig, seconds{20}, speed), 6, 0.1);
  it.set("WPNAV_SPEED_UP", 500);
  ASSERT_TRUE(it.rig.guide({.position = at(200, 100)}));
  EXPECT_NEAR(most(it.rig, seconds{20}, climb), 5, 0.1);
  it.set("WPNAV_SPEED_DN", 300);
  ASSERT_TRUE(it.rig.guide({.position = at(200, 60)}));
  EXPECT_NEAR(most(it.rig, seconds{20}, sink), 3, 0.1);
  it.set("LAND_SPEED", 100);
  it.set("LAND_ALT_LOW", 2000);
  ASSERT_TRUE(it.rig.enter(FlightMode::land));
  ASSERT_TRUE(it.rig.wait_until([&] { return it.rig.height() < 19; }, seconds{60}));
  EXPECT_NEAR(it.rig.state().velocity.down, 1, 0.1);
}

TEST(TunedFlight, OfPx4HasItsSpeeds) {
  WatchedFlight it{px4_copter};
  it.set("MPC_XY_CRUISE", 9);
  ASSERT_TRUE(it.rig.reposition({.position = at(200, 25)}));
  EXPECT_NEAR(most(it.rig, seconds{10}, speed), 9, 0.1);
  it.set("MPC_XY_VEL_MAX", 4);
  it.rig.wait(seconds{5});
  EXPECT_NEAR(speed(it.rig.state()), 4, 0.1) << "at once, and whatever the cruise speed";
  it.set("MPC_Z_V_AUTO_UP", 2);
  ASSERT_TRUE(it.rig.reposition({.position = at(200, 60)}));
  EXPECT_NEAR(most(it.rig, seconds{10}, climb), 2, 0.1);
  it.set("MPC_Z_V_AUTO_DN", 0.8);
  ASSERT_TRUE(it.rig.reposition({.position = at(200, 20)}));
  EXPECT_NEAR(most(it.rig, seconds{10}, sink), 0.8, 0.1);
}

TEST(TunedFlight, OfPx4TakesOffAsItsParametersSay) {
  const auto climb_of = [](double rate, double height_wanted) {
    Parameters parameters{Personality::px4};
    parameters.set("MPC_TKO_SPEED", rate);
    parameters.set("MIS_TAKEOFF_ALT", height_wanted);
    FlightRig rig{px4_copter, std::make_unique<Copter>(CopterConfig{}, field, Radians{})};
    rig.flight().set_settings(settings_of(px4_copter, parameters).flight);
    EXPECT_TRUE(rig.enter(FlightMode::take_off));
    rig.arm();
    return std::pair{most(rig, seconds{30}, climb), height(rig.state())};
  };
  const auto [slow, low] = climb_of(1, 6);
  EXPECT_NEAR(slow, 1, 0.05);
  EXPECT_NEAR(low, 6, 0.1);
  const auto [fast, high] = climb_of(2.5, 20);
  EXPECT_NEAR(fast, 2.5, 0.05);
  EXPECT_NEAR(high, 20, 0.1);
}

TEST(TunedFlight, OfAPx4PlaneHasItsAirspeedAndItsCircle) {
  WatchedFlight it{px4_plane};
  EXPECT_NEAR(speed(it.rig.state()), 15, 0.2);
  it.set("FW_AIRSPD_TRIM", 18);
  it.set("NAV_LOITER_RAD", 120);
  ASSERT_TRUE(it.rig.reposition({.position = at(0, 40)}));
  it.rig.wait(seconds{120});
  EXPECT_NEAR(speed(it.rig.state()), 18, 0.2);
  EXPECT_NEAR(horizontal(it.rig.place()), 120, 4);
  it.set("FW_AIRSPD_MAX", 16);
  it.rig.wait(seconds{20});
  EXPECT_NEAR(speed(it.rig.state()), 16, 0.2);
}

TEST(TunedFlight, ReturnsAsArduCopterIsTold) {
  WatchedFlight it{ardu_copter};
  ASSERT_TRUE(it.rig.guide({.position = at(60, 25)}));
  it.rig.wait(seconds{25});
  it.set("RTL_ALT", 4000);
  it.set("RTL_SPEED", 300);
  it.set("RTL_LOIT_TIME", 20'000);
  it.set("RTL_ALT_FINAL", 500);
  ASSERT_TRUE(it.rig.enter(FlightMode::rtl));
  EXPECT_NEAR(most(it.rig, seconds{15}, height), 40, 0.4);
  EXPECT_NEAR(most(it.rig, seconds{10}, speed), 3, 0.1);
  ASSERT_TRUE(it.rig.wait_until([&] { return horizontal(it.rig.place()) < 0.4; }, seconds{60}));
  it.rig.wait(seconds{19});
  EXPECT_NEAR(it.rig.height(), 40, 0.4) << "RTL_LOIT_TIME";
  it.rig.wait(seconds{60});
  EXPECT_NEAR(it.rig.height(), 5, 0.4) << "RTL_ALT_FINAL";
}

TEST(TunedFlight, ClimbsToReturnEvenWhereItIsHighEnough) {
  WatchedFlight it{ardu_copter};
  it.set("RTL_CLIMB_MIN", 700);
  ASSERT_TRUE(it.rig.enter(FlightMode::rtl));
  EXPECT_NEAR(most(it.rig, seconds{15}, height), 32, 0.4);
}

TEST(TunedFlight, ReturnsAsPx4IsTold) {
  WatchedFlight it{px4_copter};
  it.set("RTL_RETURN_ALT", 45);
  it.set("RTL_CONE_ANG", 0);
  it.set("RTL_DESCEND_ALT", 15);
  it.set("RTL_LAND_DELAY", -1);
  ASSERT_TRUE(it.rig.enter(FlightMode::rtl));
  EXPECT_NEAR(most(it.rig, seconds{20}, height), 45, 0.4);
  it.rig.wait(seconds{90});
  EXPECT_NEAR(it.rig.height(), 15, 0.4) << "and it does not land";
  it.set("RTL_LAND_DELAY", 5);
  ASSERT_TRUE(it.rig.wait_until([&] { return !it.rig.state().armed; }, seconds{60}));
}

TEST(TunedFlight, DisarmsAfterTheTimeThatIsSet) {
  const auto armed_for = [](VehicleKind kind, std::string_view name, double value) {
    Parameters parameters{kind.personality, kind.type};
    parameters.set(name, value);
    FlightRig rig{kind, std::make_unique<Copter>(CopterConfig{}, field, Radians{})};
    rig.flight().set_settings(settings_of(kind, parameters).flight);
    rig.arm();
    rig.wait_until([&] { return !rig.state().armed; }, seconds{60});
    return std::chrono::duration<double>{rig.now()}.count();
  };
  EXPECT_NEAR(armed_for(ardu_copter, "DISARM_DELAY", 4), 4, 0.1);
  EXPECT_NEAR(armed_for(ardu_copter, "DISARM_DELAY", 0), 60, 0.1) << "never";
  EXPECT_NEAR(armed_for(px4_copter, "COM_DISARM_PRFLT", 6), 6, 0.1);
  EXPECT_NEAR(armed_for(px4_copter, "COM_DISARM_PRFLT", -1), 60, 0.1) << "never";

  WatchedFlight px4{px4_copter};
  px4.set("COM_DISARM_LAND", 7);
  ASSERT_TRUE(px4.rig.enter(FlightMode::land));
  ASSERT_TRUE(px4.rig.wait_until([&] { return !px4.rig.is_flying(); }, seconds{90}));
  px4.rig.wait(milliseconds{6900});
  EXPECT_TRUE(px4.rig.state().armed);
  px4.rig.wait(milliseconds{200});
  EXPECT_FALSE(px4.rig.state().armed);
}

TEST(TunedFlight, StaysWithinWhatTheAircraftIsAbleTo) {
  for (const double value : {-1e30, 0.0, 1e30}) {
    WatchedFlight copter{ardu_copter};
    for (const auto* name : {"WPNAV_SPEED", "WPNAV_SPEED_UP", "WPNAV_SPEED_DN", "WPNAV_RADIUS", "CIRCLE_RADIUS"})
      copter.set(name, value);
    static_cast<void>(copter.rig.guide({.position = at(100, 60)}));
    EXPECT_LE(most(copter.rig, seconds{20}, climb), CopterConfig{}.climb_rate.value * 1.05);
    static_cast<void>(copter.rig.enter(FlightMode::circle));
    EXPECT_LE(most(copter.rig, seconds{20}, speed), CopterConfig{}.speed.value);
    static_cast<void>(copter.rig.enter(FlightMode::rtl));
    copter.rig.wait(seconds{20});
    EXPECT_TRUE(std::isfinite(copter.rig.height() + horizontal(copter.rig.place()))) << value;

    WatchedFlight plane{px4_plane};
    for (const auto* name : {"FW_AIRSPD_TRIM", "FW_AIRSPD_MAX", "FW_T_CLMB_R_SP", "FW_T_SINK_R_SP", "NAV_LOITER_RAD"})
      plane.set(name, value);
    EXPECT_LE(most(plane.rig, seconds{20}, speed), PlaneConfig{}.most_airspeed.value * 1.05);
    static_cast<void>(plane.rig.enter(FlightMode::rtl));
    plane.rig.wait(seconds{20});
    EXPECT_TRUE(std::isfinite(plane.rig.height() + horizontal(plane.rig.place()))) << value;
  }
}

TEST(TunedFlight, BeginsWithTheParametersOfItsConfigAndTakesThoseOfTheStation) {
  TestStation station{{.fly_square = false, .parameters = {{"DISARM_DELAY", 3}}}};
  station.wait(seconds{9});
  ASSERT_EQ(station.arm(), unsigned{messages::MAV_RESULT_ACCEPTED});
  station.wait(milliseconds{3100});
  EXPECT_FALSE(station.truth().armed);
  station.send(messages::ParamSet{.target_system = 1,
                                  .target_component = 1,
                                  .param_id = std::string_view{"DISARM_DELAY"},
                                  .param_value = 30,
                                  .param_type = 2});
  ASSERT_EQ(station.arm(), unsigned{messages::MAV_RESULT_ACCEPTED});
  station.wait(seconds{29});
  EXPECT_TRUE(station.truth().armed);
  station.wait(seconds{2});
  EXPECT_FALSE(station.truth().armed);
}

/// MAVSDK sets the height, arms and takes off without waiting for anything.
TEST(TunedFlight, IsSoAtOnce) {
  TestStation station{{.personality = Personality::px4, .fly_square = false}};
  station.wait(seconds{10});
  station.send(messages::ParamSet{.target_system = 1,
                                  .target_component = 1,
                                  .param_id = std::string_view{"MIS_TAKEOFF_ALT"},
                                  .param_value = 10,
                                  .param_type = messages::MAV_PARAM_TYPE_REAL32});
  constexpr float own_choice = std::numeric_limits<float>::quiet_NaN();
  ASSERT_EQ(station.arm(), unsigned{messages::MAV_RESULT_ACCEPTED});
  ASSERT_EQ(station.take_off(own_choice), unsigned{messages::MAV_RESULT_ACCEPTED});
  station.wait(seconds{30});
  EXPECT_NEAR(-station.place().down, 10, 0.2);
}

}  // namespace
}  // namespace ponte::sim
