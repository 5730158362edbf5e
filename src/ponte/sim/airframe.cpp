#include "ponte/sim/airframe.hpp"

namespace ponte::sim {

BodyVector specific_force(const AirframeState& state) {
  return to_body(state.attitude, state.acceleration - NorthEastDown{0, 0, standard_gravity});
}

}  // namespace ponte::sim
