#include "ponte/sim/failsafe_settings.hpp"

#include "ponte/sim/seconds.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace ponte::sim {
namespace {

using enum FailsafeAction;

/// The action of each number, from 0 on; a number beyond has the last one.
template <std::size_t N>
FailsafeAction action_of(double number, const std::array<FailsafeAction, N>& actions) {
  if (!(number > 0)) return actions.front();
  return actions[std::min(static_cast<std::size_t>(number), N - 1)];
}

// A way back along the track is not flown here: it is the straight one. A brake is a landing at once.
constexpr std::array copter_battery{none, land, rtl, rtl, land, terminate, rtl, land};
constexpr std::array plane_battery{none, rtl, land, terminate, land, terminate, land, rtl};
constexpr std::array ardupilot_station{none, rtl, rtl, rtl, land, land, rtl, land};
constexpr std::array ardupilot_fence{warn, rtl, land, rtl, land, land, hold, hold, rtl};
constexpr std::array ardupilot_position{warn, land, hold, land};
constexpr std::array px4_station{none, hold, rtl, land, land, terminate, terminate};
constexpr std::array px4_fence{none, warn, hold, rtl, terminate, land};

double value_of(const Parameters& parameters, std::string_view name) {
  const auto index = parameters.find(name);
  return index ? parameters.value(*index) : 0;
}

FailsafeSettings of_px4(const Parameters& parameters) {
  const auto value = [&](std::string_view name) { return value_of(parameters, name); };
  const auto low_battery = value("COM_LOW_BAT_ACT");
  const auto limit = [&](std::string_view name) {
    const double metres = value(name);
    return metres > 0 ? std::optional{Metres{metres}} : std::nullopt;
  };
  return {
      .low_share = value("BAT_LOW_THR"),
      .critical_share = value("BAT_CRIT_THR"),
      .emergency_share = value("BAT_EMERGEN_THR"),
      .low = warn,
      .critical = action_of(low_battery, std::array{warn, warn, land, rtl}),
      .emergency = action_of(low_battery, std::array{warn, warn, land, land}),
      .station_time_out = seconds_from(value("COM_DL_LOSS_T")),
      .station = action_of(value("NAV_DLL_ACT"), px4_station),
      .position = land,
      .fence = {.is_enabled = value("GF_ACTION") > 0,
                .most_height = limit("GF_MAX_VER_DIST"),
                .most_radius = limit("GF_MAX_HOR_DIST"),
                .heeds_uploaded = true},
      .breach = action_of(value("GF_ACTION"), px4_fence),
      .hold_first = seconds_from(value("COM_FAIL_ACT_T")),
  };
}

FailsafeSettings of_ardupilot(AirframeType type, const Parameters& parameters) {
  const auto value = [&](std::string_view name) { return value_of(parameters, name); };
  const auto battery_action = [&](std::string_view name) {
    return type == AirframeType::plane ? action_of(value(name), plane_battery) : action_of(value(name), copter_battery);
  };
  constexpr double milli = 1e-3;
  const auto fences = static_cast<unsigned>(value("FENCE_TYPE"));
  FenceSettings fence{.is_enabled = value("FENCE_ENABLE") > 0, .heeds_uploaded = (fences & 4U) != 0};
  if ((fences & 1U) != 0) fence.most_height = Metres{value("FENCE_ALT_MAX")};
  if ((fences & 2U) != 0) fence.most_radius = Metres{value("FENCE_RADIUS")};
  return {
      .low_volts = value("BATT_LOW_VOLT"),
      .critical_volts = value("BATT_CRT_VOLT"),
      .low_volts_last = seconds_from(value("BATT_LOW_TIMER")),
      .low_ampere_hours = value("BATT_LOW_MAH") * milli,
      .critical_ampere_hours = value("BATT_CRT_MAH") * milli,
      .low = battery_action("BATT_FS_LOW_ACT"),
      .critical = battery_action("BATT_FS_CRT_ACT"),
      .station_time_out = seconds_from(value("FS_GCS_TIMEOUT")),
      .station = action_of(value("FS_GCS_ENABLE"), ardupilot_station),
      .position = type == AirframeType::plane ? none : action_of(value("FS_EKF_ACTION"), ardupilot_position),
      .fence = fence,
      .breach = action_of(value("FENCE_ACTION"), ardupilot_fence),
  };
}

}  // namespace

FailsafeSettings failsafe_settings(VehicleKind kind, const Parameters& parameters) {
  return kind.personality == Personality::px4 ? of_px4(parameters) : of_ardupilot(kind.type, parameters);
}

}  // namespace ponte::sim
