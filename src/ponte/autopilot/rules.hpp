#pragma once

#include "ponte/autopilot/mapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

/// The rules that the rows of telemetry_rows.hpp name.
namespace ponte::autopilot::rules {

inline constexpr double standard_gravity = 9.80665;
inline constexpr double gas_constant_of_dry_air = 287.05287;  ///< J/(kg K)
inline constexpr double standard_sea_level_density = 1.225;   ///< kg/m^3
/// Nearer to the vertical than about 3 degrees, roll and heading turn into each other: their rates grow without limit,
/// and the rate of pitch, which needs the roll, loses its meaning too.
inline constexpr double smallest_cosine_of_pitch = 0.05;
/// An attitude older than this says nothing about an acceleration.
inline constexpr std::chrono::milliseconds attitude_lifetime{500};
/// Pressure and temperature older than this say nothing about the air.
inline constexpr std::chrono::seconds air_lifetime{5};

/// Whether the facts are known from one sample, taken no longer than `lifetime` before or after `at`. A sample that
/// leaves one of them out makes the others newer than it.
[[nodiscard]] bool known_together(WallTime at, Duration lifetime, const auto& first, const auto&... others) {
  return first && std::chrono::abs(at - first.at()) <= lifetime && ((others && others.at() == first.at()) && ...);
}

/// A float, or nothing when it is NaN or infinite; times `factor`.
template <class Q>
constexpr auto scaled(double factor) {
  return [factor](float value) -> std::optional<Q> {
    if (!std::isfinite(value)) return std::nullopt;
    return Q{static_cast<double>(value) * factor};
  };
}

/// An integer that is never "unknown", times `factor`.
template <class Q>
constexpr auto counted(double factor) {
  return [factor](std::integral auto value) -> std::optional<Q> { return Q{static_cast<double>(value) * factor}; };
}

inline constexpr double radians_per_degree = std::numbers::pi / 180;

inline constexpr Rule radians{"rad", scaled<Radians>(1)};
inline constexpr Rule degrees{"deg to rad", scaled<Radians>(radians_per_degree)};
inline constexpr Rule metres{"m", scaled<Metres>(1)};
inline constexpr Rule metres_per_second{"m/s", scaled<MetresPerSecond>(1)};
inline constexpr Rule millimetres{"mm / 1000", counted<Metres>(1e-3)};
inline constexpr Rule milli_gravity{"mG * 9.80665 / 1000", counted<MetresPerSecondSquared>(standard_gravity * 1e-3)};
inline constexpr Rule milliradians_per_second{"mrad/s / 1000", counted<RadiansPerSecond>(1e-3)};

// --- attitude -------------------------------------------------------------------------------------------------------

inline constexpr Rule euler_roll_rate{
    "p + tan(pitch) (q sin(roll) + r cos(roll)); nothing near the vertical",
    [](float p, float q, float r, float roll, float pitch) -> std::optional<RadiansPerSecond> {
      if (!(std::cos(double{pitch}) > smallest_cosine_of_pitch)) return std::nullopt;
      const double rate = double{p} + std::tan(double{pitch}) *
                                          (double{q} * std::sin(double{roll}) + double{r} * std::cos(double{roll}));
      if (!std::isfinite(rate)) return std::nullopt;
      return RadiansPerSecond{rate};
    }};

inline constexpr Rule euler_pitch_rate{
    "q cos(roll) - r sin(roll); nothing near the vertical",
    [](float q, float r, float roll, float pitch) -> std::optional<RadiansPerSecond> {
      if (!(std::cos(double{pitch}) > smallest_cosine_of_pitch)) return std::nullopt;
      const double rate = double{q} * std::cos(double{roll}) - double{r} * std::sin(double{roll});
      if (!std::isfinite(rate)) return std::nullopt;
      return RadiansPerSecond{rate};
    }};

inline constexpr Rule euler_turn_rate{"(q sin(roll) + r cos(roll)) / cos(pitch); nothing near the vertical",
                                      [](float q, float r, float roll, float pitch) -> std::optional<RadiansPerSecond> {
                                        if (!(std::cos(double{pitch}) > smallest_cosine_of_pitch)) return std::nullopt;
                                        const double rate =
                                            (double{q} * std::sin(double{roll}) + double{r} * std::cos(double{roll})) /
                                            std::cos(double{pitch});
                                        if (!std::isfinite(rate)) return std::nullopt;
                                        return RadiansPerSecond{rate};
                                      }};

// --- position: autopilots send latitude 0, longitude 0 until they have one
// ---------------------------------------------

/// The integer times `factor`, unless latitude and longitude say that there is no position.
template <class Q>
constexpr auto with_position(double factor) {
  return [factor](std::integral auto value, std::int32_t latitude, std::int32_t longitude) -> std::optional<Q> {
    if (latitude == 0 && longitude == 0) return std::nullopt;
    return Q{static_cast<double>(value) * factor};
  };
}

inline constexpr Rule degrees_e7{"degE7 to rad; nothing at 0, 0: no position yet",
                                 with_position<Radians>(1e-7 * radians_per_degree)};
inline constexpr Rule millimetres_with_position{"mm / 1000; nothing without a position", with_position<Metres>(1e-3)};
inline constexpr Rule centimetres_per_second_with_position{"cm/s / 100; nothing without a position",
                                                           with_position<MetresPerSecond>(1e-2)};

inline constexpr Rule ellipsoid_height{"mm / 1000; nothing without a 3D fix, and 0: not told",
                                       [](std::int32_t height, std::uint8_t fix) -> std::optional<Metres> {
                                         constexpr std::uint8_t fix_3d = 3;
                                         if (height == 0 || fix < fix_3d) return std::nullopt;
                                         return Metres{height * 1e-3};
                                       }};

inline constexpr Rule downward_rangefinder{
    "cm / 100; nothing unless it looks down, is within its range and trusts its signal",
    [](std::uint16_t distance, std::uint8_t orientation, std::uint16_t nearest, std::uint16_t farthest,
       std::uint8_t quality) -> std::optional<Metres> {
      constexpr std::uint8_t downward = 25;       // MAV_SENSOR_ROTATION_PITCH_270
      constexpr std::uint8_t invalid_signal = 1;  // 0 is "not told"
      if (orientation != downward || distance < nearest || distance > farthest || quality == invalid_signal)
        return std::nullopt;
      return Metres{distance * 1e-2};
    }};

inline constexpr Rule height_over_terrain{"m; nothing below -1000: not known",
                                          [](float height) -> std::optional<Metres> {
                                            if (!std::isfinite(height) || height < -1000) return std::nullopt;
                                            return Metres{height};
                                          }};

inline constexpr Rule terrain_database_height{"m; nothing where the terrain is not loaded (spacing 0)",
                                              [](float height, std::uint16_t spacing) -> std::optional<Metres> {
                                                if (spacing == 0 || !std::isfinite(height)) return std::nullopt;
                                                return Metres{height};
                                              }};

// --- air
// ----------------------------------------------------------------------------------------------------------------

/// Multirotors without a sensor report an airspeed of exactly 0, and so may a vehicle that has not said what it is.
[[nodiscard]] inline bool airspeed_is_told(const MappingContext& context, float airspeed) {
  constexpr std::array<std::uint8_t, 8> rotorcraft{2, 3, 4, 13, 14, 15, 29, 35};  // MAV_TYPE
  const auto& identity = context.state.identity;
  const bool may_lack_a_sensor =
      !identity || std::ranges::find(rotorcraft, identity.value().airframe) != rotorcraft.end();
  return std::isfinite(airspeed) && airspeed >= 0 && !(airspeed == 0 && may_lack_a_sensor);
}

inline constexpr Rule indicated_airspeed{
    "m/s; nothing at 0 from a rotorcraft: no sensor",
    [](const MappingContext& context, float airspeed) -> std::optional<MetresPerSecond> {
      if (!airspeed_is_told(context, airspeed)) return std::nullopt;
      return MetresPerSecond{airspeed};
    }};

inline constexpr Rule true_airspeed{
    "airspeed sqrt(1.225 R T / p) from pressure and temperature of one sample; nothing without them, or after 5 s",
    [](const MappingContext& context, float airspeed) -> std::optional<MetresPerSecond> {
      const auto& [state, at] = context;
      if (!airspeed_is_told(context, airspeed)) return std::nullopt;
      if (!known_together(at, air_lifetime, state.static_pressure, state.air_temperature)) return std::nullopt;
      const double density =
          state.static_pressure.value().value / (gas_constant_of_dry_air * state.air_temperature.value().value);
      return MetresPerSecond{double{airspeed} * std::sqrt(standard_sea_level_density / density)};
    }};

inline constexpr Rule hectopascals{"hPa * 100; nothing at 0 or below", [](float pressure) -> std::optional<Pascals> {
                                     if (!std::isfinite(pressure) || pressure <= 0) return std::nullopt;
                                     return Pascals{double{pressure} * 100};
                                   }};

inline constexpr Rule standard_atmosphere_altitude{
    "44330.77 (1 - (p / 1013.25 hPa)^0.190263)", [](float pressure) -> std::optional<Metres> {
      if (!std::isfinite(pressure) || pressure <= 0) return std::nullopt;
      return Metres{44330.77 * (1 - std::pow(double{pressure} / 1013.25, 0.190263))};
    }};

inline constexpr Rule centi_celsius{"cdegC / 100 + 273.15; nothing at absolute zero or below",
                                    [](std::int16_t temperature) -> std::optional<Kelvins> {
                                      constexpr std::int16_t absolute_zero = -27315;
                                      if (temperature <= absolute_zero) return std::nullopt;
                                      return Kelvins{temperature * 1e-2 + 273.15};
                                    }};

/// Component of a wind that blows *from* `direction` degrees.
inline constexpr Rule north_of_wind{
    "-speed cos(direction it blows from)", [](float speed, float direction) -> std::optional<MetresPerSecond> {
      const double wind = -double{speed} * std::cos(double{direction} * radians_per_degree);
      if (!std::isfinite(wind)) return std::nullopt;
      return MetresPerSecond{wind};
    }};
inline constexpr Rule east_of_wind{
    "-speed sin(direction it blows from)", [](float speed, float direction) -> std::optional<MetresPerSecond> {
      const double wind = -double{speed} * std::sin(double{direction} * radians_per_degree);
      if (!std::isfinite(wind)) return std::nullopt;
      return MetresPerSecond{wind};
    }};

// --- inertial sensors
// ---------------------------------------------------------------------------------------------------

/// A HIGHRES_IMU value whose bit in fields_updated is set. The values of several IMUs do not mix: the first one counts.
template <class Q, std::uint16_t Bit>
inline constexpr Rule updated{"as sent; nothing when fields_updated leaves it out, and from other IMUs than the first",
                              [](float value, std::uint16_t fields_updated, std::uint8_t imu) -> std::optional<Q> {
                                if ((fields_updated & Bit) == 0 || imu != 0 || !std::isfinite(value))
                                  return std::nullopt;
                                return Q{value};
                              }};

enum class Axis : std::uint8_t { north, east, down };

/// Component of a sensed acceleration (m/s^2, body axes) in Earth axes with gravity removed, by the newest attitude.
[[nodiscard]] inline std::optional<MetresPerSecondSquared> earth_acceleration(const MappingContext& context, Axis axis,
                                                                              double x, double y, double z) {
  const auto& [state, at] = context;
  if (!known_together(at, attitude_lifetime, state.roll, state.pitch, state.heading)) return std::nullopt;
  const double roll = state.roll.value().value;
  const double pitch = state.pitch.value().value;
  const double heading = state.heading.value().value;
  // Level the sensor first: along the nose's horizontal track, to its right, and down.
  const double across = y * std::sin(roll) + z * std::cos(roll);
  const double ahead = x * std::cos(pitch) + across * std::sin(pitch);
  const double right = y * std::cos(roll) - z * std::sin(roll);
  const double down = -x * std::sin(pitch) + across * std::cos(pitch);
  double result{};
  switch (axis) {
    case Axis::north: result = ahead * std::cos(heading) - right * std::sin(heading); break;
    case Axis::east: result = ahead * std::sin(heading) + right * std::cos(heading); break;
    case Axis::down: result = down + standard_gravity; break;
  }
  if (!std::isfinite(result)) return std::nullopt;
  return MetresPerSecondSquared{result};
}

template <Axis A>
inline constexpr Rule earth_acceleration_from_si{
    "turned into Earth axes by the newest attitude, gravity removed; first IMU only",
    [](const MappingContext& context, float x, float y, float z, std::uint16_t fields_updated,
       std::uint8_t imu) -> std::optional<MetresPerSecondSquared> {
      constexpr std::uint16_t accelerometer = 7;
      if ((fields_updated & accelerometer) != accelerometer || imu != 0) return std::nullopt;
      return earth_acceleration(context, A, double{x}, double{y}, double{z});
    }};

template <Axis A>
inline constexpr Rule earth_acceleration_from_milli_gravity{
    "mG turned into Earth axes by the newest attitude, gravity removed",
    [](const MappingContext& context, std::int16_t x, std::int16_t y,
       std::int16_t z) -> std::optional<MetresPerSecondSquared> {
      constexpr double unit = standard_gravity * 1e-3;
      return earth_acceleration(context, A, x * unit, y * unit, z * unit);
    }};

// --- what the autopilot is trying to do
// -----------------------------------------------------------------------------------

/// True while the autopilot itself steers, so that its navigation outputs mean something.
[[nodiscard]] inline bool navigates(const MappingContext& context) {
  using enum vehicle::ModeKind;
  const auto& mode = context.state.mode;
  return mode && mode.value().kind != none && mode.value().kind != manual && mode.value().kind != other;
}

inline constexpr Rule navigation_bearing{
    "deg to rad; nothing unless the autopilot navigates",
    [](const MappingContext& context, std::int16_t bearing) -> std::optional<Radians> {
      if (!navigates(context)) return std::nullopt;
      return Radians{bearing * radians_per_degree};
    }};

inline constexpr Rule navigation_roll{"deg to rad; nothing unless the autopilot navigates",
                                      [](const MappingContext& context, float roll) -> std::optional<Radians> {
                                        if (!navigates(context) || !std::isfinite(roll)) return std::nullopt;
                                        return Radians{double{roll} * radians_per_degree};
                                      }};

inline constexpr Rule arrival{
    "now + distance / ground speed; nothing while slower than 0.5 m/s, and in all modes but the mission's: the "
    "distance is "
    "not to a waypoint then",
    [](const MappingContext& context, std::uint16_t distance_m) -> std::optional<WallTime> {
      constexpr double slowest = 0.5;
      const auto& [state, at] = context;
      const bool flies_mission = state.mode && state.mode.value().kind == vehicle::ModeKind::mission;
      if (!flies_mission || !state.north_speed || !state.east_speed) return std::nullopt;
      const double speed = std::hypot(state.north_speed.value().value, state.east_speed.value().value);
      if (!(speed > slowest)) return std::nullopt;
      return at + std::chrono::milliseconds{std::llround(distance_m / speed * 1000)};
    }};

namespace position_target {
inline constexpr std::uint16_t ignore_z = 4;
inline constexpr std::uint16_t ignore_yaw = 1024;
}  // namespace position_target

inline constexpr Rule target_altitude{
    "m, plus home for heights above home; nothing when masked",
    [](const MappingContext& context, float altitude, std::uint8_t frame, std::uint16_t mask) -> std::optional<Metres> {
      if ((mask & position_target::ignore_z) != 0 || !std::isfinite(altitude)) return std::nullopt;
      if (frame == 0 || frame == 5) return Metres{altitude};  // MAV_FRAME_GLOBAL(_INT)
      const auto& home = context.state.home_altitude_msl;
      if ((frame == 3 || frame == 6) && home) return Metres{double{altitude} + home.value().value};  // relative to home
      return std::nullopt;
    }};

inline constexpr Rule target_height{
    "m above terrain; nothing in another frame or when masked",
    [](float altitude, std::uint8_t frame, std::uint16_t mask) -> std::optional<Metres> {
      if ((mask & position_target::ignore_z) != 0 || !std::isfinite(altitude)) return std::nullopt;
      if (frame != 10 && frame != 11) return std::nullopt;  // MAV_FRAME_GLOBAL_TERRAIN_ALT(_INT)
      return Metres{altitude};
    }};

inline constexpr Rule target_yaw{"rad; nothing when masked",
                                 [](float yaw, std::uint16_t mask) -> std::optional<Radians> {
                                   if ((mask & position_target::ignore_yaw) != 0 || !std::isfinite(yaw))
                                     return std::nullopt;
                                   return Radians{yaw};
                                 }};

/// True when ATTITUDE_TARGET tells an attitude. A quaternion of zeros is none, NaN neither.
[[nodiscard]] inline bool attitude_is_told(const std::array<float, 4>& q, std::uint8_t mask) {
  constexpr std::uint8_t ignore_attitude = 128;
  constexpr float smallest_square = 0.5F;
  return (mask & ignore_attitude) == 0 && q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > smallest_square;
}

inline constexpr Rule roll_of_quaternion{
    "roll of the attitude; nothing when masked or without a quaternion",
    [](const std::array<float, 4>& q, std::uint8_t mask) -> std::optional<Radians> {
      if (!attitude_is_told(q, mask)) return std::nullopt;
      const double w = double{q[0]}, x = double{q[1]}, y = double{q[2]}, z = double{q[3]};
      const double roll = std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
      if (!std::isfinite(roll)) return std::nullopt;
      return Radians{roll};
    }};

inline constexpr Rule heading_of_quaternion{
    "heading of the attitude; nothing when masked or without a quaternion",
    [](const std::array<float, 4>& q, std::uint8_t mask) -> std::optional<Radians> {
      if (!attitude_is_told(q, mask)) return std::nullopt;
      const double w = double{q[0]}, x = double{q[1]}, y = double{q[2]}, z = double{q[3]};
      const double heading = std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
      if (!std::isfinite(heading)) return std::nullopt;
      return Radians{heading};
    }};

// --- power
// ----------------------------------------------------------------------------------------------------------------

inline constexpr Rule throttle{"%", counted<Percent>(1)};

inline constexpr Rule remaining{"%; nothing at -1: not known", [](std::int8_t percent) -> std::optional<Percent> {
                                  if (percent < 0) return std::nullopt;
                                  return Percent{static_cast<double>(percent)};
                                }};

inline constexpr Rule remaining_of_first{"%; nothing at -1: not known, and from other batteries than the first",
                                         [](std::int8_t percent, std::uint8_t battery) -> std::optional<Percent> {
                                           if (percent < 0 || battery != 0) return std::nullopt;
                                           return Percent{static_cast<double>(percent)};
                                         }};

}  // namespace ponte::autopilot::rules
