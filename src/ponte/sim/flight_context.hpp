#pragma once

#include "ponte/core/outbox.hpp"
#include "ponte/core/time.hpp"
#include "ponte/sim/airframe.hpp"
#include "ponte/sim/flight_fact.hpp"
#include "ponte/sim/flight_mode.hpp"
#include "ponte/sim/flight_settings.hpp"

namespace ponte::sim {

/// What those who fly need to know, and whom they tell, during one call.
struct FlightContext {
  Duration now;  ///< since the start of the autopilot
  VehicleKind kind;
  const FlightSettings& settings;
  const Position& home;
  Airframe& airframe;
  Outbox<FlightFact>& facts;

  [[nodiscard]] bool is_plane() const { return kind.type == AirframeType::plane; }
  [[nodiscard]] bool is_px4() const { return kind.personality == Personality::px4; }
  /// Metres to the place, from where the aircraft believes to be.
  [[nodiscard]] NorthEastDown offset_to(const Position& place) const {
    return offset_between(airframe.known_position(), place);
  }
};

}  // namespace ponte::sim
