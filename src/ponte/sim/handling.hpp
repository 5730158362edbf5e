#pragma once

#include "ponte/core/quantity.hpp"

namespace ponte::sim {

/// How an autopilot has its aircraft flown, as its parameters say; until it is told, as ArduCopter does. The
/// aircraft does no more than it is able to.
struct Handling {
  MetresPerSecond cruise_speed{10};  ///< through the air in a plane
  MetresPerSecond most_speed{30};    ///< whatever an order asks for
  MetresPerSecond climb_rate{2.5};
  MetresPerSecond take_off_rate{2.5};  ///< of a copter
  MetresPerSecond descent_rate{1.5};
  MetresPerSecond landing_rate{0.5};  ///< of a copter, on the last metres
  Metres landing_height{10};          ///< where these begin
  Metres loiter_radius{10};           ///< where nobody says another
};

}  // namespace ponte::sim
