#pragma once

#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/vehicle/vocabulary.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// What the sensor bits of SYS_STATUS say of the vehicle's subsystems.
namespace ponte::autopilot {

/// SYS_STATUS.onboard_control_sensors_* in the low 32 bits, and onboard_control_sensors_*_extended above them.
struct SensorBits {
  std::uint64_t present{};
  std::uint64_t enabled{};
  std::uint64_t healthy{};
};

[[nodiscard]] SensorBits sensor_bits(const mavlink::autopilots::SysStatus& status);

/// One bit of `SensorBits`.
struct SensorRow {
  std::uint8_t bit;
  std::string_view name;
  vehicle::Subsystem subsystem;
  vehicle::Condition when_unhealthy;
  std::uint8_t excused_by;  ///< bit of the first sensor of this kind: while that is healthy this one is a caution only
};
inline constexpr std::uint8_t no_excuse = 255;

[[nodiscard]] std::span<const SensorRow> sensor_rows();

using SubsystemConditions = std::array<std::optional<vehicle::Condition>, vehicle::subsystem_count>;

/// The worst condition per subsystem; nothing where no fitted and enabled sensor belongs to it. The pre-arm check
/// counts while disarmed only.
[[nodiscard]] SubsystemConditions conditions_from(const SensorBits& bits, bool armed);

/// HEARTBEAT.system_status (MAV_STATE) as a condition of the vehicle as a whole; nothing for the ordinary states.
[[nodiscard]] std::optional<vehicle::Condition> condition_of_state(std::uint8_t system_status);

}  // namespace ponte::autopilot
