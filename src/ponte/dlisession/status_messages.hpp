#pragma once

#include "ponte/dli/messages/heartbeat_message.hpp"
#include "ponte/dlisession/status_rows.hpp"

#include <span>

/// The status messages that a VSM sends, built from what is known of a vehicle.
namespace ponte::dlisession {

/// The rows of a message, read from `Source`.
template <dli::Message M>
constexpr const auto& table_of() {
  if constexpr (std::same_as<M, messages::InertialStates>) return rows::inertial_states;
  if constexpr (std::same_as<M, messages::AirAndGroundRelativeStates>) return rows::air_and_ground_relative_states;
  if constexpr (std::same_as<M, messages::BodyRelativeSensedStates>) return rows::body_relative_sensed_states;
  if constexpr (std::same_as<M, messages::VehicleOperatingModeReport>) return rows::vehicle_operating_mode_report;
  if constexpr (std::same_as<M, messages::VehicleOperatingStates>) return rows::vehicle_operating_states;
  if constexpr (std::same_as<M, messages::FromToNextWaypointStates>) return rows::from_to_next_waypoint_states;
  if constexpr (std::same_as<M, messages::VehicleId>) return rows::vehicle_id;
  if constexpr (std::same_as<M, messages::SubsystemStatusAlert>) return rows::subsystem_status_alert;
  if constexpr (std::same_as<M, messages::SubsystemStatusReport>) return rows::subsystem_status_report;
}

/// What `state` knows for message M and learnt after `since` (0: all it knows); nothing when that is nothing.
template <dli::Message M>
[[nodiscard]] std::optional<Built<M>> status_message(const vehicle::State& state, vehicle::Revision since,
                                                     const MappingContext& context) {
  return build<M>(table_of<M>(), state, since, WallTime{}, context);
}

/// #16000 for an alert that came up `at` that time.
[[nodiscard]] messages::SubsystemStatusAlert alert_message(const AlertReport& report, WallTime at,
                                                           const MappingContext& context);

/// #16001 for one subsystem whose condition was learnt `at` that time.
[[nodiscard]] messages::SubsystemStatusReport subsystem_message(const SubsystemReport& report, WallTime at,
                                                                const MappingContext& context);

/// #16002, only a time stamp.
[[nodiscard]] messages::HeartbeatMessage heartbeat_message(WallTime at);

/// Every row of the mapping tables in words, for documentation and tests.
[[nodiscard]] std::span<const RowText> status_row_texts();

}  // namespace ponte::dlisession
