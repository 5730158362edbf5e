// Each failsafe of each vehicle does what its parameter says.
#include "ponte/sim/watched_flight.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

namespace ponte::sim {
namespace {

using enum FlightMode;

constexpr VehicleKind ardu_copter{Personality::ardupilot, AirframeType::copter};
constexpr VehicleKind ardu_plane{Personality::ardupilot, AirframeType::plane};
constexpr VehicleKind px4_copter{Personality::px4, AirframeType::copter};
constexpr VehicleKind px4_plane{Personality::px4, AirframeType::plane};

/// What goes wrong. Batteries never fall so low within a test: it is the limit that is raised above what they have.
enum class Trouble { low_battery, critical_battery, emergency_battery, station, position, fence, offboard };

struct Case {
  VehicleKind kind;
  Trouble trouble;
  std::string_view parameter;
  double value;
  FlightMode mode;  // that it ends in
  bool terminates{};

  friend void PrintTo(const Case& each, std::ostream* out) { *out << each.parameter << ' ' << each.value; }
};

void begin(Trouble trouble, VehicleKind kind, WatchedFlight& it) {
  const bool is_px4 = kind.personality == Personality::px4;
  switch (trouble) {
    case Trouble::low_battery:
      if (is_px4) return it.set("BAT_LOW_THR", 2);
      it.set("BATT_LOW_TIMER", 0);
      return it.set("BATT_LOW_VOLT", 20);
    case Trouble::critical_battery:
      if (is_px4) return it.set("BAT_CRIT_THR", 2);
      it.set("BATT_LOW_TIMER", 0);
      return it.set("BATT_CRT_VOLT", 20);
    case Trouble::emergency_battery: return it.set("BAT_EMERGEN_THR", 2);
    case Trouble::station: return it.lose_station();
    case Trouble::position: it.has_position = false; return;
    case Trouble::fence:
      if (is_px4) return it.set("GF_MAX_VER_DIST", 1);
      it.set("FENCE_ENABLE", 1);
      return it.set("FENCE_ALT_MAX", 1);
    case Trouble::offboard:
      EXPECT_TRUE(it.rig.guide({.velocity = NorthEastDown{}}));
      EXPECT_TRUE(it.rig.enter(guided));
      return;
  }
}

class FailsafeParameter : public ::testing::TestWithParam<Case> {};

TEST_P(FailsafeParameter, SaysWhatIsDone) {
  const auto& [kind, trouble, parameter, value, mode, terminates] = GetParam();
  WatchedFlight it{kind};
  it.set(parameter, value);
  begin(trouble, kind, it);
  // The longest: 10 s until PX4 misses the station, and 5 s in which it holds.
  it.rig.wait(milliseconds{15'100});
  EXPECT_EQ(it.rig.mode(), mode);
  EXPECT_EQ(it.failsafes().is_terminated(), terminates);
}

INSTANTIATE_TEST_SUITE_P(ArduCopter, FailsafeParameter,
                         ::testing::ValuesIn(std::vector<Case>{
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 0, guided},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 1, land},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 2, rtl},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 3, rtl},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 4, land},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 5, guided, true},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 6, rtl},
                             {ardu_copter, Trouble::low_battery, "BATT_FS_LOW_ACT", 7, land},
                             {ardu_copter, Trouble::critical_battery, "BATT_FS_CRT_ACT", 0, guided},
                             {ardu_copter, Trouble::critical_battery, "BATT_FS_CRT_ACT", 1, land},
                             {ardu_copter, Trouble::critical_battery, "BATT_FS_CRT_ACT", 2, rtl},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 0, guided},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 1, rtl},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 3, rtl},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 4, land},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 5, land},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 6, rtl},
                             {ardu_copter, Trouble::station, "FS_GCS_ENABLE", 7, land},
                             {ardu_copter, Trouble::position, "FS_EKF_ACTION", 0, guided},
                             {ardu_copter, Trouble::position, "FS_EKF_ACTION", 1, land},
                             {ardu_copter, Trouble::position, "FS_EKF_ACTION", 2, altitude_hold},
                             {ardu_copter, Trouble::position, "FS_EKF_ACTION", 3, land},
                             {ardu_copter, Trouble::fence, "FENCE_ACTION", 0, guided},
                             {ardu_copter, Trouble::fence, "FENCE_ACTION", 1, rtl},
                             {ardu_copter, Trouble::fence, "FENCE_ACTION", 2, land},
                             {ardu_copter, Trouble::fence, "FENCE_ACTION", 3, rtl},
                             {ardu_copter, Trouble::fence, "FENCE_ACTION", 4, land},
                             {ardu_copter, Trouble::fence, "FENCE_ACTION", 5, land},
                             {ardu_copter, Trouble::fence, "FENCE_TYPE", 6, guided},
                         }));

// It has no mode to land in: what would land goes home.
INSTANTIATE_TEST_SUITE_P(ArduPlane, FailsafeParameter,
                         ::testing::ValuesIn(std::vector<Case>{
                             {ardu_plane, Trouble::low_battery, "BATT_FS_LOW_ACT", 0, loiter},
                             {ardu_plane, Trouble::low_battery, "BATT_FS_LOW_ACT", 1, rtl},
                             {ardu_plane, Trouble::low_battery, "BATT_FS_LOW_ACT", 2, rtl},
                             {ardu_plane, Trouble::low_battery, "BATT_FS_LOW_ACT", 3, loiter, true},
                             {ardu_plane, Trouble::low_battery, "BATT_FS_LOW_ACT", 7, rtl},
                             {ardu_plane, Trouble::critical_battery, "BATT_FS_CRT_ACT", 0, loiter},
                             {ardu_plane, Trouble::critical_battery, "BATT_FS_CRT_ACT", 1, rtl},
                             {ardu_plane, Trouble::critical_battery, "BATT_FS_CRT_ACT", 3, loiter, true},
                             {ardu_plane, Trouble::fence, "FENCE_ACTION", 0, loiter},
                             {ardu_plane, Trouble::fence, "FENCE_ACTION", 1, rtl},
                             {ardu_plane, Trouble::fence, "FENCE_ACTION", 6, guided},
                             {ardu_plane, Trouble::fence, "FENCE_ACTION", 7, guided},
                             {ardu_plane, Trouble::fence, "FENCE_ACTION", 8, rtl},
                         }));

std::vector<Case> of_px4(VehicleKind kind) {
  return {
      {kind, Trouble::low_battery, "COM_LOW_BAT_ACT", 3, loiter},
      {kind, Trouble::critical_battery, "COM_LOW_BAT_ACT", 0, loiter},
      {kind, Trouble::critical_battery, "COM_LOW_BAT_ACT", 2, land},
      {kind, Trouble::critical_battery, "COM_LOW_BAT_ACT", 3, rtl},
      {kind, Trouble::emergency_battery, "COM_LOW_BAT_ACT", 0, loiter},
      {kind, Trouble::emergency_battery, "COM_LOW_BAT_ACT", 3, land},
      {kind, Trouble::station, "NAV_DLL_ACT", 0, loiter},
      {kind, Trouble::station, "NAV_DLL_ACT", 1, loiter},
      {kind, Trouble::station, "NAV_DLL_ACT", 2, rtl},
      {kind, Trouble::station, "NAV_DLL_ACT", 3, land},
      {kind, Trouble::station, "NAV_DLL_ACT", 5, loiter, true},
      {kind, Trouble::station, "NAV_DLL_ACT", 6, loiter, true},
      {kind, Trouble::position, "COM_FAIL_ACT_T", 5, land},
      {kind, Trouble::fence, "GF_ACTION", 0, loiter},
      {kind, Trouble::fence, "GF_ACTION", 1, loiter},
      {kind, Trouble::fence, "GF_ACTION", 2, loiter},
      {kind, Trouble::fence, "GF_ACTION", 3, rtl},
      {kind, Trouble::fence, "GF_ACTION", 4, loiter, true},
      {kind, Trouble::fence, "GF_ACTION", 5, land},
      {kind, Trouble::offboard, "COM_OBL_RC_ACT", 0, position_hold},
      {kind, Trouble::offboard, "COM_OBL_RC_ACT", 1, altitude_hold},
      {kind, Trouble::offboard, "COM_OBL_RC_ACT", 2, stabilize},
      {kind, Trouble::offboard, "COM_OBL_RC_ACT", 3, rtl},
      {kind, Trouble::offboard, "COM_OBL_RC_ACT", 4, land},
      {kind, Trouble::offboard, "COM_OBL_RC_ACT", 5, loiter},
  };
}

INSTANTIATE_TEST_SUITE_P(Px4Copter, FailsafeParameter, ::testing::ValuesIn(of_px4(px4_copter)));
INSTANTIATE_TEST_SUITE_P(Px4Plane, FailsafeParameter, ::testing::ValuesIn(of_px4(px4_plane)));

/// How long after the trouble the mode changes.
double reaction_s(VehicleKind kind, Trouble trouble, const std::vector<std::pair<std::string_view, double>>& settings) {
  WatchedFlight it{kind};
  for (const auto& [parameter, value] : settings) it.set(parameter, value);
  begin(trouble, kind, it);
  const auto before = it.rig.mode();
  const auto from = it.rig.now();
  EXPECT_TRUE(it.rig.wait_until([&] { return it.rig.mode() != before; }, seconds{60}));
  return std::chrono::duration<double>{it.rig.now() - from}.count();
}

TEST(FailsafeTimes, AreParametersToo) {
  constexpr double step = 0.021;
  EXPECT_NEAR(reaction_s(ardu_copter, Trouble::station, {{"FS_GCS_ENABLE", 1}, {"FS_GCS_TIMEOUT", 12}}), 12, step);
  EXPECT_NEAR(reaction_s(px4_copter, Trouble::station, {{"NAV_DLL_ACT", 2}, {"COM_DL_LOSS_T", 20}}), 25, step);
  EXPECT_NEAR(reaction_s(px4_copter, Trouble::station, {{"NAV_DLL_ACT", 2}, {"COM_FAIL_ACT_T", 0}}), 10, step);
  EXPECT_NEAR(reaction_s(px4_copter, Trouble::offboard, {{"COM_OF_LOSS_T", 4}}), 4, step);
  WatchedFlight copter{ardu_copter};
  copter.set("BATT_FS_LOW_ACT", 2);
  copter.set("BATT_LOW_TIMER", 3);
  copter.set("BATT_LOW_VOLT", 20);
  copter.rig.wait(milliseconds{2900});
  EXPECT_EQ(copter.rig.mode(), guided);
  copter.rig.wait(milliseconds{200});
  EXPECT_EQ(copter.rig.mode(), rtl);
}

TEST(FailsafeLimits, AreParametersToo) {
  WatchedFlight copter{ardu_copter};
  copter.set("BATT_FS_LOW_ACT", 2);
  copter.set("BATT_LOW_VOLT", 0);
  copter.set("BATT_LOW_MAH", 100'000);
  copter.rig.wait(milliseconds{40});
  EXPECT_EQ(copter.rig.mode(), rtl) << "what is left is less";
  WatchedFlight far{px4_copter};
  far.set("GF_ACTION", 3);
  far.set("GF_MAX_HOR_DIST", 20);
  ASSERT_TRUE(far.rig.reposition({.position = displaced(field, {100, 0, -25})}));
  far.rig.wait(seconds{20});
  EXPECT_EQ(far.rig.mode(), rtl);
}

TEST(FailsafeOfTheEkf, WatchesEveryModeWhenItSaysSo) {
  for (const double action : {1.0, 3.0}) {
    WatchedFlight it{ardu_copter};
    it.set("FS_EKF_ACTION", action);
    ASSERT_TRUE(it.rig.enter(altitude_hold));
    it.has_position = false;
    it.rig.wait(seconds{1});
    EXPECT_EQ(it.rig.mode(), action == 3 ? land : altitude_hold);
  }
}

}  // namespace
}  // namespace ponte::sim
