#pragma once

#include "ponte/autopilot/rules.hpp"
#include "ponte/mavlink/v09/attitude.hpp"
#include "ponte/mavlink/v09/global_position.hpp"
#include "ponte/mavlink/v09/global_position_int.hpp"
#include "ponte/mavlink/v09/nav_controller_output.hpp"
#include "ponte/mavlink/v09/scaled_imu.hpp"
#include "ponte/mavlink/v09/scaled_pressure.hpp"
#include "ponte/mavlink/v09/sys_status.hpp"
#include "ponte/mavlink/v09/vfr_hud.hpp"

/// The same tables for MAVLink 0.9.
namespace ponte::autopilot {

namespace rules {

inline constexpr Rule degrees_with_position{"deg to rad; nothing at 0, 0: no position yet",
                                            [](float angle, float latitude, float longitude) -> std::optional<Radians> {
                                              const bool is_place = std::isfinite(latitude) && std::isfinite(longitude);
                                              if (!is_place || (latitude == 0 && longitude == 0)) return std::nullopt;
                                              return Radians{double{angle} * radians_per_degree};
                                            }};

inline constexpr Rule climb{"-(m/s)", scaled<MetresPerSecond>(-1)};
inline constexpr Rule climb_with_position{"-(cm/s) / 100; nothing without a position",
                                          with_position<MetresPerSecond>(-1e-2)};

inline constexpr Rule remaining_in_tenths{"0.1 %; nothing above 1000",
                                          [](std::uint16_t tenths) -> std::optional<Percent> {
                                            if (tenths > 1000) return std::nullopt;
                                            return Percent{tenths * 0.1};
                                          }};

}  // namespace rules

namespace rows::v09 {

namespace messages = mavlink::v09;
using vehicle::State;

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

// In both messages, z is up.
using G = messages::GlobalPositionInt;
inline constexpr std::tuple global_position_int{
    row(&State::latitude,     rules::degrees_e7,                           "mapping 1 #4000", &G::lat, &G::lat, &G::lon),
    row(&State::longitude,    rules::degrees_e7,                           "mapping 1 #4000", &G::lon, &G::lat, &G::lon),
    row(&State::altitude_msl, rules::millimetres_with_position,            "mapping 1 #4000", &G::alt, &G::lat, &G::lon),
    row(&State::north_speed,  rules::centimetres_per_second_with_position, "mapping 1 #4000", &G::vx, &G::lat, &G::lon),
    row(&State::east_speed,   rules::centimetres_per_second_with_position, "mapping 1 #4000", &G::vy, &G::lat, &G::lon),
    row(&State::down_speed,   rules::climb_with_position,                  "mapping 1 #4000", &G::vz, &G::lat, &G::lon),
};

using F = messages::GlobalPosition;
inline constexpr std::tuple global_position{
    row(&State::latitude,     rules::degrees_with_position, "mapping 1 #4000", 1, &F::lat, &F::lat, &F::lon),
    row(&State::longitude,    rules::degrees_with_position, "mapping 1 #4000", 1, &F::lon, &F::lat, &F::lon),
    row(&State::altitude_msl, rules::metres,                "mapping 1 #4000", 1, &F::alt),
    row(&State::north_speed,  rules::metres_per_second,     "mapping 1 #4000", 1, &F::vx),
    row(&State::east_speed,   rules::metres_per_second,     "mapping 1 #4000", 1, &F::vy),
    row(&State::down_speed,   rules::climb,                 "mapping 1 #4000", 1, &F::vz),
};

using rules::Axis;
using S = messages::ScaledImu;
inline constexpr std::tuple scaled_imu{
    row(&State::body_x_acceleration, rules::milli_gravity,           "mapping 1 #3010", &S::xacc),
    row(&State::body_y_acceleration, rules::milli_gravity,           "mapping 1 #3010", &S::yacc),
    row(&State::body_z_acceleration, rules::milli_gravity,           "mapping 1 #3010", &S::zacc),
    row(&State::body_roll_rate,      rules::milliradians_per_second, "mapping 1 #3010", &S::xgyro),
    row(&State::body_pitch_rate,     rules::milliradians_per_second, "mapping 1 #3010", &S::ygyro),
    row(&State::body_yaw_rate,       rules::milliradians_per_second, "mapping 1 #3010", &S::zgyro),
    row(&State::north_acceleration,  rules::earth_acceleration_from_milli_gravity<Axis::north>, "mapping 1 #4000", &S::xacc, &S::yacc, &S::zacc),
    row(&State::east_acceleration,   rules::earth_acceleration_from_milli_gravity<Axis::east>,  "mapping 1 #4000", &S::xacc, &S::yacc, &S::zacc),
    row(&State::down_acceleration,   rules::earth_acceleration_from_milli_gravity<Axis::down>,  "mapping 1 #4000", &S::xacc, &S::yacc, &S::zacc),
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

using N = messages::NavControllerOutput;
inline constexpr std::tuple nav_controller_output{
    row(&State::commanded_heading, rules::navigation_bearing, "mapping 1 #3002", &N::nav_bearing),
    row(&State::commanded_course,  rules::navigation_bearing, "mapping 1 #3002", &N::target_bearing),
    row(&State::commanded_roll,    rules::navigation_roll,    "mapping 1 #3002", &N::nav_roll),
    row(&State::arrival,           rules::arrival,            "mapping 1 #4001", &N::wp_dist),
};

inline constexpr std::tuple sys_status{
    row(&State::energy_level, rules::remaining_in_tenths, "mapping 1 #3002", &messages::SysStatus::battery_remaining),
};
// clang-format on

}  // namespace rows::v09

inline constexpr std::tuple telemetry_tables_v09{
    rows::v09::attitude, rows::v09::global_position_int, rows::v09::global_position,       rows::v09::scaled_imu,
    rows::v09::vfr_hud,  rows::v09::scaled_pressure,     rows::v09::nav_controller_output, rows::v09::sys_status,
};

}  // namespace ponte::autopilot
