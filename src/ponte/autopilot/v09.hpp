#pragma once

#include "ponte/vehicle/vocabulary.hpp"

#include <cstdint>
#include <optional>

/// What MAVLink 0.9 says in numbers of its own, in those of MAVLink 1 (definitions/mavlink/v09.xml).
namespace ponte::autopilot::v09 {

/// MAV_AUTOPILOT from HEARTBEAT.autopilot: they differ in the number that means "none".
[[nodiscard]] std::uint8_t autopilot_of(std::uint8_t autopilot);

/// MAV_TYPE from HEARTBEAT.type: they differ in those of the ground.
[[nodiscard]] std::uint8_t airframe_of(std::uint8_t type);

/// MAV_STATE from SYS_STATUS.status. A hardware-in-the-loop simulation is active.
[[nodiscard]] std::uint8_t system_status_of(std::uint8_t status);

/// Whether the motors may run: neither locked nor before start-up, and active, critical or in an emergency.
[[nodiscard]] bool is_armed(std::uint8_t mode, std::uint8_t status);

/// MAV_LANDED_STATE from SYS_STATUS.nav_mode; nothing for a number without a meaning.
[[nodiscard]] std::optional<std::uint8_t> landed_state_of(std::uint8_t nav_mode);

/// MAV_SEVERITY from STATUSTEXT.severity, of which only the ends are defined: 0 is information, 255 critical. Between
/// them nothing is; the upper half counts as a warning.
[[nodiscard]] std::uint8_t severity_of(std::uint8_t severity);

/// The mode of SYS_STATUS. Under automatic control, the navigation mode tells what the vehicle is doing.
[[nodiscard]] vehicle::Mode mode_of(std::uint8_t mode, std::uint8_t nav_mode);

}  // namespace ponte::autopilot::v09
