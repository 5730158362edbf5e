#pragma once

#include <cstdint>

namespace ponte::sim {

/// Which autopilot a vehicle behaves like on the wire.
enum class Personality : std::uint8_t { ardupilot, px4 };

}  // namespace ponte::sim
