#include "ponte/autopilot/v09.hpp"

#include "ponte/autopilot/test_frames.hpp"
#include "ponte/autopilot/vehicle_monitor.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/v09/attitude.hpp"
#include "ponte/mavlink/v09/enums.hpp"
#include "ponte/mavlink/v09/global_position.hpp"
#include "ponte/mavlink/v09/global_position_int.hpp"
#include "ponte/mavlink/v09/heartbeat.hpp"
#include "ponte/mavlink/v09/nav_controller_output.hpp"
#include "ponte/mavlink/v09/scaled_imu.hpp"
#include "ponte/mavlink/v09/scaled_pressure.hpp"
#include "ponte/mavlink/v09/statustext.hpp"
#include "ponte/mavlink/v09/sys_status.hpp"
#include "ponte/mavlink/v09/vfr_hud.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace ponte::autopilot {
namespace {

namespace then = mavlink::v09;
namespace now = mavlink::autopilots;
using testing::TestFrame;
using vehicle::ModeKind;
using vehicle::Phase;

TEST(V09, NumbersThatMeanSomethingElseToday) {
  EXPECT_EQ(v09::autopilot_of(then::MAV_AUTOPILOT_NONE), now::MAV_AUTOPILOT_INVALID);
  EXPECT_EQ(v09::autopilot_of(then::MAV_AUTOPILOT_ARDUPILOTMEGA), now::MAV_AUTOPILOT_ARDUPILOTMEGA);
  EXPECT_EQ(v09::airframe_of(then::OCU), now::MAV_TYPE_GCS);
  EXPECT_EQ(v09::airframe_of(then::MAV_QUADROTOR), now::MAV_TYPE_QUADROTOR);
  EXPECT_EQ(v09::system_status_of(then::MAV_STATE_POWEROFF), now::MAV_STATE_POWEROFF);
  EXPECT_EQ(v09::system_status_of(then::MAV_STATE_EMERGENCY), now::MAV_STATE_EMERGENCY);
}

TEST(V09, IsArmedOnlyWhenTheMotorsMayRun) {
  EXPECT_TRUE(v09::is_armed(then::MAV_MODE_MANUAL, then::MAV_STATE_ACTIVE));
  EXPECT_TRUE(v09::is_armed(then::MAV_MODE_AUTO, then::MAV_STATE_EMERGENCY));
  EXPECT_FALSE(v09::is_armed(then::MAV_MODE_MANUAL, then::MAV_STATE_STANDBY));
  EXPECT_FALSE(v09::is_armed(then::MAV_MODE_LOCKED, then::MAV_STATE_ACTIVE));
  EXPECT_FALSE(v09::is_armed(then::MAV_MODE_MANUAL, then::MAV_STATE_POWEROFF));
}

TEST(V09, TheNavigationModeTellsWhatAutomaticControlDoes) {
  const auto kind = [](std::uint8_t mode, std::uint8_t nav_mode) { return v09::mode_of(mode, nav_mode).kind; };
  EXPECT_EQ(kind(then::MAV_MODE_AUTO, then::MAV_NAV_WAYPOINT), ModeKind::mission);
  EXPECT_EQ(kind(then::MAV_MODE_AUTO, then::MAV_NAV_RETURNING), ModeKind::return_home);
  EXPECT_EQ(kind(then::MAV_MODE_AUTO, then::MAV_NAV_LANDING), ModeKind::land);
  EXPECT_EQ(kind(then::MAV_MODE_MANUAL, then::MAV_NAV_LANDING), ModeKind::manual);
  EXPECT_EQ(kind(then::MAV_MODE_GUIDED, then::MAV_NAV_VECTOR), ModeKind::guided);
  const auto unknown = v09::mode_of(77, 0);
  EXPECT_EQ(unknown.kind, ModeKind::other);
  EXPECT_EQ(unknown.name.view(), "mode 77");
}

/// A vehicle of 2011, and what is learnt of it.
struct Flight {
  template <mavlink::Message M>
  void say(const M& message) {
    const TestFrame frame{message, testing::vehicle_system, testing::autopilot_component, mavlink::Version::v0_9};
    monitor.on_message(time, WallTime{} + std::chrono::seconds{1}, frame.view(), alerts);
  }

  VehicleMonitor monitor;
  Outbox<vehicle::Alert> alerts{4};
  Timestamp time{};
};

TEST(V09, TheMonitorLearnsModeStateAndMotion) {
  Flight flight;
  flight.say(then::Heartbeat{.type = then::MAV_QUADROTOR, .autopilot = then::MAV_AUTOPILOT_ARDUPILOTMEGA});
  flight.say(then::SysStatus{.mode = then::MAV_MODE_AUTO,
                             .nav_mode = then::MAV_NAV_LANDING,
                             .status = then::MAV_STATE_ACTIVE,
                             .battery_remaining = 875});
  flight.say(then::Attitude{.usec = 1, .roll = 0.25F});
  flight.say(then::GlobalPositionInt{.lat = 387'000'000, .lon = -91'000'000, .alt = 12'500, .vz = 150});
  const auto& state = flight.monitor.state();
  EXPECT_EQ(state.identity.value().airframe, now::MAV_TYPE_QUADROTOR);
  EXPECT_EQ(state.mode.value().kind, ModeKind::land);
  EXPECT_EQ(state.mode.value().name.view(), "AUTO.LANDING");
  EXPECT_EQ(state.phase.value(), Phase::landing);
  EXPECT_EQ(state.energy_level.value(), Percent{87.5});
  EXPECT_EQ(state.roll.value(), Radians{0.25});
  EXPECT_EQ(state.altitude_msl.value(), Metres{12.5});
  EXPECT_EQ(state.down_speed.value(), MetresPerSecond{-1.5}) << "its z axis points up";
}

TEST(V09, TheMonitorLearnsFromTheOtherMessagesToo) {
  Flight flight;
  flight.say(then::Heartbeat{.type = then::MAV_FIXED_WING, .autopilot = then::MAV_AUTOPILOT_ARDUPILOTMEGA});
  flight.say(
      then::SysStatus{.mode = then::MAV_MODE_AUTO, .nav_mode = then::MAV_NAV_WAYPOINT, .battery_remaining = 1001});
  flight.say(then::GlobalPosition{.usec = 1, .lat = 45, .lon = -90, .alt = 30, .vx = 1, .vy = 2, .vz = 3});
  flight.say(then::VfrHud{.airspeed = 14, .throttle = 55, .alt = 31, .climb = -2});
  flight.say(then::ScaledImu{.usec = 1, .xacc = 1000, .zgyro = -500});
  flight.say(then::ScaledPressure{.usec = 1, .press_abs = 1000, .temperature = 1500});
  flight.say(then::NavControllerOutput{.nav_bearing = 90, .target_bearing = 180});
  const auto& state = flight.monitor.state();
  EXPECT_FALSE(state.energy_level) << "above 100 %";
  EXPECT_NEAR(state.latitude.value().value, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(state.longitude.value().value, -std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(state.altitude_msl.value(), Metres{30});
  EXPECT_EQ(state.down_speed.value(), MetresPerSecond{-3});
  EXPECT_EQ(state.indicated_airspeed.value(), MetresPerSecond{14});
  EXPECT_EQ(state.climb_rate.value(), MetresPerSecond{-2});
  EXPECT_EQ(state.power_level.value(), Percent{55});
  EXPECT_NEAR(state.body_x_acceleration.value().value, 9.80665, 1e-9);
  EXPECT_NEAR(state.body_yaw_rate.value().value, -0.5, 1e-9);
  EXPECT_EQ(state.static_pressure.value(), Pascals{100'000});
  EXPECT_NEAR(state.air_temperature.value().value, 288.15, 1e-9);
  EXPECT_NEAR(state.commanded_course.value().value, std::numbers::pi, 1e-9);
}

TEST(V09, APlaceOfZerosIsNone) {
  Flight flight;
  flight.say(then::GlobalPosition{.usec = 1});
  EXPECT_FALSE(flight.monitor.state().latitude);
}

TEST(V09, ATextBecomesAnAlert) {
  Flight flight;
  flight.say(then::Statustext{.severity = 255, .text = std::string_view{"LOW BATTERY"}});
  std::vector<vehicle::Alert> alerts;
  flight.alerts.drain([&](const vehicle::Alert& alert) { alerts.push_back(alert); });
  ASSERT_EQ(alerts.size(), 1U);
  EXPECT_EQ(alerts[0].text.view(), "LOW BATTERY");
  EXPECT_EQ(alerts[0].severity, severity_of(now::MAV_SEVERITY_CRITICAL));
}

}  // namespace
}  // namespace ponte::autopilot
