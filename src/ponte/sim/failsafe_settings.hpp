#pragma once

#include "ponte/core/time.hpp"
#include "ponte/sim/fence.hpp"
#include "ponte/sim/flight_mode.hpp"
#include "ponte/sim/parameters.hpp"

#include <cstdint>

namespace ponte::sim {

/// What is done about trouble, in the order of how much it is.
enum class FailsafeAction : std::uint8_t { none, warn, hold, rtl, land, terminate };

/// When an autopilot helps itself, and how, as its parameters say.
struct FailsafeSettings {
  // Battery. ArduPilot goes by its voltage, PX4 by what remains of its charge; 0 is never.
  double low_volts{};              ///< BATT_LOW_VOLT
  double critical_volts{};         ///< BATT_CRT_VOLT
  Duration low_volts_last{};       ///< BATT_LOW_TIMER
  double low_ampere_hours{};       ///< that are left: BATT_LOW_MAH
  double critical_ampere_hours{};  ///< BATT_CRT_MAH
  double low_share{};              ///< BAT_LOW_THR
  double critical_share{};         ///< BAT_CRIT_THR
  double emergency_share{};        ///< BAT_EMERGEN_THR
  FailsafeAction low{};            ///< BATT_FS_LOW_ACT, warn
  FailsafeAction critical{};       ///< BATT_FS_CRT_ACT, COM_LOW_BAT_ACT
  FailsafeAction emergency{};      ///< none, COM_LOW_BAT_ACT

  Duration station_time_out{};  ///< FS_GCS_TIMEOUT, COM_DL_LOSS_T
  FailsafeAction station{};     ///< FS_GCS_ENABLE, NAV_DLL_ACT
  FailsafeAction position{};    ///< without a position, in a mode that needs one: FS_EKF_ACTION, land
  FenceSettings fence{};
  FailsafeAction breach{};  ///< of the fence: FENCE_ACTION, GF_ACTION
  Duration hold_first{};    ///< before an action, so that a pilot may take over: none, COM_FAIL_ACT_T
};

/// As these parameters, which are of this kind, have them; one that is not among them is 0.
[[nodiscard]] FailsafeSettings failsafe_settings(VehicleKind kind, const Parameters& parameters);

}  // namespace ponte::sim
