#include "ponte/autopilot/life_cycle.hpp"

#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

using vehicle::ModeKind;
using vehicle::Phase;

// MAV_STATE and MAV_LANDED_STATE.
constexpr std::uint8_t uninit = 0, boot = 1, calibrating = 2, standby = 3, active = 4, critical = 5, emergency = 6,
                       power_off = 7, flight_termination = 8;
constexpr std::uint8_t undefined = 0, on_ground = 1, in_air = 2, taking_off = 3, landing = 4;

constexpr Stack copter = Stack::ardupilot_copter, plane = Stack::ardupilot_plane, px4 = Stack::px4;

struct Case {
  std::string_view story;
  LifeCycleSigns signs;
  Phase phase;
};

TEST(LifeCycle, TellsThePhaseFromAllSignsTogether) {
  constexpr auto none = std::nullopt;
  const Case cases[]{
      {"PX4 before its checks pass", {px4, uninit, false, none, {}}, Phase::power_up},
      {"ArduPilot booting", {copter, boot, false, none, {}}, Phase::power_up},
      {"calibrating", {px4, calibrating, false, on_ground, {}}, Phase::power_up},
      {"disarmed", {px4, standby, false, on_ground, {}}, Phase::pre_start},
      {"disarmed, landed state unknown", {copter, standby, false, none, {}}, Phase::pre_start},
      {"ArduPilot after a failsafe, landed and disarmed", {copter, critical, false, none, {}}, Phase::pre_start},
      {"the same with a landed state", {copter, critical, false, on_ground, {}}, Phase::pre_start},
      {"disarmed and off", {px4, power_off, false, on_ground, {}}, Phase::unknown},

      {"ArduPilot armed on the ground", {copter, standby, true, none, {}}, Phase::pre_launch},
      {"ArduPilot in the air", {copter, active, true, none, {}}, Phase::in_flight},
      {"ArduPlane in the air", {plane, active, true, none, {}}, Phase::in_flight},
      {"ArduPilot armed with a failsafe", {copter, critical, true, none, {}}, Phase::critical},
      {"ArduPilot landed after a failsafe, still armed", {copter, critical, true, on_ground, {}}, Phase::pre_launch},
      {"ArduPilot, landed state undefined", {copter, active, true, undefined, {}}, Phase::in_flight},
      {"ArduPilot, landed state from another world", {copter, active, true, 77, {}}, Phase::in_flight},
      {"ArduPilot armed while booting", {copter, boot, true, none, {}}, Phase::unknown},

      {"PX4 armed on the ground", {px4, active, true, on_ground, {}}, Phase::pre_launch},
      {"PX4 armed, nobody says where", {px4, active, true, none, {}}, Phase::unknown},
      {"PX4 armed with a failsafe, nobody says where", {px4, critical, true, none, {}}, Phase::unknown},
      {"another autopilot, nobody says where", {Stack::unknown, active, true, none, {}}, Phase::unknown},
      {"PX4 in the air", {px4, active, true, in_air, ModeKind::mission}, Phase::in_flight},
      {"PX4 taking off", {px4, active, true, taking_off, ModeKind::take_off}, Phase::taking_off},
      {"PX4 landing", {px4, active, true, landing, ModeKind::land}, Phase::landing},
      {"in the air on the way down", {px4, active, true, in_air, ModeKind::land}, Phase::landing},
      {"in the air on the way up", {copter, active, true, none, ModeKind::take_off}, Phase::taking_off},
      {"on the way home", {copter, active, true, none, ModeKind::return_home}, Phase::in_flight},

      {"failsafe in the air", {px4, critical, true, in_air, ModeKind::return_home}, Phase::critical},
      {"failsafe while landing", {px4, critical, true, landing, ModeKind::land}, Phase::critical},
      {"failsafe while taking off", {px4, critical, true, taking_off, ModeKind::take_off}, Phase::critical},
      {"emergency in the air", {px4, emergency, true, in_air, {}}, Phase::critical},
      {"flight termination in the air", {px4, flight_termination, true, in_air, {}}, Phase::critical},
      {"failsafe on the ground", {px4, critical, true, on_ground, {}}, Phase::pre_launch},
  };
  for (const auto& each : cases) EXPECT_EQ(phase_from(each.signs), each.phase) << each.story;
}

TEST(LifeCycle, NeverCallsADisarmedVehicleAirborne) {
  for (int status = 0; status <= 255; ++status)
    for (const auto landed : {undefined, on_ground, in_air, taking_off, landing}) {
      const auto phase = phase_from({px4, static_cast<std::uint8_t>(status), false, landed, ModeKind::mission});
      EXPECT_TRUE(phase == Phase::unknown || phase == Phase::power_up || phase == Phase::pre_start) << status;
    }
}

}  // namespace
}  // namespace ponte::autopilot
