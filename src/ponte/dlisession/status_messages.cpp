#include "ponte/dlisession/status_messages.hpp"

#include <vector>

namespace ponte::dlisession {

messages::SubsystemStatusAlert alert_message(const AlertReport& report, WallTime at, const MappingContext& context) {
  return build<messages::SubsystemStatusAlert>(rows::subsystem_status_alert, report, 0, at, context)->message;
}

messages::SubsystemStatusReport subsystem_message(const SubsystemReport& report, WallTime at,
                                                  const MappingContext& context) {
  return build<messages::SubsystemStatusReport>(rows::subsystem_status_report, report, 0, at, context)->message;
}

messages::HeartbeatMessage heartbeat_message(WallTime at) { return {.time_stamp = dli::time_stamp_from(at)}; }

std::span<const RowText> status_row_texts() {
  static const auto texts = [] {
    std::vector<RowText> all;
    const auto add = [&](const auto& table) {
      std::apply([&](const auto&... row) { (all.push_back(describe(row)), ...); }, table);
    };
    add(rows::vehicle_id);
    add(rows::vehicle_operating_mode_report);
    add(rows::vehicle_operating_states);
    add(rows::air_and_ground_relative_states);
    add(rows::body_relative_sensed_states);
    add(rows::inertial_states);
    add(rows::from_to_next_waypoint_states);
    add(rows::subsystem_status_alert);
    add(rows::subsystem_status_report);
    return all;
  }();
  return texts;
}

}  // namespace ponte::dlisession
