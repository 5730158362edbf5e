#include "ponte/sim/settings.hpp"

#include "ponte/sim/seconds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

/// Which parameter is which setting, and how each autopilot behaves where no parameter tells.
namespace ponte::sim {
namespace {

using enum FailsafeAction;
using std::chrono::seconds;

constexpr double centi = 1e-2;
constexpr double milli = 1e-3;
constexpr double widest_cone = 89.9;  // degrees

/// What the number stands for, from 0 on; a number beyond has the last one.
template <class Choice, std::size_t N>
Choice chosen(double number, const std::array<Choice, N>& choices) {
  if (!(number > 0)) return choices.front();
  return number < N ? choices[static_cast<std::size_t>(number)] : choices.back();
}

bool has_bit(double value, unsigned bit) { return value > 0 && (static_cast<std::uint32_t>(value) >> bit & 1U) != 0; }

/// Where less than nothing stands for ever.
Duration seconds_or_for_ever(double value) { return value < 0 ? Duration::max() : seconds_from(value); }

/// The cone's angle is that between its axis and its side (degrees): 0 has no cone, and 90 no height.
double slope_of_cone(double degrees) {
  if (!(degrees > 0)) return 0;
  return std::tan(std::numbers::pi / 2 - radians_from_degrees(std::min(degrees, widest_cone)).value);
}

// A way back along the track is not flown here: it is the straight one. A brake is a landing at once.
constexpr std::array copter_battery{none, land, rtl, rtl, land, terminate, rtl, land};
constexpr std::array plane_battery{none, rtl, land, terminate, land, terminate, land, rtl};
constexpr std::array ardupilot_station{none, rtl, rtl, rtl, land, land, rtl, land};
constexpr std::array ardupilot_position{warn, land, keep_altitude, land};
constexpr std::array ardupilot_fence{warn, rtl, land, rtl, land, land, hold, hold, rtl};
constexpr std::array px4_critical{warn, warn, land, rtl};
constexpr std::array px4_emergency{warn, warn, land, land};
constexpr std::array px4_station{none, hold, rtl, land, land, terminate, terminate};
constexpr std::array px4_fence{none, warn, hold, rtl, terminate, land};
// What OFFBOARD ends with is a mode: to terminate and to disarm are landings.
constexpr std::array px4_offboard{FlightMode::position_hold, FlightMode::altitude_hold, FlightMode::stabilize,
                                  FlightMode::rtl,           FlightMode::land,          FlightMode::loiter,
                                  FlightMode::land};

struct SettingRow {
  std::string_view parameter;
  void (*take)(double value, Settings& to);
  std::optional<AirframeType> only{};  ///< where the other has it too, but does not read it, or does otherwise
};

constexpr auto ardupilot_rows = std::to_array<SettingRow>({
    {"WPNAV_SPEED", [](double v, Settings& to) { to.flight.handling.cruise_speed = MetresPerSecond{v * centi}; }},
    {"WPNAV_SPEED_UP", [](double v, Settings& to) { to.flight.handling.climb_rate = MetresPerSecond{v * centi}; }},
    {"WPNAV_SPEED_UP", [](double v, Settings& to) { to.flight.handling.take_off_rate = MetresPerSecond{v * centi}; }},
    {"WPNAV_SPEED_DN", [](double v, Settings& to) { to.flight.handling.descent_rate = MetresPerSecond{v * centi}; }},
    {"LAND_SPEED", [](double v, Settings& to) { to.flight.handling.landing_rate = MetresPerSecond{v * centi}; }},
    {"LAND_ALT_LOW", [](double v, Settings& to) { to.flight.handling.landing_height = Metres{v * centi}; }},
    {"CIRCLE_RADIUS", [](double v, Settings& to) { to.flight.handling.loiter_radius = Metres{v * centi}; }},
    {"WPNAV_RADIUS", [](double v, Settings& to) { to.flight.acceptance_radius = Metres{v * centi}; }},
    {"AUTO_OPTIONS", [](double v, Settings& to) { to.flight.mode_takes_off = has_bit(v, 1); }},
    {"RTL_ALT", [](double v, Settings& to) { to.flight.return_height = Metres{v * centi}; }},
    {"RTL_CLIMB_MIN", [](double v, Settings& to) { to.flight.return_climb = Metres{v * centi}; }},
    {"RTL_CONE_SLOPE", [](double v, Settings& to) { to.flight.return_cone_slope = v; }},
    {"RTL_SPEED", [](double v, Settings& to) { to.flight.return_speed = MetresPerSecond{v * centi}; }},
    {"RTL_LOIT_TIME", [](double v, Settings& to) { to.flight.return_wait = seconds_from(v * milli); }},
    {"RTL_ALT_FINAL", [](double v, Settings& to) { to.flight.return_final_height = Metres{v * centi}; }},
    {"GUID_TIMEOUT", [](double v, Settings& to) { to.flight.guided_time_out = seconds_from(v); }},
    {"DISARM_DELAY", [](double v, Settings& to) { to.flight.disarms_idle_after = seconds_from(v); }},

    {"BATT_LOW_VOLT", [](double v, Settings& to) { to.failsafes.low_volts = v; }},
    {"BATT_CRT_VOLT", [](double v, Settings& to) { to.failsafes.critical_volts = v; }},
    {"BATT_LOW_TIMER", [](double v, Settings& to) { to.failsafes.low_volts_last = seconds_from(v); }},
    {"BATT_LOW_MAH", [](double v, Settings& to) { to.failsafes.low_ampere_hours = v * milli; }},
    {"BATT_CRT_MAH", [](double v, Settings& to) { to.failsafes.critical_ampere_hours = v * milli; }},
    {"BATT_FS_LOW_ACT", [](double v, Settings& to) { to.failsafes.low = chosen(v, copter_battery); },
     AirframeType::copter},
    {"BATT_FS_LOW_ACT", [](double v, Settings& to) { to.failsafes.low = chosen(v, plane_battery); },
     AirframeType::plane},
    {"BATT_FS_CRT_ACT", [](double v, Settings& to) { to.failsafes.critical = chosen(v, copter_battery); },
     AirframeType::copter},
    {"BATT_FS_CRT_ACT", [](double v, Settings& to) { to.failsafes.critical = chosen(v, plane_battery); },
     AirframeType::plane},
    {"FS_GCS_TIMEOUT", [](double v, Settings& to) { to.failsafes.station_time_out = seconds_from(v); }},
    {"FS_GCS_ENABLE", [](double v, Settings& to) { to.failsafes.station = chosen(v, ardupilot_station); }},
    {"FS_EKF_ACTION", [](double v, Settings& to) { to.failsafes.position = chosen(v, ardupilot_position); }},
    {"FS_EKF_ACTION", [](double v, Settings& to) { to.failsafes.position_in_every_mode = v >= 3; }},
    {"FENCE_ENABLE", [](double v, Settings& to) { to.failsafes.fence.is_enabled = v > 0; }},
    {"FENCE_TYPE", [](double v, Settings& to) { to.failsafes.fence.heeds_height = has_bit(v, 0); }},
    {"FENCE_TYPE", [](double v, Settings& to) { to.failsafes.fence.heeds_radius = has_bit(v, 1); }},
    {"FENCE_TYPE", [](double v, Settings& to) { to.failsafes.fence.heeds_uploaded = has_bit(v, 2); }},
    {"FENCE_ALT_MAX", [](double v, Settings& to) { to.failsafes.fence.most_height = Metres{v}; }},
    {"FENCE_RADIUS", [](double v, Settings& to) { to.failsafes.fence.most_radius = Metres{v}; }},
    {"FENCE_ACTION", [](double v, Settings& to) { to.failsafes.breach = chosen(v, ardupilot_fence); }},
});

constexpr auto px4_rows = std::to_array<SettingRow>({
    {"MPC_XY_CRUISE", [](double v, Settings& to) { to.flight.handling.cruise_speed = MetresPerSecond{v}; },
     AirframeType::copter},
    {"FW_AIRSPD_TRIM", [](double v, Settings& to) { to.flight.handling.cruise_speed = MetresPerSecond{v}; },
     AirframeType::plane},
    {"MPC_XY_VEL_MAX", [](double v, Settings& to) { to.flight.handling.most_speed = MetresPerSecond{v}; },
     AirframeType::copter},
    {"FW_AIRSPD_MAX", [](double v, Settings& to) { to.flight.handling.most_speed = MetresPerSecond{v}; },
     AirframeType::plane},
    {"MPC_Z_V_AUTO_UP", [](double v, Settings& to) { to.flight.handling.climb_rate = MetresPerSecond{v}; },
     AirframeType::copter},
    {"FW_T_CLMB_R_SP", [](double v, Settings& to) { to.flight.handling.climb_rate = MetresPerSecond{v}; },
     AirframeType::plane},
    {"MPC_TKO_SPEED", [](double v, Settings& to) { to.flight.handling.take_off_rate = MetresPerSecond{v}; },
     AirframeType::copter},
    {"MPC_Z_V_AUTO_DN", [](double v, Settings& to) { to.flight.handling.descent_rate = MetresPerSecond{v}; },
     AirframeType::copter},
    {"FW_T_SINK_R_SP", [](double v, Settings& to) { to.flight.handling.descent_rate = MetresPerSecond{v}; },
     AirframeType::plane},
    {"MPC_LAND_SPEED", [](double v, Settings& to) { to.flight.handling.landing_rate = MetresPerSecond{v}; },
     AirframeType::copter},
    {"MPC_LAND_ALT2", [](double v, Settings& to) { to.flight.handling.landing_height = Metres{v}; },
     AirframeType::copter},
    {"NAV_LOITER_RAD", [](double v, Settings& to) { to.flight.handling.loiter_radius = Metres{v}; }},
    {"NAV_ACC_RAD", [](double v, Settings& to) { to.flight.acceptance_radius = Metres{v}; }},
    {"MIS_TAKEOFF_ALT", [](double v, Settings& to) { to.flight.take_off_height = Metres{v}; }},
    {"RTL_RETURN_ALT", [](double v, Settings& to) { to.flight.return_height = Metres{v}; }},
    {"RTL_CONE_ANG", [](double v, Settings& to) { to.flight.return_cone_slope = slope_of_cone(v); }},
    {"RTL_DESCEND_ALT", [](double v, Settings& to) { to.flight.return_final_height = Metres{v}; }},
    {"RTL_LAND_DELAY", [](double v, Settings& to) { to.flight.return_final_wait = seconds_or_for_ever(v); }},
    {"COM_OF_LOSS_T", [](double v, Settings& to) { to.flight.guided_time_out = seconds_from(v); }},
    {"COM_OBL_RC_ACT", [](double v, Settings& to) { to.flight.offboard_lost = chosen(v, px4_offboard); }},
    {"COM_DISARM_PRFLT", [](double v, Settings& to) { to.flight.disarms_idle_after = seconds_from(v); }},
    {"COM_DISARM_LAND", [](double v, Settings& to) { to.flight.disarms_landed_after = seconds_from(v); }},

    {"BAT_LOW_THR", [](double v, Settings& to) { to.failsafes.low_share = v; }},
    {"BAT_CRIT_THR", [](double v, Settings& to) { to.failsafes.critical_share = v; }},
    {"BAT_EMERGEN_THR", [](double v, Settings& to) { to.failsafes.emergency_share = v; }},
    {"COM_LOW_BAT_ACT", [](double v, Settings& to) { to.failsafes.critical = chosen(v, px4_critical); }},
    {"COM_LOW_BAT_ACT", [](double v, Settings& to) { to.failsafes.emergency = chosen(v, px4_emergency); }},
    {"COM_DL_LOSS_T", [](double v, Settings& to) { to.failsafes.station_time_out = seconds_from(v); }},
    {"NAV_DLL_ACT", [](double v, Settings& to) { to.failsafes.station = chosen(v, px4_station); }},
    {"COM_FAIL_ACT_T", [](double v, Settings& to) { to.failsafes.hold_first = seconds_from(v); }},
    {"GF_ACTION", [](double v, Settings& to) { to.failsafes.fence.is_enabled = v > 0; }},
    {"GF_ACTION", [](double v, Settings& to) { to.failsafes.breach = chosen(v, px4_fence); }},
    {"GF_MAX_VER_DIST", [](double v, Settings& to) { to.failsafes.fence.most_height = Metres{v}; }},
    {"GF_MAX_HOR_DIST", [](double v, Settings& to) { to.failsafes.fence.most_radius = Metres{v}; }},
});

constexpr FenceSettings all_fences{.heeds_height = true, .heeds_radius = true, .heeds_uploaded = true};

Settings ardu_copter() {
  return {.flight = {
              .take_off_height = Metres{10}, .return_final_wait = Duration::max(), .disarms_landed_after = seconds{1}}};
}

Settings ardu_plane() {
  return {.flight = {.handling = {.cruise_speed = MetresPerSecond{22},
                                  .climb_rate = MetresPerSecond{5},
                                  .descent_rate = MetresPerSecond{4},
                                  .loiter_radius = Metres{60}},
                     .acceptance_radius = Metres{50},
                     .take_off_height = Metres{50},
                     .mode_takes_off = true,
                     .return_height = Metres{100},
                     .disarms_landed_after = seconds{20}},
          .failsafes = {.fence = all_fences}};
}

Settings px4() {
  return {.flight = {.mode_takes_off = true}, .failsafes = {.low = warn, .position = land, .fence = all_fences}};
}

Settings behaviour_of(VehicleKind kind) {
  if (kind.personality == Personality::px4) return px4();
  return kind.type == AirframeType::plane ? ardu_plane() : ardu_copter();
}

std::span<const SettingRow> rows_of(Personality personality) {
  if (personality == Personality::px4) return px4_rows;
  return ardupilot_rows;
}

}  // namespace

Settings settings_of(VehicleKind kind, const Parameters& parameters) {
  auto settings = behaviour_of(kind);
  for (const auto& row : rows_of(kind.personality)) {
    if (row.only && row.only != kind.type) continue;
    if (const auto index = parameters.find(row.parameter)) row.take(parameters.value(*index), settings);
  }
  return settings;
}

}  // namespace ponte::sim
