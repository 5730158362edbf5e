#pragma once

#include "ponte/sim/flight_context.hpp"
#include "ponte/sim/guided.hpp"

#include <optional>

namespace ponte::sim {

/// Flies what a station or a companion computer asks for.
class GuidedFlight {
 public:
  /// Has been asked nothing.
  void begin() { target_.reset(); }
  /// From now on this, with whatever it leaves open as it is. The speed is that of the way to a position without one.
  void take(const GuidedTarget& target, MetresPerSecond speed, const FlightContext& flight);
  /// A setpoint has come that is not to be flown yet.
  void remember(const GuidedTarget& target, const FlightContext& flight);
  /// Of the way to the newest position.
  void set_speed(MetresPerSecond speed, const FlightContext& flight);
  /// Stops when velocities no longer come, as ArduPilot does. Whether setpoints come at all is `is_fresh`.
  void step(const FlightContext& flight);

  /// The newest setpoint is not older than the time-out.
  [[nodiscard]] bool is_fresh(const FlightContext& flight) const;

 private:
  std::optional<GuidedTarget> target_;
  Duration taken_at_{};
};

}  // namespace ponte::sim
