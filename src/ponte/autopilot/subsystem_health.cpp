#include "ponte/autopilot/subsystem_health.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>

namespace ponte::autopilot {
namespace {

using enum vehicle::Subsystem;
using enum vehicle::Condition;

constexpr std::uint8_t prearm_check = 28;

// clang-format off
constexpr std::array rows{
    SensorRow{0,  "gyro",                     navigation,        warning, no_excuse},
    SensorRow{1,  "accelerometer",            navigation,        warning, no_excuse},
    SensorRow{2,  "magnetometer",             navigation,        warning, no_excuse},
    SensorRow{3,  "absolute pressure",        navigation,        warning, no_excuse},
    SensorRow{4,  "differential pressure",    navigation,        warning, no_excuse},
    SensorRow{5,  "GPS",                      navigation,        warning, no_excuse},
    SensorRow{6,  "optical flow",             navigation,        warning, no_excuse},
    SensorRow{7,  "vision position",          navigation,        warning, no_excuse},
    SensorRow{8,  "laser range",              navigation,        warning, no_excuse},
    SensorRow{9,  "external ground truth",    navigation,        warning, no_excuse},
    SensorRow{10, "rate control",             navigation,        warning, no_excuse},
    SensorRow{11, "attitude stabilisation",   navigation,        warning, no_excuse},
    SensorRow{12, "yaw control",              navigation,        warning, no_excuse},
    SensorRow{13, "altitude control",         navigation,        warning, no_excuse},
    SensorRow{14, "position control",         navigation,        warning, no_excuse},
    SensorRow{15, "motor outputs",            engine,            warning, no_excuse},
    SensorRow{16, "RC receiver",              comms,             warning, no_excuse},
    SensorRow{17, "second gyro",              navigation,        warning, 0},
    SensorRow{18, "second accelerometer",     navigation,        warning, 1},
    SensorRow{19, "second magnetometer",      navigation,        warning, 2},
    SensorRow{20, "geofence",                 navigation,        warning, no_excuse},
    SensorRow{21, "attitude estimator",       navigation,        warning, no_excuse},
    SensorRow{22, "terrain",                  navigation,        warning, no_excuse},
    SensorRow{23, "motors reversed",          engine,            warning, no_excuse},
    SensorRow{24, "logging",                  electrical,        warning, no_excuse},
    SensorRow{25, "battery",                  propulsion_energy, warning, no_excuse},
    SensorRow{26, "proximity",                navigation,        warning, no_excuse},
    SensorRow{27, "satellite communication",  comms,             warning, no_excuse},
    SensorRow{prearm_check, "pre-arm check",  vsm,               caution, no_excuse},
    SensorRow{29, "obstacle avoidance",       navigation,        warning, no_excuse},
    SensorRow{30, "propulsion",               engine,            warning, no_excuse},
    SensorRow{32, "recovery system",          recovery,          warning, no_excuse},
};
// clang-format on

constexpr bool has(std::uint64_t bits, std::uint8_t bit) { return (bits >> bit & 1U) != 0; }

}  // namespace

SensorBits sensor_bits(const mavlink::autopilots::SysStatus& status) {
  SensorBits bits{status.onboard_control_sensors_present, status.onboard_control_sensors_enabled,
                  status.onboard_control_sensors_health};
  if ((bits.present & mavlink::autopilots::MAV_SYS_STATUS_EXTENSION_USED) == 0) return bits;
  bits.present |= std::uint64_t{status.onboard_control_sensors_present_extended} << 32U;
  bits.enabled |= std::uint64_t{status.onboard_control_sensors_enabled_extended} << 32U;
  bits.healthy |= std::uint64_t{status.onboard_control_sensors_health_extended} << 32U;
  return bits;
}

std::span<const SensorRow> sensor_rows() { return rows; }

SubsystemConditions conditions_from(const SensorBits& bits, bool armed) {
  SubsystemConditions conditions;
  for (const auto& row : rows) {
    // PX4 sets "enabled" for what is not fitted, so "present" decides first.
    if (!has(bits.present & bits.enabled, row.bit)) continue;
    if (row.bit == prearm_check && armed) continue;
    auto condition = nominal;
    if (!has(bits.healthy, row.bit)) {
      const bool excused = row.excused_by != no_excuse && has(bits.present & bits.healthy, row.excused_by);
      condition = excused ? caution : row.when_unhealthy;
    }
    auto& worst = conditions[static_cast<std::size_t>(row.subsystem)];
    worst = worst ? std::max(*worst, condition) : condition;
  }
  return conditions;
}

std::optional<vehicle::Condition> condition_of_state(std::uint8_t system_status) {
  using namespace mavlink::autopilots;
  if (system_status == MAV_STATE_CRITICAL) return warning;
  if (system_status == MAV_STATE_EMERGENCY) return emergency;
  return std::nullopt;
}

}  // namespace ponte::autopilot
