#pragma once

#include "ponte/sim/failsafe_settings.hpp"
#include "ponte/sim/flight_mode.hpp"
#include "ponte/sim/flight_settings.hpp"
#include "ponte/sim/parameters.hpp"

namespace ponte::sim {

/// All that parameters say about a flight.
struct Settings {
  FlightSettings flight{};
  FailsafeSettings failsafes{};
};

/// As these parameters, which are of this kind, have them. Where the kind has no parameter for a setting, it is how
/// that autopilot behaves.
[[nodiscard]] Settings settings_of(VehicleKind kind, const Parameters& parameters);

}  // namespace ponte::sim
