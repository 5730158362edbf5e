#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/sim/geodesy.hpp"

#include <cstdint>

namespace ponte::sim {

/// The weather: a mean wind and gusts about it.
struct WindConfig {
  MetresPerSecond speed{};
  Radians from{};  ///< where it comes from, clockwise from north
  double gusts{};  ///< their standard deviation along each axis, as a share of the mean speed
};

/// The wind at one place, step by step, the same for the same seed. Gusts come and go within seconds.
class Wind {
 public:
  Wind(const WindConfig& config, std::uint64_t seed);

  /// The velocity of the air (m/s) in the next step.
  NorthEastDown step();

 private:
  NorthEastDown mean_;
  double deviation_;  // m/s
  std::uint64_t seed_;
  std::uint64_t draws_{};
  NorthEastDown gust_{};
};

}  // namespace ponte::sim
