#include "ponte/autopilot/telemetry_rows.hpp"

#include "ponte/autopilot/vehicle_monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ponte::autopilot {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr WallTime now = wall_time_from_unix_us(1'700'000'000'000'000);
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double pi = 3.14159265358979;
constexpr std::nullopt_t nothing = std::nullopt;

/// What the row of one fact made of one message, and what it should have made of it, in the fact's unit.
struct Case {
  std::string_view message;
  std::string_view target;
  std::string_view story;
  std::optional<double> made;
  std::optional<double> expected;
};

template <class Unit>
double number_of(Quantity<Unit> value) {
  return value.value;
}
double number_of(WallTime time) { return std::chrono::duration<double>(time - now).count(); }

template <class Row, class T, class M>
void try_row(const Row& row, vehicle::FactOf<T> target, const M& message, const MappingContext& context,
             std::optional<double>& made, int& rows_found) {
  if constexpr (requires {
                  row.target == target;
                  row.convert(message, context);
                }) {
    if (row.target != target) return;
    ++rows_found;
    if (const auto value = row.convert(message, context)) made = number_of(*value);
  }
}

class Cases {
 public:
  template <class T, mavlink::Message M>
  void add(vehicle::FactOf<T> target, const M& message, std::string_view story, std::optional<double> expected,
           const State& before = {}) {
    std::optional<double> made;
    int rows_found = 0;
    const MappingContext context{before, now};
    const auto try_rows = [&](const auto&... row) { (try_row(row, target, message, context, made, rows_found), ...); };
    std::apply([&](const auto&... table) { (std::apply(try_rows, table), ...); }, telemetry_tables);
    EXPECT_EQ(rows_found, 1) << M::info.name << " -> " << vehicle::name_of(target);
    cases.push_back({M::info.name, vehicle::name_of(target), story, made, expected});
  }

  std::vector<Case> cases;
};

/// A state in which `fact` was learnt `age` ago.
template <class T>
State& with(State& state, vehicle::FactOf<T> fact, const T& value, milliseconds age = {}) {
  (state.*fact).learn(value, {now - age, Timestamp{}, 1});
  return state;
}

State in_mode(vehicle::ModeKind kind) {
  State state;
  return with(state, &State::mode, vehicle::Mode{kind, 0, {}});
}

State airframe(std::uint8_t mav_type) {
  State state;
  return with(state, &State::identity, vehicle::Identity{3, mav_type, {}});
}

State attitude(double roll, double pitch, double heading, milliseconds age = {}) {
  State state;
  with(state, &State::roll, Radians{roll}, age);
  with(state, &State::pitch, Radians{pitch}, age);
  return with(state, &State::heading, Radians{heading}, age);
}

void add_attitude(Cases& all) {
  using messages::Attitude;
  all.add(&State::roll, Attitude{.roll = 0.1F}, "right wing down", 0.1);
  all.add(&State::roll, Attitude{.roll = nan}, "NaN", nothing);
  all.add(&State::pitch, Attitude{.pitch = -0.2F}, "nose down", -0.2);
  all.add(&State::pitch, Attitude{.pitch = infinity}, "infinite", nothing);
  all.add(&State::heading, Attitude{.yaw = 3.0F}, "nearly south", 3.0);
  all.add(&State::heading, Attitude{.yaw = nan}, "NaN", nothing);

  // Roll 30 degrees, pitch 45: sin 0.5, cos 0.8660254, tan 1, cos 0.70710678; q sin + r cos = 0.1 - 0.08660254.
  const Attitude banked{
      .roll = 0.52359878F, .pitch = 0.78539816F, .rollspeed = 0.3F, .pitchspeed = 0.2F, .yawspeed = -0.1F};
  all.add(&State::roll_rate, banked, "banked and climbing", 0.31339746);
  all.add(&State::pitch_rate, banked, "banked and climbing", 0.22320508);
  all.add(&State::turn_rate, banked, "banked and climbing", 0.01894687);
  const Attitude level{.rollspeed = 0.3F, .pitchspeed = 0.2F, .yawspeed = -0.1F};
  all.add(&State::roll_rate, level, "level: body rates", 0.3);
  all.add(&State::pitch_rate, level, "level: body rates", 0.2);
  all.add(&State::turn_rate, level, "level: body rates", -0.1);
  for (const float pitch : {1.5533F, -1.5533F, 1.6F, nan}) {
    const Attitude vertical{.pitch = pitch, .rollspeed = 0.1F, .pitchspeed = 0.1F, .yawspeed = 0.1F};
    all.add(&State::roll_rate, vertical, "near the vertical", nothing);
    all.add(&State::pitch_rate, vertical, "near the vertical", nothing);
    all.add(&State::turn_rate, vertical, "near the vertical", nothing);
  }
  const Attitude unknown{.rollspeed = nan, .pitchspeed = nan, .yawspeed = nan};
  all.add(&State::roll_rate, unknown, "NaN", nothing);
  all.add(&State::pitch_rate, unknown, "NaN", nothing);
  all.add(&State::turn_rate, unknown, "NaN", nothing);
}

void add_position(Cases& all) {
  using messages::GlobalPositionInt;
  const GlobalPositionInt lisbon{
      .lat = 387223000, .lon = -91393000, .alt = 120500, .relative_alt = 99000, .vx = 1230, .vy = -450, .vz = -100};
  all.add(&State::latitude, lisbon, "north", 0.675831629);
  all.add(&State::longitude, lisbon, "west", -0.159510876);
  all.add(&State::altitude_msl, lisbon, "of the sea, not of home", 120.5);
  all.add(&State::north_speed, lisbon, "north", 12.3);
  all.add(&State::east_speed, lisbon, "west", -4.5);
  all.add(&State::down_speed, lisbon, "climbing", -1.0);
  const GlobalPositionInt without{.lat = 0, .lon = 0, .alt = 1000, .relative_alt = 0, .vx = 1, .vy = 1, .vz = 1};
  all.add(&State::latitude, without, "no position yet", nothing);
  all.add(&State::longitude, without, "no position yet", nothing);
  all.add(&State::altitude_msl, without, "no position yet", nothing);
  all.add(&State::north_speed, without, "no position yet", nothing);
  all.add(&State::east_speed, without, "no position yet", nothing);
  all.add(&State::down_speed, without, "no position yet", nothing);
  all.add(&State::latitude, GlobalPositionInt{.lat = 0, .lon = 1}, "on the equator", 0.0);
  all.add(&State::longitude, GlobalPositionInt{.lat = 1, .lon = 0}, "on the meridian of Greenwich", 0.0);
}

void add_heights(Cases& all) {
  using messages::DistanceSensor;
  const DistanceSensor down{.min_distance = 20, .max_distance = 4000, .current_distance = 1234, .orientation = 25};
  const auto changed = [&](auto change) {
    auto sensor = down;
    change(sensor);
    return sensor;
  };
  const auto height = &State::height_above_ground;
  all.add(height, down, "cm", 12.34);
  all.add(height, changed([](auto& it) { it.signal_quality = 100; }), "good signal", 12.34);
  all.add(height, changed([](auto& it) { it.signal_quality = 1; }), "invalid signal", nothing);
  all.add(height, changed([](auto& it) { it.orientation = 0; }), "looks ahead", nothing);
  all.add(height, changed([](auto& it) { it.orientation = 24; }), "looks up", nothing);
  all.add(height, changed([](auto& it) { it.current_distance = 4001; }), "nothing in range", nothing);
  all.add(height, changed([](auto& it) { it.current_distance = 0; }), "below its range", nothing);

  all.add(height, messages::Altitude{.altitude_amsl = 500, .altitude_relative = 50, .altitude_terrain = 40}, "m", 40.0);
  all.add(height, messages::Altitude{.altitude_terrain = -1001}, "below -1000 m: unknown", nothing);
  all.add(height, messages::Altitude{.altitude_terrain = nan}, "NaN", nothing);

  all.add(height, messages::TerrainReport{.spacing = 100, .terrain_height = 300, .current_height = 55}, "m", 55.0);
  all.add(height, messages::TerrainReport{.spacing = 0, .current_height = 55}, "terrain not loaded", nothing);
  all.add(height, messages::TerrainReport{.spacing = 100, .current_height = nan}, "NaN", nothing);

  using messages::GpsRawInt;
  const auto ellipsoid = &State::altitude_ellipsoid;
  all.add(ellipsoid, GpsRawInt{.fix_type = 3, .alt = 50000, .alt_ellipsoid = 103250}, "mm", 103.25);
  all.add(ellipsoid, GpsRawInt{.fix_type = 3, .alt = 50000, .alt_ellipsoid = -2500}, "below the ellipsoid", -2.5);
  all.add(ellipsoid, GpsRawInt{.fix_type = 3, .alt = 50000, .alt_ellipsoid = 0}, "not told, as in MAVLink 1", nothing);
  all.add(ellipsoid, GpsRawInt{.fix_type = 2, .alt_ellipsoid = 103250}, "2D fix", nothing);

  all.add(&State::home_altitude_msl, messages::HomePosition{.altitude = 50090}, "mm", 50.09);
}

void add_sensors(Cases& all) {
  using messages::HighresImu;
  constexpr std::uint16_t everything = 63;
  const HighresImu imu{.xacc = 1,
                       .yacc = -2,
                       .zacc = -9.80665F,
                       .xgyro = 0.1F,
                       .ygyro = -0.2F,
                       .zgyro = 0.3F,
                       .fields_updated = everything};
  const auto accelerations =
      std::array{&State::body_x_acceleration, &State::body_y_acceleration, &State::body_z_acceleration};
  const auto rates = std::array{&State::body_roll_rate, &State::body_pitch_rate, &State::body_yaw_rate};
  const auto earth = std::array{&State::north_acceleration, &State::east_acceleration, &State::down_acceleration};
  const std::array sensed{1.0, -2.0, -9.80665};
  const std::array turned{0.1, -0.2, 0.3};
  const auto north_up = attitude(0, 0, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.add(accelerations[axis], imu, "m/s^2", sensed[axis]);
    all.add(rates[axis], imu, "rad/s", turned[axis]);
    auto other = imu;
    other.id = 1;
    all.add(accelerations[axis], other, "the second IMU", nothing);
    all.add(rates[axis], other, "the second IMU", nothing);
    all.add(earth[axis], other, "the second IMU", nothing, north_up);
    auto partial = imu;
    partial.fields_updated = static_cast<std::uint16_t>(everything ^ 1U << axis);
    all.add(accelerations[axis], partial, "not updated", nothing);
    all.add(rates[axis], partial, "others not updated", turned[axis]);
    all.add(earth[axis], partial, "one axis not updated", nothing, north_up);
    partial.fields_updated = static_cast<std::uint16_t>(everything ^ 8U << axis);
    all.add(rates[axis], partial, "not updated", nothing);
    const HighresImu unknown{
        .xacc = nan, .yacc = nan, .zacc = nan, .xgyro = nan, .ygyro = nan, .zgyro = nan, .fields_updated = everything};
    all.add(accelerations[axis], unknown, "NaN", nothing);
    all.add(rates[axis], unknown, "NaN", nothing);
    all.add(earth[axis], unknown, "NaN", nothing, north_up);
  }

  using messages::ScaledImu;
  const ScaledImu scaled{.xacc = 1000, .yacc = -500, .zacc = -1000, .xgyro = 100, .ygyro = -200, .zgyro = 300};
  const std::array scaled_sensed{9.80665, -4.903325, -9.80665};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.add(accelerations[axis], scaled, "mG", scaled_sensed[axis]);
    all.add(rates[axis], scaled, "mrad/s", turned[axis]);
  }

  // What each attitude makes of a sensed acceleration, in both messages. At rest the sensor feels the ground push up.
  struct Push {
    std::string_view story;
    State before;
    std::array<double, 3> body;  ///< m/s^2
    std::array<double, 3> earth;
  };
  constexpr double gravity = 9.80665;
  const std::vector<Push> pushes{
      {"at rest, level", attitude(0, 0, 1), {0, 0, -gravity}, {0, 0, 0}},
      {"at rest, right wing 30 degrees down", attitude(pi / 6, 0, 0), {0, -4.903325, -8.492808}, {0, 0, 0}},
      {"at rest, nose 30 degrees up", attitude(0, pi / 6, 2), {4.903325, 0, -8.492808}, {0, 0, 0}},
      {"nose north, pushed ahead", attitude(0, 0, 0), {3, 0, -gravity}, {3, 0, 0}},
      {"nose east, pushed ahead", attitude(0, 0, pi / 2), {3, 0, -gravity}, {0, 3, 0}},
      {"nose east, pushed to the right", attitude(0, 0, pi / 2), {0, 2, -gravity}, {-2, 0, 0}},
      {"falling freely", attitude(0, 0, 0), {0, 0, 0}, {0, 0, gravity}},
      {"on the right wing, pushed along the left one", attitude(pi / 2, 0, 0), {0, -gravity - 1, 0}, {0, 0, -1}},
  };
  for (const auto& push : pushes) {
    const HighresImu precise{.xacc = static_cast<float>(push.body[0]),
                             .yacc = static_cast<float>(push.body[1]),
                             .zacc = static_cast<float>(push.body[2]),
                             .fields_updated = 7};
    for (std::size_t axis = 0; axis < 3; ++axis)
      all.add(earth[axis], precise, push.story, push.earth[axis], push.before);
  }
  const std::array at_rest{0.0, 0.0, 0.0};
  const ScaledImu pushed_ahead{.xacc = 1000, .yacc = 0, .zacc = -1000};
  const std::array to_the_east{0.0, gravity, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.add(earth[axis], ScaledImu{.zacc = -1000}, "at rest", at_rest[axis], north_up);
    all.add(earth[axis], pushed_ahead, "nose east", to_the_east[axis], attitude(0, 0, pi / 2));
    all.add(earth[axis], pushed_ahead, "no attitude", nothing);
    all.add(earth[axis], pushed_ahead, "old attitude", nothing, attitude(0, 0, 0, milliseconds{501}));
    for (const auto angle : {&State::roll, &State::pitch, &State::heading}) {
      auto partly = attitude(0.1, 0.1, 0.1);  // the newest attitude left this angle out
      partly.*angle = {};
      all.add(earth[axis], pushed_ahead, "never a whole attitude", nothing,
              with(partly, angle, Radians{0.1}, milliseconds{20}));
    }
    all.add(earth[axis], imu, "no attitude", nothing);
    all.add(earth[axis], imu, "old attitude", nothing, attitude(0, 0, 0, milliseconds{501}));
  }
}

void add_air(Cases& all) {
  using messages::VfrHud;
  constexpr std::uint8_t fixed_wing = 1;
  constexpr std::uint8_t quadrotor = 2;
  const VfrHud hud{.airspeed = 20, .groundspeed = 25, .throttle = 55, .alt = 320.5F, .climb = -1.5F};
  const VfrHud still{.airspeed = 0};
  all.add(&State::indicated_airspeed, hud, "m/s", 20.0);
  all.add(&State::indicated_airspeed, still, "a plane in still air", 0.0, airframe(fixed_wing));
  all.add(&State::indicated_airspeed, still, "a copter without sensor", nothing, airframe(quadrotor));
  all.add(&State::indicated_airspeed, still, "who knows what it is", nothing);
  all.add(&State::indicated_airspeed, VfrHud{.airspeed = nan}, "NaN", nothing);
  all.add(&State::indicated_airspeed, VfrHud{.airspeed = -1}, "negative", nothing);

  // 3000 m in the standard atmosphere: 0.90912 kg/m^3.
  State high;
  with(high, &State::static_pressure, Pascals{70108.5});
  all.add(&State::true_airspeed, hud, "temperature not known", nothing, high);
  with(high, &State::air_temperature, Kelvins{268.65});
  all.add(&State::true_airspeed, hud, "at 3000 m", 23.215983, high);
  auto without_pressure = high;  // the newest sample left the pressure out
  with(without_pressure, &State::air_temperature, Kelvins{268.65}, milliseconds{-20});
  all.add(&State::true_airspeed, hud, "pressure of an older sample", nothing, without_pressure);
  State old;
  with(old, &State::static_pressure, Pascals{70108.5}, milliseconds{5001});
  with(old, &State::air_temperature, Kelvins{268.65}, milliseconds{5001});
  all.add(&State::true_airspeed, hud, "old air", nothing, old);
  all.add(&State::true_airspeed, VfrHud{.airspeed = nan}, "NaN", nothing, high);
  all.add(&State::true_airspeed, still, "no sensor", nothing, high);
  all.add(&State::true_airspeed, hud, "pressure not known", nothing);

  all.add(&State::barometric_altitude, hud, "m", 320.5);
  all.add(&State::barometric_altitude, VfrHud{.alt = nan}, "NaN", nothing);
  all.add(&State::climb_rate, hud, "sinking", -1.5);
  all.add(&State::climb_rate, VfrHud{.climb = nan}, "NaN", nothing);
  all.add(&State::power_level, hud, "%", 55.0);

  using messages::ScaledPressure;
  const ScaledPressure pressure{.press_abs = 898.75F, .press_diff = 1, .temperature = 2000};
  all.add(&State::static_pressure, pressure, "hPa", 89875.0);
  all.add(&State::pressure_altitude, pressure, "1000 m in the standard atmosphere", 999.95939);
  all.add(&State::pressure_altitude, ScaledPressure{.press_abs = 1013.25F}, "sea level", 0.0);
  all.add(&State::air_temperature, pressure, "20 degrees C", 293.15);
  all.add(&State::air_temperature, ScaledPressure{.temperature = -27315}, "absolute zero", nothing);
  for (const float none : {0.0F, -5.0F, nan}) {
    all.add(&State::static_pressure, ScaledPressure{.press_abs = none}, "no pressure", nothing);
    all.add(&State::pressure_altitude, ScaledPressure{.press_abs = none}, "no pressure", nothing);
  }

  using messages::Wind;
  all.add(&State::north_wind, Wind{.direction = 0, .speed = 5}, "from the north", -5.0);
  all.add(&State::east_wind, Wind{.direction = 0, .speed = 5}, "from the north", 0.0);
  all.add(&State::north_wind, Wind{.direction = -90, .speed = 5}, "from the west", 0.0);
  all.add(&State::east_wind, Wind{.direction = -90, .speed = 5}, "from the west", 5.0);
  all.add(&State::north_wind, Wind{.direction = nan, .speed = 5}, "NaN", nothing);
  all.add(&State::east_wind, Wind{.direction = 0, .speed = nan}, "NaN", nothing);
  using messages::WindCov;
  all.add(&State::north_wind, WindCov{.wind_x = 3}, "towards north", 3.0);
  all.add(&State::east_wind, WindCov{.wind_y = -4}, "towards west", -4.0);
  all.add(&State::north_wind, WindCov{.wind_x = nan}, "NaN", nothing);
  all.add(&State::east_wind, WindCov{.wind_y = nan}, "NaN", nothing);

  using messages::AoaSsa;
  all.add(&State::angle_of_attack, AoaSsa{.aoa = 10}, "10 degrees", pi / 18);
  all.add(&State::angle_of_attack, AoaSsa{.aoa = nan}, "NaN", nothing);
  all.add(&State::sideslip, AoaSsa{.ssa = -10}, "10 degrees", -pi / 18);
  all.add(&State::sideslip, AoaSsa{.ssa = nan}, "NaN", nothing);
}

void add_commands(Cases& all) {
  using enum vehicle::ModeKind;
  using messages::NavControllerOutput;
  const NavControllerOutput output{.nav_roll = 30, .nav_bearing = -90, .target_bearing = 180, .wp_dist = 300};
  for (const auto kind : {mission, hold, guided, land, take_off, return_home, smart_return, vtol_return}) {
    all.add(&State::commanded_heading, output, "navigates", -pi / 2, in_mode(kind));
    all.add(&State::commanded_course, output, "navigates", pi, in_mode(kind));
    all.add(&State::commanded_roll, output, "navigates", pi / 6, in_mode(kind));
  }
  for (const auto& before : {in_mode(none), in_mode(manual), in_mode(other), State{}}) {
    all.add(&State::commanded_heading, output, "does not navigate", nothing, before);
    all.add(&State::commanded_course, output, "does not navigate", nothing, before);
    all.add(&State::commanded_roll, output, "does not navigate", nothing, before);
  }
  all.add(&State::commanded_roll, NavControllerOutput{.nav_roll = nan}, "NaN", nothing, in_mode(mission));

  const auto flying = [](vehicle::ModeKind kind, double north, double east) {
    auto state = in_mode(kind);
    with(state, &State::north_speed, MetresPerSecond{north});
    return with(state, &State::east_speed, MetresPerSecond{east});
  };
  all.add(&State::arrival, output, "300 m at 5 m/s", 60.0, flying(mission, 3, -4));
  all.add(&State::arrival, output, "too slow to tell", nothing, flying(mission, 0.3, 0.3));
  all.add(&State::arrival, output, "speed not known", nothing, in_mode(mission));
  all.add(&State::arrival, output, "on the way home: not to a waypoint", nothing, flying(return_home, 3, 4));
  all.add(&State::arrival, output, "holding: not to a waypoint", nothing, flying(hold, 3, 4));

  using messages::PositionTargetGlobalInt;
  State home;
  with(home, &State::home_altitude_msl, Metres{50});
  const auto altitude = &State::commanded_altitude_msl;
  const auto height = &State::commanded_height_above_ground;
  for (const auto global : std::to_array<std::uint8_t>({0, 5})) {
    const PositionTargetGlobalInt target{.coordinate_frame = global, .alt = 100};
    all.add(altitude, target, "above the sea", 100.0, home);
    all.add(height, target, "above the sea", nothing, home);
  }
  for (const auto relative : std::to_array<std::uint8_t>({3, 6})) {
    const PositionTargetGlobalInt target{.coordinate_frame = relative, .alt = 100};
    all.add(altitude, target, "above home", 150.0, home);
    all.add(altitude, target, "above a home that is not known", nothing);
    all.add(height, target, "above home", nothing, home);
  }
  for (const auto terrain : std::to_array<std::uint8_t>({10, 11})) {
    const PositionTargetGlobalInt target{.coordinate_frame = terrain, .alt = 100};
    all.add(altitude, target, "above terrain", nothing, home);
    all.add(height, target, "above terrain", 100.0, home);
  }
  all.add(altitude, PositionTargetGlobalInt{.coordinate_frame = 5, .type_mask = 4, .alt = 100}, "masked", nothing);
  all.add(altitude, PositionTargetGlobalInt{.coordinate_frame = 5, .type_mask = 3, .alt = 100}, "x, y masked", 100.0);
  all.add(altitude, PositionTargetGlobalInt{.coordinate_frame = 5, .alt = nan}, "NaN", nothing);
  all.add(height, PositionTargetGlobalInt{.coordinate_frame = 11, .type_mask = 4, .alt = 100}, "masked", nothing);
  all.add(height, PositionTargetGlobalInt{.coordinate_frame = 11, .alt = nan}, "NaN", nothing);
  all.add(&State::commanded_heading, PositionTargetGlobalInt{.yaw = 1.5F}, "rad", 1.5);
  all.add(&State::commanded_heading, PositionTargetGlobalInt{.type_mask = 1024, .yaw = 1.5F}, "masked", nothing);
  all.add(&State::commanded_heading, PositionTargetGlobalInt{.type_mask = 2048, .yaw = 1.5F}, "rate masked", 1.5);
  all.add(&State::commanded_heading, PositionTargetGlobalInt{.yaw = nan}, "NaN", nothing);

  using messages::AttitudeTarget;
  const AttitudeTarget rolled{.q = {0.9659258F, 0.2588190F, 0, 0}};
  const AttitudeTarget turned{.q = {0.70710678F, 0, 0, -0.70710678F}};
  all.add(&State::commanded_roll, rolled, "30 degrees", pi / 6);
  all.add(&State::commanded_roll, turned, "heading only", 0.0);
  all.add(&State::commanded_heading, rolled, "roll only", 0.0);
  all.add(&State::commanded_heading, turned, "west", -pi / 2);
  for (const AttitudeTarget& none : {AttitudeTarget{.type_mask = 128, .q = rolled.q}, AttitudeTarget{.q = {0, 0, 0, 0}},
                                     AttitudeTarget{.q = {nan, nan, nan, nan}}}) {
    all.add(&State::commanded_roll, none, "masked, zeros or NaN", nothing);
    all.add(&State::commanded_heading, none, "masked, zeros or NaN", nothing);
  }
}

void add_energy(Cases& all) {
  using messages::BatteryStatus;
  all.add(&State::energy_level, BatteryStatus{.id = 0, .battery_remaining = 50}, "%", 50.0);
  all.add(&State::energy_level, BatteryStatus{.id = 0, .battery_remaining = 0}, "empty", 0.0);
  all.add(&State::energy_level, BatteryStatus{.id = 0, .battery_remaining = -1}, "not known", nothing);
  all.add(&State::energy_level, BatteryStatus{.id = 1, .battery_remaining = 50}, "the second battery", nothing);
  all.add(&State::energy_level, messages::SysStatus{.battery_remaining = 73}, "%", 73.0);
  all.add(&State::energy_level, messages::SysStatus{.battery_remaining = -1}, "not known", nothing);
}

const std::vector<Case>& all_cases() {
  static const auto cases = [] {
    Cases all;
    add_attitude(all);
    add_position(all);
    add_heights(all);
    add_sensors(all);
    add_air(all);
    add_commands(all);
    add_energy(all);
    return all.cases;
  }();
  return cases;
}

TEST(TelemetryRows, MakeOfEveryMessageWhatTheMappingSays) {
  for (const auto& each : all_cases()) {
    SCOPED_TRACE(std::string{each.message} + " -> " + std::string{each.target} + ": " + std::string{each.story});
    ASSERT_EQ(each.made.has_value(), each.expected.has_value());
    if (each.made) {
      EXPECT_NEAR(*each.made, *each.expected, 1e-5 * std::max(1.0, std::abs(*each.expected)));
    }
  }
}

std::ptrdiff_t count_cases(const RowText& row, bool with_value) {
  return std::ranges::count_if(all_cases(), [&](const Case& each) {
    return each.message == row.message && each.target == row.target && each.expected.has_value() == with_value;
  });
}

TEST(TelemetryRows, HaveACaseEachAndOneForNothingWhereTheyCanSayNothing) {
  EXPECT_GE(telemetry_row_texts().size(), 60U);
  EXPECT_GE(telemetry_row_texts_v09().size(), 30U);
  for (const auto& row : telemetry_row_texts()) {
    SCOPED_TRACE(std::string{row.message} + " -> " + std::string{row.target});
    EXPECT_GE(count_cases(row, true), 1) << "no test says what this row should make of a value";
    // Integers that are always a value.
    const bool is_always_told = row.rule == rules::throttle.text || row.rule == rules::millimetres.text ||
                                row.rule == rules::milli_gravity.text ||
                                row.rule == rules::milliradians_per_second.text;
    if (!is_always_told) {
      EXPECT_GE(count_cases(row, false), 1) << "no test says when this row should say nothing";
    }
  }
}

TEST(TelemetryRows, NameTheirSourcesTargetAndReference) {
  for (const auto& row : telemetry_row_texts()) {
    SCOPED_TRACE(std::string{row.message} + " -> " + std::string{row.target});
    EXPECT_FALSE(row.sources[0].empty());
    EXPECT_FALSE(row.target.empty());
    EXPECT_FALSE(row.rule.empty());
    EXPECT_TRUE(row.reference.starts_with("mapping ")) << row.reference;
    if (row.target != "arrival") {
      EXPECT_FALSE(row.unit.empty());
    }
  }
}

TEST(TelemetryRows, GiveTheSourcesOfOneFactDifferentRanksUnlessTheyExcludeOneAnother) {
  const auto texts = telemetry_row_texts();
  for (const auto& one : texts)
    for (const auto& another : texts) {
      if (&one == &another || one.target != another.target || one.rank != another.rank) continue;
      // The two autopilots send one or the other.
      const bool are_winds = one.target == "north_wind" || one.target == "east_wind";
      const bool are_headings = one.target == "commanded_heading" && one.rank == 1;
      EXPECT_TRUE(are_winds || are_headings) << one.target << " from " << one.message << " and " << another.message;
    }
}

// A number whose unit changes in the MAVLink definition would pass unnoticed through every other test here.
TEST(TelemetryRows, ReadFieldsInTheUnitsOfTheDefinition) {
  const auto expect_unit = [](const mavlink::MessageInfo& message, std::string_view field, std::string_view unit) {
    const auto found = std::ranges::find(message.fields, field, &mavlink::FieldInfo::name);
    ASSERT_NE(found, message.fields.end()) << message.name << '.' << field;
    EXPECT_EQ(found->unit, unit) << message.name << '.' << field;
  };
  expect_unit(messages::Attitude::info, "roll", "rad");
  expect_unit(messages::Attitude::info, "rollspeed", "rad/s");
  expect_unit(messages::GlobalPositionInt::info, "lat", "degE7");
  expect_unit(messages::GlobalPositionInt::info, "alt", "mm");
  expect_unit(messages::GlobalPositionInt::info, "vz", "cm/s");
  expect_unit(messages::HighresImu::info, "xacc", "m/s/s");
  expect_unit(messages::HighresImu::info, "xgyro", "rad/s");
  expect_unit(messages::ScaledImu::info, "xacc", "mG");
  expect_unit(messages::ScaledImu::info, "xgyro", "mrad/s");
  expect_unit(messages::VfrHud::info, "airspeed", "m/s");
  expect_unit(messages::VfrHud::info, "throttle", "%");
  expect_unit(messages::ScaledPressure::info, "press_abs", "hPa");
  expect_unit(messages::ScaledPressure::info, "temperature", "cdegC");
  expect_unit(messages::Wind::info, "direction", "deg");
  expect_unit(messages::WindCov::info, "wind_x", "m/s");
  expect_unit(messages::AoaSsa::info, "AOA", "deg");
  expect_unit(messages::DistanceSensor::info, "current_distance", "cm");
  expect_unit(messages::Altitude::info, "altitude_terrain", "m");
  expect_unit(messages::TerrainReport::info, "current_height", "m");
  expect_unit(messages::GpsRawInt::info, "alt_ellipsoid", "mm");
  expect_unit(messages::HomePosition::info, "altitude", "mm");
  expect_unit(messages::NavControllerOutput::info, "nav_bearing", "deg");
  expect_unit(messages::NavControllerOutput::info, "nav_roll", "deg");
  expect_unit(messages::NavControllerOutput::info, "wp_dist", "m");
  expect_unit(messages::PositionTargetGlobalInt::info, "alt", "m");
  expect_unit(messages::PositionTargetGlobalInt::info, "yaw", "rad");
  expect_unit(messages::BatteryStatus::info, "battery_remaining", "%");
}

}  // namespace
}  // namespace ponte::autopilot
