#include "ponte/sim/telemetry.hpp"

#include "ponte/sim/telemetry_messages.hpp"
#include "ponte/sim/telemetry_row.hpp"

#include <algorithm>
#include <array>

namespace ponte::sim {
namespace {

constexpr std::array rows{
    telemetry_row<heartbeat>({Stream::none, std::chrono::seconds{1}}),
    telemetry_row<attitude_message>({Stream::extra1}),
    telemetry_row<global_position>({Stream::position}),
    telemetry_row<local_position>({Stream::position}),
    telemetry_row<vfr_hud>({Stream::extra2}),
    telemetry_row<sys_status>({Stream::extended_status}),
    telemetry_row<nav_controller_output>({Stream::extended_status}),
    telemetry_row<mission_current>({Stream::extended_status}),
    telemetry_row<mission_item_reached>({Stream::none}),
    telemetry_row<gps_raw>({Stream::extended_status}),
    telemetry_row<position_target>({Stream::extended_status}),
    telemetry_row<servo_output>({Stream::rc_channels}),
    telemetry_row<rc_channels>({Stream::rc_channels}),
    telemetry_row<raw_imu>({Stream::raw_sensors}),
    telemetry_row<scaled_pressure>({Stream::raw_sensors}),
    telemetry_row<power_status>({Stream::extended_status}),
    telemetry_row<meminfo>({Stream::extended_status}),
    telemetry_row<ahrs>({Stream::extra3}),
    telemetry_row<ekf_status_report>({Stream::extra3}),
    telemetry_row<vibration>({Stream::extra3}),
    telemetry_row<gimbal_attitude>({Stream::extra3}),
    telemetry_row<gimbal_manager_status>({Stream::none, std::chrono::seconds{5}}),
    telemetry_row<gimbal_manager_information>({Stream::none}),
    telemetry_row<gimbal_device_information>({Stream::none}),
    telemetry_row<mount_orientation>({Stream::none}),
    telemetry_row<system_time>({Stream::extra3}),
    telemetry_row<battery_status>({Stream::extra3}),
    telemetry_row<wind>({Stream::extra3}),
    telemetry_row<scaled_imu>({Stream::none}),
    telemetry_row<extended_sys_state>({Stream::none}),
    telemetry_row<home_position>({Stream::none}),
    telemetry_row<gps_global_origin>({Stream::none}),
    telemetry_row<attitude_quaternion>({Stream::none}),
    telemetry_row<autopilot_version>({Stream::none}),
};

static_assert(rows.size() <= MessageRates::capacity);

}  // namespace

std::span<const TelemetryRow> telemetry_rows(Personality personality, mavlink::Version version) {
  if (version == mavlink::Version::v0_9) return telemetry_rows_v09();
  return personality == Personality::px4 ? telemetry_rows_px4() : rows;
}

std::optional<std::size_t> find_telemetry_row(std::span<const TelemetryRow> among, mavlink::MessageId id) {
  const auto found =
      std::find_if(among.begin(), among.end(), [=](const TelemetryRow& each) { return each.info->id == id; });
  if (found == among.end()) return std::nullopt;
  return static_cast<std::size_t>(found - among.begin());
}

}  // namespace ponte::sim
