#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/vehicle/vocabulary.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What a vehicle last said of where it is in its life cycle.
struct LifeCycleSigns {
  Stack stack{Stack::unknown};
  std::uint8_t system_status{};              ///< MAV_STATE
  bool armed{};                              ///< base_mode bit 128
  std::optional<std::uint8_t> landed_state;  ///< MAV_LANDED_STATE, if EXTENDED_SYS_STATE came
  vehicle::ModeKind mode{};
};

/// The phase that the signs add up to. STANDBY means other things in ArduPilot and PX4, and CRITICAL stays after
/// landing in ArduPilot, so arming and landed state decide before system_status.
[[nodiscard]] vehicle::Phase phase_from(const LifeCycleSigns& signs);

}  // namespace ponte::autopilot
