#pragma once

#include "ponte/dli/messages/air_and_ground_relative_states.hpp"
#include "ponte/dli/messages/body_relative_sensed_states.hpp"
#include "ponte/dli/messages/enumerations.hpp"
#include "ponte/dli/messages/from_to_next_waypoint_states.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/dli/messages/subsystem_status_alert.hpp"
#include "ponte/dli/messages/subsystem_status_report.hpp"
#include "ponte/dli/messages/vehicle_id.hpp"
#include "ponte/dli/messages/vehicle_operating_mode_report.hpp"
#include "ponte/dli/messages/vehicle_operating_states.hpp"
#include "ponte/dlisession/mapping.hpp"
#include "ponte/dlisession/reports.hpp"

/// The mapping tables vehicle -> DLI: one tuple of rows per message. References are to the team's mapping facts.
namespace ponte::dlisession {

namespace messages = dli::messages;
using vehicle::State;

namespace rules {

inline constexpr Rule as_is{"as is, in the field's scale", [](const auto& value) { return std::optional{value}; }};

/// A field whose value does not depend on the fact, only on there being one.
template <auto Value>
inline constexpr Rule constant{"constant", [](const auto&) { return std::optional{Value}; }};

inline constexpr std::uint8_t first_vehicle_specific_mode = 32;
inline constexpr std::uint8_t first_other_mode = 64;

inline constexpr Rule control_mode{
    "manual 2, mission 11, hold 12, guided 15, land 19, take-off 21, return home 32, smart return 33, VTOL return 34, "
    "others 64 + variant",
    [](const vehicle::Mode& mode) -> std::optional<std::uint8_t> {
      namespace modes = dli::flight_path_control_mode;
      using enum vehicle::ModeKind;
      switch (mode.kind) {
        case none: return modes::no_mode;
        case manual: return modes::flight_director;
        case mission: return modes::waypoint;
        case hold: return modes::loiter;
        case guided: return modes::autopilot;
        case land: return modes::autoland_engage;
        case take_off: return modes::launch;
        case return_home: return first_vehicle_specific_mode;
        case smart_return: return static_cast<std::uint8_t>(first_vehicle_specific_mode + 1);
        case vtol_return: return static_cast<std::uint8_t>(first_vehicle_specific_mode + 2);
        case other: return static_cast<std::uint8_t>(first_other_mode + mode.variant);
      }
      return std::nullopt;
    }};

inline constexpr Rule av_state{
    "power up 1, pre-start 2, pre-launch 3; Edition 3 has no value for the air: take-off 10, in flight 11, landing 12, "
    "critical 13",
    [](vehicle::Phase phase) -> std::optional<std::uint8_t> {
      namespace states = dli::uav_state_ed3;
      constexpr std::uint8_t first_vehicle_specific = 10;
      using enum vehicle::Phase;
      switch (phase) {
        case unknown: return states::unknown;
        case power_up: return states::power_up;
        case pre_start: return states::pre_start;
        case pre_launch: return states::pre_launch;
        case taking_off: return first_vehicle_specific;
        case in_flight: return static_cast<std::uint8_t>(first_vehicle_specific + 1);
        case landing: return static_cast<std::uint8_t>(first_vehicle_specific + 2);
        case critical: return static_cast<std::uint8_t>(first_vehicle_specific + 3);
      }
      return std::nullopt;
    }};

/// A member of one of a leg's waypoints, if both are known.
template <auto Waypoint, auto Member>
inline constexpr Rule of_leg{"as is, where the leg has it", [](const vehicle::Leg& leg) {
                               const auto& waypoint = leg.*Waypoint;
                               using Value = std::remove_cvref_t<decltype((*waypoint).*Member)>;
                               if constexpr (requires(Value value) { value.has_value(); })
                                 return waypoint ? (*waypoint).*Member : Value{};
                               else
                                 return waypoint ? std::optional{(*waypoint).*Member} : std::nullopt;
                             }};

inline constexpr Rule leg_altitude_type{
    "3 where a waypoint's altitude is told", [](const vehicle::Leg& leg) -> std::optional<std::uint8_t> {
      const auto has_altitude = [](const std::optional<vehicle::Waypoint>& point) {
        return point && point->altitude_msl;
      };
      if (!has_altitude(leg.from) && !has_altitude(leg.to) && !has_altitude(leg.next)) return std::nullopt;
      return dli::altitude_type::wgs_84;
    }};

inline constexpr Rule vsm_id{"configured", [](const MappingContext& context, const vehicle::Identity&) {
                               return std::optional{context.description.vsm.value};
                             }};
inline constexpr Rule vehicle_id{"the id that the vehicle has",
                                 [](const MappingContext& context, const vehicle::Identity&) {
                                   return std::optional{context.description.vehicle.value};
                                 }};
inline constexpr Rule vehicle_type{"configured", [](const MappingContext& context, const vehicle::Identity&) {
                                     return std::optional{context.description.vehicle_type};
                                   }};
inline constexpr Rule vehicle_subtype{
    "configured, else MAV_TYPE",
    [](const MappingContext& context, const vehicle::Identity& identity) -> std::optional<std::uint16_t> {
      return context.description.vehicle_subtype.value_or(identity.airframe);
    }};
inline constexpr Rule owning_id{
    "first byte of the vehicle's id", [](const MappingContext& context, const vehicle::Identity&) {
      return std::optional{static_cast<std::uint8_t>(context.description.vehicle.value >> 24U)};
    }};
inline constexpr Rule tail_number{
    "configured, else the serial number of the autopilot hardware",
    [](const MappingContext& context, const vehicle::Identity& identity) -> std::optional<Text<15>> {
      const auto& configured = context.description.tail_number;
      const auto& text = configured.empty() ? identity.serial : configured;
      if (text.empty()) return std::nullopt;
      return text;
    }};
inline constexpr Rule call_sign{"configured",
                                [](const MappingContext& context, const vehicle::Identity&) -> std::optional<Text<31>> {
                                  if (context.description.call_sign.empty()) return std::nullopt;
                                  return context.description.call_sign;
                                }};

inline constexpr Rule priority{
    "cleared 0, nominal 1, caution 2, warning 3, emergency 4, failed 5",
    [](vehicle::Condition condition) { return std::optional{static_cast<std::uint8_t>(condition)}; }};
inline constexpr Rule subsystem_number{"number of the subsystem", [](vehicle::Subsystem which) {
                                         return std::optional{static_cast<std::uint8_t>(which)};
                                       }};
inline constexpr Rule alert_type{
    "cleared 0; nominal and caution 3: shown for a time; worse 2: until the operator clears it",
    [](vehicle::Condition severity) -> std::optional<std::uint8_t> {
      namespace types = dli::alert_type;
      if (severity == vehicle::Condition::no_status) return types::clear;
      return severity <= vehicle::Condition::caution ? types::display_for_fixed_time_then_clear
                                                     : types::clearable_by_operator;
    }};
inline constexpr Rule persistence{"10 s for what is shown for a time, 0 s for what is cleared",
                                  [](vehicle::Condition severity) -> std::optional<std::int8_t> {
                                    constexpr std::int8_t shown_s = 10;
                                    if (severity == vehicle::Condition::no_status) return std::int8_t{0};
                                    if (severity > vehicle::Condition::caution) return std::nullopt;
                                    return shown_s;
                                  }};

inline constexpr std::int32_t no_reference = -1;

}  // namespace rules

namespace rows {

using vehicle::Leg;
using vehicle::Waypoint;

// clang-format off
using I = messages::InertialStates;
inline constexpr std::tuple inertial_states{
    row(&I::latitude,      rules::as_is, "mapping 1 #4000", &State::latitude),
    row(&I::longitude,     rules::as_is, "mapping 1 #4000", &State::longitude),
    row(&I::altitude,      rules::as_is, "mapping 1 #4000", &State::altitude_msl),
    row(&I::altitude_type, rules::constant<dli::altitude_type::wgs_84>, "mapping 1 #4000", &State::altitude_msl),
    row(&I::u_speed,       rules::as_is, "mapping 1 #4000", &State::north_speed),
    row(&I::v_speed,       rules::as_is, "mapping 1 #4000", &State::east_speed),
    row(&I::w_speed,       rules::as_is, "mapping 1 #4000", &State::down_speed),
    row(&I::u_accel,       rules::as_is, "mapping 1 #4000", &State::north_acceleration),
    row(&I::v_accel,       rules::as_is, "mapping 1 #4000", &State::east_acceleration),
    row(&I::w_accel,       rules::as_is, "mapping 1 #4000", &State::down_acceleration),
    row(&I::roll,          rules::as_is, "mapping 1 #4000", &State::roll),
    row(&I::pitch,         rules::as_is, "mapping 1 #4000", &State::pitch),
    row(&I::heading,       rules::as_is, "mapping 1 #4000", &State::heading),
    row(&I::roll_rate,     rules::as_is, "mapping 1 #4000", &State::roll_rate),
    row(&I::pitch_rate,    rules::as_is, "mapping 1 #4000", &State::pitch_rate),
    row(&I::turn_rate,     rules::as_is, "mapping 1 #4000", &State::turn_rate),
};

using A = messages::AirAndGroundRelativeStates;
inline constexpr std::tuple air_and_ground_relative_states{
    row(&A::angle_of_attack,          rules::as_is, "mapping 1 #3009", &State::angle_of_attack),
    row(&A::angle_of_sideslip,        rules::as_is, "mapping 1 #3009", &State::sideslip),
    row(&A::true_airspeed,            rules::as_is, "mapping 1 #3009", &State::true_airspeed),
    row(&A::indicated_airspeed,       rules::as_is, "mapping 1 #3009", &State::indicated_airspeed),
    row(&A::outside_air_temp,         rules::as_is, "mapping 1 #3009", &State::air_temperature),
    row(&A::u_wind,                   rules::as_is, "mapping 1 #3009", &State::north_wind),
    row(&A::v_wind,                   rules::as_is, "mapping 1 #3009", &State::east_wind),
    row(&A::barometric_altitude,      rules::as_is, "mapping 1 #3009", &State::barometric_altitude),
    row(&A::barometric_altitude_rate, rules::as_is, "mapping 1 #3009", &State::climb_rate),
    row(&A::pressure_altitude,        rules::as_is, "mapping 1 #3009", &State::pressure_altitude),
    row(&A::agl_altitude,             rules::as_is, "mapping 1 #3009", &State::height_above_ground),
    row(&A::wgs_84_altitude,          rules::as_is, "mapping 1 #3009", &State::altitude_ellipsoid),
    row(&A::u_ground,                 rules::as_is, "mapping 1 #3009", &State::north_speed),
    row(&A::v_ground,                 rules::as_is, "mapping 1 #3009", &State::east_speed),
};

using B = messages::BodyRelativeSensedStates;
inline constexpr std::tuple body_relative_sensed_states{
    row(&B::x_body_accel, rules::as_is, "mapping 1 #3010", &State::body_x_acceleration),
    row(&B::y_body_accel, rules::as_is, "mapping 1 #3010", &State::body_y_acceleration),
    row(&B::z_body_accel, rules::as_is, "mapping 1 #3010", &State::body_z_acceleration),
    row(&B::roll_rate,    rules::as_is, "mapping 1 #3010", &State::body_roll_rate),
    row(&B::pitch_rate,   rules::as_is, "mapping 1 #3010", &State::body_pitch_rate),
    row(&B::yaw_rate,     rules::as_is, "mapping 1 #3010", &State::body_yaw_rate),
};

inline constexpr std::tuple vehicle_operating_mode_report{
    row(&messages::VehicleOperatingModeReport::select_flight_path_control_mode, rules::control_mode, "mapping 1 #3001", &State::mode),
};

using O = messages::VehicleOperatingStates;
inline constexpr std::tuple vehicle_operating_states{
    row(&O::commanded_altitude, rules::as_is, "mapping 1 #3002", &State::commanded_altitude_msl),
    row(&O::altitude_type,      rules::constant<dli::altitude_type::wgs_84>, "mapping 1 #3002", &State::commanded_altitude_msl),
    row(&O::commanded_altitude, rules::as_is, "mapping 1 #3002", &State::commanded_height_above_ground),
    row(&O::altitude_type,      rules::constant<dli::altitude_type::agl>, "mapping 1 #3002", &State::commanded_height_above_ground),
    row(&O::commanded_heading,  rules::as_is, "mapping 1 #3002", &State::commanded_heading),
    row(&O::commanded_course,   rules::as_is, "mapping 1 #3002", &State::commanded_course),
    row(&O::commanded_roll,     rules::as_is, "mapping 1 #3002", &State::commanded_roll),
    row(&O::power_level,        rules::as_is, "mapping 1 #3002", &State::power_level),
    row(&O::current_propulsion_energy_level, rules::as_is, "mapping 1 #3002", &State::energy_level),
    row(&O::av_state,           rules::av_state, "mapping 1 #3002", &State::phase),
};

using N = messages::FromToNextWaypointStates;
inline constexpr std::tuple from_to_next_waypoint_states{
    row(&N::altitude_type,           rules::leg_altitude_type,                               "mapping 1 #4001", &State::leg),
    row(&N::from_waypoint_latitude,  rules::of_leg<&Leg::from, &Waypoint::latitude>,         "mapping 1 #4001", &State::leg),
    row(&N::from_waypoint_longitude, rules::of_leg<&Leg::from, &Waypoint::longitude>,        "mapping 1 #4001", &State::leg),
    row(&N::from_waypoint_altitude,  rules::of_leg<&Leg::from, &Waypoint::altitude_msl>,     "mapping 1 #4001", &State::leg),
    row(&N::from_waypoint_time,      rules::of_leg<&Leg::from, &Waypoint::reached>,          "mapping 1 #4001", &State::leg),
    row(&N::from_waypoint_number,    rules::of_leg<&Leg::from, &Waypoint::number>,           "mapping 1 #4001", &State::leg),
    row(&N::to_waypoint_latitude,    rules::of_leg<&Leg::to, &Waypoint::latitude>,           "mapping 1 #4001", &State::leg),
    row(&N::to_waypoint_longitude,   rules::of_leg<&Leg::to, &Waypoint::longitude>,          "mapping 1 #4001", &State::leg),
    row(&N::to_waypoint_altitude,    rules::of_leg<&Leg::to, &Waypoint::altitude_msl>,       "mapping 1 #4001", &State::leg),
    row(&N::to_waypoint_time,        rules::as_is,                                           "mapping 1 #4001", &State::arrival),
    row(&N::to_waypoint_number,      rules::of_leg<&Leg::to, &Waypoint::number>,             "mapping 1 #4001", &State::leg),
    row(&N::next_waypoint_latitude,  rules::of_leg<&Leg::next, &Waypoint::latitude>,         "mapping 1 #4001", &State::leg),
    row(&N::next_waypoint_longitude, rules::of_leg<&Leg::next, &Waypoint::longitude>,        "mapping 1 #4001", &State::leg),
    row(&N::next_waypoint_altitude,  rules::of_leg<&Leg::next, &Waypoint::altitude_msl>,     "mapping 1 #4001", &State::leg),
    row(&N::next_waypoint_number,    rules::of_leg<&Leg::next, &Waypoint::number>,           "mapping 1 #4001", &State::leg),
};

using V = messages::VehicleId;
inline constexpr std::tuple vehicle_id{
    row(&V::vsm_id,            rules::vsm_id,          "mapping 1 Identity", &State::identity),
    row(&V::vehicle_id_update, rules::vehicle_id,      "mapping 1 Identity", &State::identity),
    row(&V::vehicle_type,      rules::vehicle_type,    "mapping 1 Identity", &State::identity),
    row(&V::vehicle_subtype,   rules::vehicle_subtype, "mapping 1 Identity", &State::identity),
    row(&V::owning_id,         rules::owning_id,       "mapping 1 Identity", &State::identity),
    row(&V::tail_number,       rules::tail_number,     "mapping 1 Identity", &State::identity),
    row(&V::mission_id,        rules::as_is,           "mapping 1 Identity", &State::mission_id),
    row(&V::atc_call_sign,     rules::call_sign,       "mapping 1 Identity", &State::identity),
};

using L = messages::SubsystemStatusAlert;
inline constexpr std::tuple subsystem_status_alert{
    row(&L::priority,     rules::priority,    "mapping 1 Alerts", &AlertReport::severity),
    row(&L::subsystem_state_report_reference, rules::constant<rules::no_reference>, "mapping 1 Alerts", &AlertReport::subsystem),
    row(&L::subsystem_id, rules::subsystem_number,   "mapping 1 Alerts", &AlertReport::subsystem),
    row(&L::type,         rules::alert_type,  "mapping 1 Alerts", &AlertReport::severity),
    row(&L::alert_id,     rules::as_is,       "mapping 1 Alerts", &AlertReport::id),
    row(&L::text,         rules::as_is,       "mapping 1 Alerts", &AlertReport::text),
    row(&L::persistence,  rules::persistence, "mapping 1 Alerts", &AlertReport::severity),
};

using S = messages::SubsystemStatusReport;
inline constexpr std::tuple subsystem_status_report{
    row(&S::subsystem_id,    rules::subsystem_number, "mapping 1 Alerts", &SubsystemReport::subsystem),
    row(&S::subsystem_state, rules::priority,  "mapping 1 Alerts", &SubsystemReport::condition),
    row(&S::subsystem_state_report_reference, rules::constant<rules::no_reference>, "mapping 1 Alerts", &SubsystemReport::subsystem),
};
// clang-format on

}  // namespace rows

}  // namespace ponte::dlisession
