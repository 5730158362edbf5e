#include "ponte/sim/telemetry_messages.hpp"

namespace ponte::sim {
namespace {

constexpr double millimetres = 1e3;
constexpr double centimetres = 1e2;
constexpr double milli_gravity = 1e3 / standard_gravity;
constexpr double hundredths = 1e2;
constexpr double zero_celsius = 273.15;

/// Hundredths of a degree, 0 to 35999.
std::uint16_t compass_hundredths(double radians) {
  return static_cast<std::uint16_t>(scaled<std::uint32_t>(compass_degrees(radians), hundredths) % 36000);
}

double speed(const NorthEastDown& velocity) {
  return std::sqrt(velocity.north * velocity.north + velocity.east * velocity.east + velocity.down * velocity.down);
}

/// RAW_IMU and SCALED_IMU have the same sensor values in the same units.
template <class Imu>
void fill_imu(const Readings& readings, Imu& message) {
  constexpr double thousandths = 1e3;
  message.xacc = scaled<std::int16_t>(readings.specific_force.x, milli_gravity);
  message.yacc = scaled<std::int16_t>(readings.specific_force.y, milli_gravity);
  message.zacc = scaled<std::int16_t>(readings.specific_force.z, milli_gravity);
  message.xgyro = scaled<std::int16_t>(readings.rates.x, thousandths);
  message.ygyro = scaled<std::int16_t>(readings.rates.y, thousandths);
  message.zgyro = scaled<std::int16_t>(readings.rates.z, thousandths);
  message.xmag = scaled<std::int16_t>(readings.magnetic_field.x, thousandths);
  message.ymag = scaled<std::int16_t>(readings.magnetic_field.y, thousandths);
  message.zmag = scaled<std::int16_t>(readings.magnetic_field.z, thousandths);
  message.temperature = 3500;  // 35 degrees Celsius, on the board
}

}  // namespace

messages::Attitude attitude_message(const Snapshot& snapshot) {
  const auto& attitude = snapshot.readings.attitude;
  const auto& rates = snapshot.readings.rates;
  return {
      .time_boot_ms = boot_ms(snapshot),
      .roll = static_cast<float>(attitude.roll.value),
      .pitch = static_cast<float>(attitude.pitch.value),
      .yaw = static_cast<float>(attitude.heading.value),
      .rollspeed = static_cast<float>(rates.x),
      .pitchspeed = static_cast<float>(rates.y),
      .yawspeed = static_cast<float>(rates.z),
  };
}

messages::AttitudeQuaternion attitude_quaternion(const Snapshot& snapshot) {
  const auto& attitude = snapshot.readings.attitude;
  const auto& rates = snapshot.readings.rates;
  const double roll = attitude.roll.value / 2;
  const double pitch = attitude.pitch.value / 2;
  const double heading = attitude.heading.value / 2;
  const double cr = std::cos(roll), sr = std::sin(roll);
  const double cp = std::cos(pitch), sp = std::sin(pitch);
  const double ch = std::cos(heading), sh = std::sin(heading);
  return {
      .time_boot_ms = boot_ms(snapshot),
      .q1 = static_cast<float>(cr * cp * ch + sr * sp * sh),
      .q2 = static_cast<float>(sr * cp * ch - cr * sp * sh),
      .q3 = static_cast<float>(cr * sp * ch + sr * cp * sh),
      .q4 = static_cast<float>(cr * cp * sh - sr * sp * ch),
      .rollspeed = static_cast<float>(rates.x),
      .pitchspeed = static_cast<float>(rates.y),
      .yawspeed = static_cast<float>(rates.z),
  };
}

/// Before there is a position, only the heading is known.
messages::GlobalPositionInt global_position(const Snapshot& snapshot) {
  const auto& position = snapshot.readings.position;
  const auto& velocity = snapshot.readings.velocity;
  messages::GlobalPositionInt message{
      .time_boot_ms = boot_ms(snapshot),
      .hdg = compass_hundredths(snapshot.readings.attitude.heading.value),
  };
  if (!snapshot.has_position) return message;
  message.lat = degrees_e7(position.latitude);
  message.lon = degrees_e7(position.longitude);
  message.alt = scaled<std::int32_t>(position.altitude_msl.value, millimetres);
  message.relative_alt =
      scaled<std::int32_t>(position.altitude_msl.value - snapshot.home.altitude_msl.value, millimetres);
  message.vx = scaled<std::int16_t>(velocity.north, centimetres);
  message.vy = scaled<std::int16_t>(velocity.east, centimetres);
  message.vz = scaled<std::int16_t>(velocity.down, centimetres);
  return message;
}

std::optional<messages::LocalPositionNed> local_position(const Snapshot& snapshot) {
  if (!snapshot.has_position) return std::nullopt;
  const auto offset = offset_between(snapshot.origin, snapshot.readings.position);
  const auto& velocity = snapshot.readings.velocity;
  return messages::LocalPositionNed{
      .time_boot_ms = boot_ms(snapshot),
      .x = static_cast<float>(offset.north),
      .y = static_cast<float>(offset.east),
      .z = static_cast<float>(offset.down),
      .vx = static_cast<float>(velocity.north),
      .vy = static_cast<float>(velocity.east),
      .vz = static_cast<float>(velocity.down),
  };
}

/// Without an airspeed sensor and without wind, ArduCopter tells the speed through the air, climb included.
messages::VfrHud vfr_hud(const Snapshot& snapshot) {
  const auto& readings = snapshot.readings;
  messages::VfrHud message{
      .heading = static_cast<std::int16_t>(compass_degrees(readings.attitude.heading.value)),
      .throttle = scaled<std::uint16_t>(snapshot.throttle, 100),
  };
  if (!snapshot.has_position) return message;
  message.airspeed = static_cast<float>(speed(readings.velocity));
  message.groundspeed = static_cast<float>(horizontal(readings.velocity));
  message.alt = static_cast<float>(readings.position.altitude_msl.value);
  message.climb = static_cast<float>(-readings.velocity.down);
  return message;
}

messages::GpsRawInt gps_raw(const Snapshot& snapshot) {
  const auto& [fix, at, reading] = snapshot.satellites;
  constexpr std::uint16_t unknown = 65535;
  messages::GpsRawInt message{.fix_type = static_cast<std::uint8_t>(fix), .eph = unknown, .epv = unknown};
  if (fix == SatelliteFix::no_receiver) return message;
  message.time_usec = microseconds(at);
  const auto& [position, velocity] = reading;
  if (fix == SatelliteFix::none) {  // where it last saw them, if it ever did
    message.lat = degrees_e7(position.latitude);
    message.lon = degrees_e7(position.longitude);
    return message;
  }

  const bool is_full = fix == SatelliteFix::full;
  message.lat = degrees_e7(position.latitude);
  message.lon = degrees_e7(position.longitude);
  message.alt = scaled<std::int32_t>(position.altitude_msl.value, millimetres);
  message.alt_ellipsoid = message.alt;
  message.eph = is_full ? 121 : 480;  // hundredths
  message.epv = is_full ? 200 : unknown;
  message.vel = scaled<std::uint16_t>(horizontal(velocity), centimetres);
  message.cog = compass_hundredths(std::atan2(velocity.east, velocity.north));
  message.satellites_visible = is_full ? 10 : 4;
  message.h_acc = is_full ? 300 : 4000;  // mm
  message.v_acc = is_full ? 300 : 0;
  message.vel_acc = is_full ? 50 : 0;  // mm/s
  return message;
}

messages::RawImu raw_imu(const Snapshot& snapshot) {
  messages::RawImu message{.time_usec = microseconds(snapshot.since_boot)};
  fill_imu(snapshot.readings, message);
  return message;
}

messages::ScaledImu scaled_imu(const Snapshot& snapshot) {
  messages::ScaledImu message{.time_boot_ms = boot_ms(snapshot)};
  fill_imu(snapshot.readings, message);
  return message;
}

messages::ScaledPressure scaled_pressure(const Snapshot& snapshot) {
  constexpr double hectopascals = 1e-2;
  return {
      .time_boot_ms = boot_ms(snapshot),
      .press_abs = static_cast<float>(snapshot.readings.static_pressure.value * hectopascals),
      .temperature = scaled<std::int16_t>(snapshot.readings.air_temperature.value - zero_celsius, hundredths),
  };
}

/// Of still air, ArduPilot tells this direction.
std::optional<messages::Wind> wind(const Snapshot& snapshot) {
  if (!snapshot.has_position) return std::nullopt;
  const auto& wind = snapshot.wind;
  return messages::Wind{.direction = static_cast<float>(std::atan2(-wind.east, -wind.north) * degrees_per_radian),
                        .speed = static_cast<float>(horizontal(wind))};
}

}  // namespace ponte::sim
