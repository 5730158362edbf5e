#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/sim/airframe.hpp"

#include <cstdint>

namespace ponte::sim {

/// What the instruments of a vehicle, and the estimator that joins them, say about one moment.
struct Readings {
  Position position{};
  NorthEastDown velocity{};  ///< m/s over ground
  Attitude attitude{};
  BodyVector rates{};           ///< rad/s
  BodyVector specific_force{};  ///< m/s^2
  BodyVector magnetic_field{};  ///< gauss
  Pascals static_pressure{};
  Kelvins air_temperature{};
};

/// What the receiver of a satellite navigation system says, less often and with larger errors.
struct SatelliteReading {
  Position position{};
  NorthEastDown velocity{};  ///< m/s over ground
};

/// Sensors whose errors are functions of the seed and of the number of the step alone.
class Sensors {
 public:
  /// `noise` scales all errors.
  Sensors(std::uint64_t seed, double noise) : seed_{seed}, noise_{noise} {}

  [[nodiscard]] Readings read(const AirframeState& truth, std::uint64_t step) const;
  [[nodiscard]] SatelliteReading read_satellites(const AirframeState& truth, std::uint64_t step) const;

 private:
  [[nodiscard]] double error(std::uint64_t step, std::uint64_t channel, double deviation) const;
  [[nodiscard]] NorthEastDown earth_error(std::uint64_t step, std::uint64_t channel, double deviation) const;
  [[nodiscard]] BodyVector with_error(const BodyVector& value, std::uint64_t step, std::uint64_t channel,
                                      double deviation) const;

  std::uint64_t seed_;
  double noise_;
};

}  // namespace ponte::sim
