#pragma once

#include "ponte/sim/flight_context.hpp"

#include <cstdint>

namespace ponte::sim {

/// The way home. A copter rises, crosses, waits, descends, may wait again, and lands; a plane circles over home.
class ReturnFlight {
 public:
  void begin(const FlightContext& flight);
  void step(const FlightContext& flight);
  [[nodiscard]] bool is_landing() const { return leg_ == Leg::land; }

 private:
  enum class Leg : std::uint8_t { rise, cross, wait, descend, stay, land, circle };

  void leave_altitude(const FlightContext& flight);
  [[nodiscard]] MetresPerSecond speed(const FlightContext& flight) const;
  [[nodiscard]] Position above_home(const FlightContext& flight) const;

  Leg leg_{Leg::rise};
  Metres altitude_{};  // above mean sea level
  Duration there_since_{};
};

}  // namespace ponte::sim
