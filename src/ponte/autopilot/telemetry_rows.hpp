#pragma once

#include "ponte/autopilot/rules.hpp"
#include "ponte/mavlink/autopilots/altitude.hpp"
#include "ponte/mavlink/autopilots/aoa_ssa.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/attitude_target.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/distance_sensor.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/highres_imu.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/nav_controller_output.hpp"
#include "ponte/mavlink/autopilots/position_target_global_int.hpp"
#include "ponte/mavlink/autopilots/scaled_imu.hpp"
#include "ponte/mavlink/autopilots/scaled_pressure.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/terrain_report.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"
#include "ponte/mavlink/autopilots/wind.hpp"
#include "ponte/mavlink/autopilots/wind_cov.hpp"

/// The mapping tables MAVLink -> vehicle: one tuple of rows per message. References are to the team's mapping facts, by
/// the DLI message that needs the value.
namespace ponte::autopilot {

namespace messages = mavlink::autopilots;
using vehicle::State;

namespace rows {

// clang-format off
using A = messages::Attitude;
inline constexpr std::tuple attitude{
    row(&State::roll,       rules::radians,          "mapping 1 #4000", &A::roll),
    row(&State::pitch,      rules::radians,          "mapping 1 #4000", &A::pitch),
    row(&State::heading,    rules::radians,          "mapping 1 #4000", &A::yaw),
    row(&State::roll_rate,  rules::euler_roll_rate,  "mapping 1 #4000", &A::rollspeed, &A::pitchspeed, &A::yawspeed, &A::roll, &A::pitch),
    row(&State::pitch_rate, rules::euler_pitch_rate, "mapping 1 #4000", &A::pitchspeed, &A::yawspeed, &A::roll, &A::pitch),
    row(&State::turn_rate,  rules::euler_turn_rate,  "mapping 1 #4000", &A::pitchspeed, &A::yawspeed, &A::roll, &A::pitch),
};

using G = messages::GlobalPositionInt;
inline constexpr std::tuple global_position{
    row(&State::latitude,     rules::degrees_e7,                           "mapping 1 #4000", &G::lat, &G::lat, &G::lon),
    row(&State::longitude,    rules::degrees_e7,                           "mapping 1 #4000", &G::lon, &G::lat, &G::lon),
    row(&State::altitude_msl, rules::millimetres_with_position,            "mapping 1 #4000", &G::alt, &G::lat, &G::lon),
    row(&State::north_speed,  rules::centimetres_per_second_with_position, "mapping 1 #4000", &G::vx, &G::lat, &G::lon),
    row(&State::east_speed,   rules::centimetres_per_second_with_position, "mapping 1 #4000", &G::vy, &G::lat, &G::lon),
    row(&State::down_speed,   rules::centimetres_per_second_with_position, "mapping 1 #4000", &G::vz, &G::lat, &G::lon),
};

using H = messages::HighresImu;
using rules::Axis;
inline constexpr std::tuple highres_imu{
    row(&State::body_x_acceleration, rules::updated<MetresPerSecondSquared, 1>, "mapping 1 #3010", &H::xacc, &H::fields_updated, &H::id),
    row(&State::body_y_acceleration, rules::updated<MetresPerSecondSquared, 2>, "mapping 1 #3010", &H::yacc, &H::fields_updated, &H::id),
    row(&State::body_z_acceleration, rules::updated<MetresPerSecondSquared, 4>, "mapping 1 #3010", &H::zacc, &H::fields_updated, &H::id),
    row(&State::body_roll_rate,      rules::updated<RadiansPerSecond, 8>,       "mapping 1 #3010", &H::xgyro, &H::fields_updated, &H::id),
    row(&State::body_pitch_rate,     rules::updated<RadiansPerSecond, 16>,      "mapping 1 #3010", &H::ygyro, &H::fields_updated, &H::id),
    row(&State::body_yaw_rate,       rules::updated<RadiansPerSecond, 32>,      "mapping 1 #3010", &H::zgyro, &H::fields_updated, &H::id),
    row(&State::north_acceleration,  rules::earth_acceleration_from_si<Axis::north>, "mapping 1 #4000", &H::xacc, &H::yacc, &H::zacc, &H::fields_updated, &H::id),
    row(&State::east_acceleration,   rules::earth_acceleration_from_si<Axis::east>,  "mapping 1 #4000", &H::xacc, &H::yacc, &H::zacc, &H::fields_updated, &H::id),
    row(&State::down_acceleration,   rules::earth_acceleration_from_si<Axis::down>,  "mapping 1 #4000", &H::xacc, &H::yacc, &H::zacc, &H::fields_updated, &H::id),
};

using S = messages::ScaledImu;
inline constexpr std::tuple scaled_imu{
    row(&State::body_x_acceleration, rules::milli_gravity,           "mapping 1 #3010", 1, &S::xacc),
    row(&State::body_y_acceleration, rules::milli_gravity,           "mapping 1 #3010", 1, &S::yacc),
    row(&State::body_z_acceleration, rules::milli_gravity,           "mapping 1 #3010", 1, &S::zacc),
    row(&State::body_roll_rate,      rules::milliradians_per_second, "mapping 1 #3010", 1, &S::xgyro),
    row(&State::body_pitch_rate,     rules::milliradians_per_second, "mapping 1 #3010", 1, &S::ygyro),
    row(&State::body_yaw_rate,       rules::milliradians_per_second, "mapping 1 #3010", 1, &S::zgyro),
    row(&State::north_acceleration,  rules::earth_acceleration_from_milli_gravity<Axis::north>, "mapping 1 #4000", 1, &S::xacc, &S::yacc, &S::zacc),
    row(&State::east_acceleration,   rules::earth_acceleration_from_milli_gravity<Axis::east>,  "mapping 1 #4000", 1, &S::xacc, &S::yacc, &S::zacc),
    row(&State::down_acceleration,   rules::earth_acceleration_from_milli_gravity<Axis::down>,  "mapping 1 #4000", 1, &S::xacc, &S::yacc, &S::zacc),
};

using V = messages::VfrHud;
inline constexpr std::tuple vfr_hud{
    row(&State::indicated_airspeed,  rules::indicated_airspeed, "mapping 1 #3009", &V::airspeed),
    row(&State::true_airspeed,       rules::true_airspeed,      "mapping 1 #3009", &V::airspeed),
    row(&State::barometric_altitude, rules::metres,             "mapping 1 #3009", &V::alt),
    row(&State::climb_rate,          rules::metres_per_second,  "mapping 1 #3009", &V::climb),
    row(&State::power_level,         rules::throttle,           "mapping 1 #3002", &V::throttle),
};

using P = messages::ScaledPressure;
inline constexpr std::tuple scaled_pressure{
    row(&State::static_pressure,   rules::hectopascals,                 "mapping 1 #3009", &P::press_abs),
    row(&State::pressure_altitude, rules::standard_atmosphere_altitude, "mapping 1 #3009", &P::press_abs),
    row(&State::air_temperature,   rules::centi_celsius,                "mapping 1 #3009", &P::temperature),
};

using W = messages::Wind;
inline constexpr std::tuple wind{
    row(&State::north_wind, rules::north_of_wind, "mapping 1 #3009", &W::speed, &W::direction),
    row(&State::east_wind,  rules::east_of_wind,  "mapping 1 #3009", &W::speed, &W::direction),
};

using C = messages::WindCov;
inline constexpr std::tuple wind_cov{
    row(&State::north_wind, rules::metres_per_second, "mapping 1 #3009", &C::wind_x),
    row(&State::east_wind,  rules::metres_per_second, "mapping 1 #3009", &C::wind_y),
};

using I = messages::AoaSsa;
inline constexpr std::tuple aoa_ssa{
    row(&State::angle_of_attack, rules::degrees, "mapping 1 #3009", &I::aoa),
    row(&State::sideslip,        rules::degrees, "mapping 1 #3009", &I::ssa),
};

using D = messages::DistanceSensor;
inline constexpr std::tuple distance_sensor{
    row(&State::height_above_ground, rules::downward_rangefinder, "mapping 1 #3009", &D::current_distance, &D::orientation, &D::min_distance, &D::max_distance, &D::signal_quality),
};

inline constexpr std::tuple altitude{
    row(&State::height_above_ground, rules::height_over_terrain, "mapping 1 #3009", 1, &messages::Altitude::altitude_terrain),
};

using T = messages::TerrainReport;
inline constexpr std::tuple terrain_report{
    row(&State::height_above_ground, rules::terrain_database_height, "mapping 1 #3009", 2, &T::current_height, &T::spacing),
};

using R = messages::GpsRawInt;
inline constexpr std::tuple gps_raw{
    row(&State::altitude_ellipsoid, rules::ellipsoid_height, "mapping 1 #3009", &R::alt_ellipsoid, &R::fix_type),
};

inline constexpr std::tuple home_position{
    row(&State::home_altitude_msl, rules::millimetres, "mapping 1 #4001", &messages::HomePosition::altitude),
};

using N = messages::NavControllerOutput;
inline constexpr std::tuple nav_controller_output{
    row(&State::commanded_heading, rules::navigation_bearing, "mapping 1 #3002", 1, &N::nav_bearing),
    row(&State::commanded_course,  rules::navigation_bearing, "mapping 1 #3002", &N::target_bearing),
    row(&State::commanded_roll,    rules::navigation_roll,    "mapping 1 #3002", 1, &N::nav_roll),
    row(&State::arrival,           rules::arrival,            "mapping 1 #4001", &N::wp_dist),
};

using L = messages::PositionTargetGlobalInt;
inline constexpr std::tuple position_target{
    row(&State::commanded_altitude_msl,        rules::target_altitude, "mapping 1 #3002", &L::alt, &L::coordinate_frame, &L::type_mask),
    row(&State::commanded_height_above_ground, rules::target_height,   "mapping 1 #3002", &L::alt, &L::coordinate_frame, &L::type_mask),
    row(&State::commanded_heading,             rules::target_yaw,      "mapping 1 #3002", &L::yaw, &L::type_mask),
};

using U = messages::AttitudeTarget;
inline constexpr std::tuple attitude_target{
    row(&State::commanded_roll,    rules::roll_of_quaternion,    "mapping 1 #3002", &U::q, &U::type_mask),
    row(&State::commanded_heading, rules::heading_of_quaternion, "mapping 1 #3002", 1, &U::q, &U::type_mask),
};

using B = messages::BatteryStatus;
inline constexpr std::tuple battery_status{
    row(&State::energy_level, rules::remaining_of_first, "mapping 1 #3002", &B::battery_remaining, &B::id),
};

inline constexpr std::tuple sys_status{
    row(&State::energy_level, rules::remaining, "mapping 1 #3002", 1, &messages::SysStatus::battery_remaining),
};
// clang-format on

}  // namespace rows

/// All tables, each a tuple of rows of one message.
inline constexpr std::tuple telemetry_tables{
    rows::attitude,
    rows::global_position,
    rows::highres_imu,
    rows::scaled_imu,
    rows::vfr_hud,
    rows::scaled_pressure,
    rows::wind,
    rows::wind_cov,
    rows::aoa_ssa,
    rows::distance_sensor,
    rows::altitude,
    rows::terrain_report,
    rows::gps_raw,
    rows::home_position,
    rows::nav_controller_output,
    rows::position_target,
    rows::attitude_target,
    rows::battery_status,
    rows::sys_status,
};

/// The message type that a table's rows read.
template <class Table>
struct MessageOf;
template <mavlink::Message M, class T, class F, class... Fields, class... Rest>
struct MessageOf<std::tuple<Row<M, T, F, Fields...>, Rest...>> {
  using type = M;
};

}  // namespace ponte::autopilot
