#include "ponte/sim/sensors.hpp"

#include "ponte/sim/random.hpp"

#include <cmath>

namespace ponte::sim {
namespace {

/// Where the errors of an instrument begin among those of a step; a vector takes three.
enum Channel : std::uint64_t {
  position_channel = 0,
  velocity_channel = 3,
  attitude_channel = 6,
  rates_channel = 9,
  force_channel = 12,
  field_channel = 15,
  pressure_channel = 18,
  satellite_position_channel = 19,
  satellite_velocity_channel = 22,
  channels_per_step = 32,
};

// Standard deviations. The first three are those of an estimator, which has smoothed its instruments.
constexpr double position_deviation = 0.02;            // m
constexpr double velocity_deviation = 0.01;            // m/s
constexpr double attitude_deviation = 0.0005;          // rad
constexpr double rates_deviation = 0.002;              // rad/s
constexpr double force_deviation = 0.03;               // m/s^2
constexpr double field_deviation = 0.001;              // gauss
constexpr double pressure_deviation = 1.5;             // Pa
constexpr double satellite_position_deviation = 0.3;   // m
constexpr double satellite_velocity_deviation = 0.05;  // m/s

constexpr NorthEastDown magnetic_field{0.160, -0.048, -0.150};  // gauss: southern Brazil

// The standard atmosphere up to 11 km.
constexpr double sea_level_pressure = 101325;     // Pa
constexpr double sea_level_temperature = 288.15;  // K
constexpr double lapse_rate = 0.0065;             // K/m
constexpr double pressure_exponent = 5.25588;

}  // namespace

Readings Sensors::read(const AirframeState& truth, std::uint64_t step) const {
  const double roll_error = error(step, attitude_channel, attitude_deviation);
  const double pitch_error = error(step, attitude_channel + 1, attitude_deviation);
  const double heading_error = error(step, attitude_channel + 2, attitude_deviation);
  const double temperature = sea_level_temperature - lapse_rate * truth.position.altitude_msl.value;
  const double pressure = sea_level_pressure * std::pow(temperature / sea_level_temperature, pressure_exponent);
  return {
      .position = displaced(truth.position, earth_error(step, position_channel, position_deviation)),
      .velocity = truth.velocity + earth_error(step, velocity_channel, velocity_deviation),
      .attitude = {Radians{truth.attitude.roll.value + roll_error}, Radians{truth.attitude.pitch.value + pitch_error},
                   Radians{wrapped(truth.attitude.heading.value + heading_error)}},
      .rates = with_error(truth.rates, step, rates_channel, rates_deviation),
      .specific_force = with_error(specific_force(truth), step, force_channel, force_deviation),
      .magnetic_field = with_error(to_body(truth.attitude, magnetic_field), step, field_channel, field_deviation),
      .static_pressure = Pascals{pressure + error(step, pressure_channel, pressure_deviation)},
      .air_temperature = Kelvins{temperature},
  };
}

SatelliteReading Sensors::read_satellites(const AirframeState& truth, std::uint64_t step) const {
  return {displaced(truth.position, earth_error(step, satellite_position_channel, satellite_position_deviation)),
          truth.velocity + earth_error(step, satellite_velocity_channel, satellite_velocity_deviation)};
}

double Sensors::error(std::uint64_t step, std::uint64_t channel, double deviation) const {
  return noise_ * deviation * random_normal(seed_, step * channels_per_step + channel);
}

NorthEastDown Sensors::earth_error(std::uint64_t step, std::uint64_t channel, double deviation) const {
  return {error(step, channel, deviation), error(step, channel + 1, deviation), error(step, channel + 2, deviation)};
}

BodyVector Sensors::with_error(const BodyVector& value, std::uint64_t step, std::uint64_t channel,
                               double deviation) const {
  return {value.x + error(step, channel, deviation), value.y + error(step, channel + 1, deviation),
          value.z + error(step, channel + 2, deviation)};
}

}  // namespace ponte::sim
