#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/parameters.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

/// The tables of parameters. Those of copters are what ArduCopter and PX4 listed in the recordings, written by
/// tests/recordings/parameters.py.
namespace ponte::sim {
namespace {

using enum ParameterType;
namespace messages = mavlink::autopilots;

constexpr auto arducopter = std::to_array<ParameterInfo>({
#include "ponte/sim/arducopter_parameters.def"
});
constexpr auto px4_copter = std::to_array<ParameterInfo>({
#include "ponte/sim/px4_copter_parameters.def"
});

/// Where the recorded vehicles were set up otherwise than the firmware is.
constexpr auto firmware_defaults = std::to_array<std::pair<std::string_view, double>>({
    {"FENCE_RADIUS", 300},
    {"COM_LOW_BAT_ACT", 0},
});

/// A plane's that a copter has too, with the same default.
constexpr auto of_ardupilot_planes = std::to_array<std::string_view>({
    "ARMING_CHECK",  "ARMING_OPTIONS",   "RC1_MIN",         "RC1_TRIM",         "RC1_MAX",          "RC2_MIN",
    "RC2_TRIM",      "RC2_MAX",          "RC3_MIN",         "RC3_TRIM",         "RC3_MAX",          "RC4_MIN",
    "RC4_TRIM",      "RC4_MAX",          "COMPASS_OFS_X",   "COMPASS_OFS_Y",    "COMPASS_OFS_Z",    "COMPASS_DEC",
    "COMPASS_USE",   "COMPASS_DEV_ID",   "COMPASS_ENABLE",  "INS_GYROFFS_X",    "INS_GYROFFS_Y",    "INS_GYROFFS_Z",
    "INS_ACCOFFS_X", "INS_ACCOFFS_Y",    "INS_ACCOFFS_Z",   "AHRS_EKF_TYPE",    "MNT1_TYPE",        "BATT_MONITOR",
    "BATT_CAPACITY", "BATT_LOW_TIMER",   "BATT_FS_VOLTSRC", "BATT_LOW_VOLT",    "BATT_LOW_MAH",     "BATT_CRT_VOLT",
    "BATT_CRT_MAH",  "BATT_FS_LOW_ACT",  "BATT_FS_CRT_ACT", "BATT_ARM_VOLT",    "BATT_ARM_MAH",     "GPS1_TYPE",
    "RALLY_TOTAL",   "RALLY_LIMIT_KM",   "RALLY_INCL_HOME", "EK3_ENABLE",       "MIS_TOTAL",        "MIS_RESTART",
    "MIS_OPTIONS",   "RC_OVERRIDE_TIME", "RC_FS_TIMEOUT",   "FENCE_ENABLE",     "FENCE_ACTION",     "FENCE_ALT_MAX",
    "FENCE_RADIUS",  "FENCE_MARGIN",     "FENCE_TOTAL",     "FENCE_ALT_MIN",    "FENCE_AUTOENABLE", "STAT_BOOTCNT",
    "STAT_FLTTIME",  "STAT_RUNTIME",     "SERIAL0_BAUD",    "SERIAL0_PROTOCOL", "MAV_SYSID",        "MAV_GCS_SYSID",
});
std::vector<ParameterInfo> rows_of(Personality personality, AirframeType type) {
  const bool is_px4 = personality == Personality::px4;
  const auto copter = is_px4 ? std::span<const ParameterInfo>{px4_copter} : std::span<const ParameterInfo>{arducopter};
  std::vector<ParameterInfo> rows{copter.begin(), copter.end()};
  const auto change = [&](std::string_view name, double value) {
    if (const auto found = std::ranges::find(rows, name, &ParameterInfo::name); found != rows.end())
      found->default_value = value;
  };
  for (const auto& [name, value] : firmware_defaults) change(name, value);
  if (type == AirframeType::copter) return rows;
  if (is_px4) {
    change("MAV_TYPE", messages::MAV_TYPE_FIXED_WING);
    return rows;
  }
  const auto is_copters = [](const ParameterInfo& each) {
    return std::ranges::find(of_ardupilot_planes, each.name) == of_ardupilot_planes.end();
  };
  std::erase_if(rows, is_copters);
  return rows;
}

ParameterTable table_of(Personality personality, AirframeType type) {
  ParameterTable table{.rows = rows_of(personality, type), .by_name = {}};
  table.by_name.resize(table.rows.size());
  std::iota(table.by_name.begin(), table.by_name.end(), std::size_t{});
  std::ranges::sort(table.by_name, {}, [&](std::size_t index) { return table.rows[index].name; });
  return table;
}

}  // namespace

const ParameterTable& parameter_table(Personality personality, AirframeType type) {
  using enum Personality;
  using enum AirframeType;
  static const std::array ardupilots{table_of(ardupilot, copter), table_of(ardupilot, plane)};
  static const std::array px4s{table_of(px4, copter), table_of(px4, plane)};
  return (personality == px4 ? px4s : ardupilots)[type == plane ? 1 : 0];
}

}  // namespace ponte::sim
