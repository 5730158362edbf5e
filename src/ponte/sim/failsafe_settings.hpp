#pragma once

#include "ponte/core/time.hpp"
#include "ponte/sim/fence.hpp"

#include <cstdint>

namespace ponte::sim {

/// What is done about trouble, in the order of how much it is.
enum class FailsafeAction : std::uint8_t { none, warn, keep_altitude, hold, rtl, land, terminate };

/// When an autopilot helps itself, and how. `settings.cpp` says which of its parameters is which setting.
struct FailsafeSettings {
  // Battery. ArduPilot goes by its voltage, PX4 by what remains of its charge; 0 is never.
  double low_volts{};
  double critical_volts{};
  Duration low_volts_last{};
  double low_ampere_hours{};  ///< that are left
  double critical_ampere_hours{};
  double low_share{};
  double critical_share{};
  double emergency_share{};
  FailsafeAction low{};
  FailsafeAction critical{};
  FailsafeAction emergency{};

  Duration station_time_out{};
  FailsafeAction station{};
  FailsafeAction position{};      ///< without a position, in a mode that needs one
  bool position_in_every_mode{};  ///< in the others, too
  FenceSettings fence{};
  FailsafeAction breach{};  ///< of the fence
  Duration hold_first{};    ///< before an action, so that a pilot may take over
};

}  // namespace ponte::sim
