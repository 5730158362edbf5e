#include "ponte/sim/flight_settings.hpp"

#include "ponte/sim/seconds.hpp"

#include <optional>
#include <string_view>

namespace ponte::sim {
namespace {

using std::chrono::seconds;

constexpr FlightSettings ardu_copter{
    .cruise_speed = MetresPerSecond{10},
    .acceptance_radius = Metres{2},
    .loiter_radius = Metres{10},
    .take_off_height = Metres{10},
    .mode_takes_off = false,
    .return_height = Metres{15},
    .return_cone_slope = 3,
    .return_speed = MetresPerSecond{10},
    .return_wait = seconds{5},
    .guided_time_out = seconds{3},
    .disarms_idle_after = seconds{10},
    .disarms_landed_after = seconds{1},
};

constexpr FlightSettings ardu_plane{
    .cruise_speed = MetresPerSecond{22},
    .acceptance_radius = Metres{50},
    .loiter_radius = Metres{60},
    .take_off_height = Metres{50},
    .mode_takes_off = true,
    .return_height = Metres{100},
    .return_cone_slope = 0,
    .return_speed = MetresPerSecond{22},
    .return_wait = {},
    .guided_time_out = {},
    .disarms_idle_after = {},
    .disarms_landed_after = seconds{20},
};

constexpr FlightSettings px4_copter{
    .cruise_speed = MetresPerSecond{5},
    .acceptance_radius = Metres{10},
    .loiter_radius = Metres{80},
    .take_off_height = Metres{2.5},
    .mode_takes_off = true,
    .return_height = Metres{30},
    .return_cone_slope = 1,
    .return_speed = MetresPerSecond{5},
    .return_wait = {},
    .guided_time_out = seconds{1},
    .disarms_idle_after = seconds{10},
    .disarms_landed_after = seconds{2},
};

constexpr FlightSettings px4_plane{
    .cruise_speed = MetresPerSecond{15},
    .acceptance_radius = Metres{10},
    .loiter_radius = Metres{80},
    .take_off_height = Metres{30},
    .mode_takes_off = true,
    .return_height = Metres{60},
    .return_cone_slope = 0,
    .return_speed = MetresPerSecond{15},
    .return_wait = {},
    .guided_time_out = seconds{1},
    .disarms_idle_after = seconds{10},
    .disarms_landed_after = seconds{2},
};

}  // namespace

FlightSettings default_flight_settings(VehicleKind kind) {
  const bool is_plane = kind.type == AirframeType::plane;
  if (kind.personality == Personality::px4) return is_plane ? px4_plane : px4_copter;
  return is_plane ? ardu_plane : ardu_copter;
}

FlightSettings flight_settings(VehicleKind kind, const Parameters& parameters) {
  auto settings = default_flight_settings(kind);
  const auto find = [&](std::string_view name) -> std::optional<double> {
    const auto index = parameters.find(name);
    return index ? std::optional{parameters.value(*index)} : std::nullopt;
  };
  const auto take = [&](std::string_view name, double unit, auto& quantity) {
    if (const auto value = find(name)) quantity.value = *value * unit;
  };
  const auto take_time = [&](std::string_view name, double unit, Duration& duration) {
    if (const auto value = find(name)) duration = seconds_from(*value * unit);
  };
  constexpr double centi = 1e-2;
  constexpr double milli = 1e-3;
  const bool is_plane = kind.type == AirframeType::plane;
  if (kind.personality == Personality::px4) {
    take(is_plane ? "FW_AIRSPD_TRIM" : "MPC_XY_CRUISE", 1, settings.cruise_speed);
    settings.return_speed = settings.cruise_speed;
    take("NAV_ACC_RAD", 1, settings.acceptance_radius);
    take("NAV_LOITER_RAD", 1, settings.loiter_radius);
    take("MIS_TAKEOFF_ALT", 1, settings.take_off_height);
    take("RTL_RETURN_ALT", 1, settings.return_height);
    take_time("RTL_LAND_DELAY", 1, settings.return_wait);
    take_time("COM_OF_LOSS_T", 1, settings.guided_time_out);
    take_time("COM_DISARM_PRFLT", 1, settings.disarms_idle_after);
    take_time("COM_DISARM_LAND", 1, settings.disarms_landed_after);
    return settings;
  }
  if (is_plane) {
    take("AIRSPEED_CRUISE", 1, settings.cruise_speed);
    settings.return_speed = settings.cruise_speed;
    take("WP_RADIUS", 1, settings.acceptance_radius);
    take("WP_LOITER_RAD", 1, settings.loiter_radius);
    take("TKOFF_ALT", 1, settings.take_off_height);
    take("RTL_ALTITUDE", 1, settings.return_height);
    take_time("LAND_DISARMDELAY", 1, settings.disarms_landed_after);
    return settings;
  }
  take("WPNAV_SPEED", centi, settings.cruise_speed);
  take("RTL_SPEED", centi, settings.return_speed);
  if (settings.return_speed.value <= 0) settings.return_speed = settings.cruise_speed;
  take("WPNAV_RADIUS", centi, settings.acceptance_radius);
  take("CIRCLE_RADIUS", centi, settings.loiter_radius);
  if (const auto options = find("AUTO_OPTIONS")) settings.mode_takes_off = (static_cast<unsigned>(*options) & 2U) != 0;
  take("RTL_ALT", centi, settings.return_height);
  if (const auto slope = find("RTL_CONE_SLOPE")) settings.return_cone_slope = *slope;
  take_time("RTL_LOIT_TIME", milli, settings.return_wait);
  take_time("GUID_TIMEOUT", 1, settings.guided_time_out);
  take_time("DISARM_DELAY", 1, settings.disarms_idle_after);
  return settings;
}

}  // namespace ponte::sim
