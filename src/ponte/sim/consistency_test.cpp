// What the vehicle says about one flight in different messages has to fit together.
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/local_position_ned.hpp"
#include "ponte/mavlink/autopilots/nav_controller_output.hpp"
#include "ponte/mavlink/autopilots/position_target_global_int.hpp"
#include "ponte/mavlink/autopilots/raw_imu.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/scaled_pressure.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"
#include "ponte/sim/telemetry_messages.hpp"
#include "ponte/sim/test_station.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ponte::sim {
namespace {

/// A minute of the square, at 50 Hz, from the take-off on.
TestStation flown(double noise) {
  TestStation station{{.noise = noise}};
  station.wait(seconds{9});
  station.arm();
  station.send(messages::RequestDataStream{.target_system = 1, .req_message_rate = 50, .start_stop = 1});
  station.forget();
  station.wait(minutes{1});
  return station;
}

const TestStation& exact() {
  static const auto station = flown(0);
  return station;
}

constexpr double dt = 0.02;

Position position_of(const messages::GlobalPositionInt& message) {
  return {radians_from_degrees(message.lat * 1e-7), radians_from_degrees(message.lon * 1e-7),
          Metres{message.alt * 1e-3}};
}

TEST(Consistency, VelocityIsTheChangeOfPosition) {
  const auto messages = exact().all<messages::GlobalPositionInt>();
  ASSERT_GT(messages.size(), 2900U);
  NorthEastDown flown{};
  for (std::size_t i = 1; i < messages.size(); ++i) {
    const auto& [a, b] = std::pair{messages[i - 1], messages[i]};
    flown = flown + NorthEastDown{0.01 * (a.vx + b.vx), 0.01 * (a.vy + b.vy), 0.01 * (a.vz + b.vz)} * (dt / 2);
    const auto moved = offset_between(position_of(messages.front()), position_of(b));
    ASSERT_NEAR(flown.north, moved.north, 0.1);
    ASSERT_NEAR(flown.east, moved.east, 0.1);
    ASSERT_NEAR(flown.down, moved.down, 0.1);
  }
}

TEST(Consistency, RatesAreTheChangeOfAttitude) {
  const auto messages = exact().all<messages::Attitude>();
  double fastest{};
  for (std::size_t i = 1; i < messages.size(); ++i) {
    const auto attitude = [](const messages::Attitude& each) {
      return Attitude{Radians{each.roll}, Radians{each.pitch}, Radians{each.yaw}};
    };
    const auto rates = body_rates(attitude(messages[i - 1]), attitude(messages[i]), dt);
    ASSERT_NEAR(rates.x, messages[i].rollspeed, 1e-4);
    ASSERT_NEAR(rates.y, messages[i].pitchspeed, 1e-4);
    ASSERT_NEAR(rates.z, messages[i].yawspeed, 1e-4);
    fastest = std::max(fastest, std::abs(rates.z));
  }
  EXPECT_GT(fastest, 0.5) << "it has turned";
}

TEST(Consistency, TheHeadUpDisplayShowsTheSame) {
  const auto positions = exact().all<messages::GlobalPositionInt>();
  const auto displays = exact().all<messages::VfrHud>();
  const auto locals = exact().all<messages::LocalPositionNed>();
  ASSERT_EQ(positions.size(), displays.size());
  ASSERT_EQ(positions.size(), locals.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto& position = positions[i];
    const auto& display = displays[i];
    ASSERT_NEAR(display.groundspeed, std::hypot(position.vx, position.vy) * 0.01, 0.01);
    ASSERT_NEAR(display.airspeed, std::hypot(position.vx, position.vy, position.vz) * 0.01, 0.01);
    ASSERT_NEAR(display.climb, -position.vz * 0.01, 0.0051);
    ASSERT_NEAR(display.alt, position.alt * 1e-3, 0.001);
    ASSERT_NEAR(display.heading, position.hdg * 0.01 - 0.5, 0.51);
    ASSERT_EQ(position.alt - position.relative_alt, 50'000);
    const auto offset = offset_between(VehicleConfig{}.start, position_of(position));
    ASSERT_NEAR(locals[i].x, offset.north, 0.02);
    ASSERT_NEAR(locals[i].y, offset.east, 0.02);
    ASSERT_NEAR(locals[i].z, offset.down, 0.002);
  }
}

TEST(Consistency, TheAccelerometerFeelsTheChangeOfVelocity) {
  const auto attitudes = exact().all<messages::Attitude>();
  const auto locals = exact().all<messages::LocalPositionNed>();
  const auto sensors = exact().all<messages::RawImu>();
  for (std::size_t i = 1; i < sensors.size(); ++i) {
    const Attitude attitude{Radians{attitudes[i].roll}, Radians{attitudes[i].pitch}, Radians{attitudes[i].yaw}};
    const auto felt = to_body(attitude, {(locals[i].vx - locals[i - 1].vx) / dt, (locals[i].vy - locals[i - 1].vy) / dt,
                                         (locals[i].vz - locals[i - 1].vz) / dt - standard_gravity});
    ASSERT_NEAR(sensors[i].xacc, felt.x / standard_gravity * 1000, 1);
    ASSERT_NEAR(sensors[i].yacc, felt.y / standard_gravity * 1000, 1);
    ASSERT_NEAR(sensors[i].zacc, felt.z / standard_gravity * 1000, 1);
    ASSERT_NEAR(sensors[i].zgyro, attitudes[i].yawspeed * 1000, 0.51);
  }
}

TEST(Consistency, TheTargetIsWhereItGoes) {
  const auto positions = exact().all<messages::GlobalPositionInt>();
  const auto targets = exact().all<messages::PositionTargetGlobalInt>();
  const auto navigation = exact().all<messages::NavControllerOutput>();
  ASSERT_GT(targets.size(), 2000U);
  const auto late = positions.size() - targets.size();  // targets begin with the take-off
  for (std::size_t i = 0; i < targets.size(); ++i) {
    ASSERT_EQ(targets[i].time_boot_ms, positions[i + late].time_boot_ms);
    const Position target{radians_from_degrees(targets[i].lat_int * 1e-7),
                          radians_from_degrees(targets[i].lon_int * 1e-7), Metres{targets[i].alt}};
    const auto offset = offset_between(position_of(positions[i + late]), target);
    const auto& output = navigation[i + late];
    ASSERT_NEAR(output.wp_dist, horizontal(offset), 0.6);
    ASSERT_NEAR(output.alt_error, -offset.down, 0.01);
    if (horizontal(offset) < 5) continue;
    const double bearing = compass_degrees(std::atan2(offset.east, offset.north));
    ASSERT_NEAR(wrapped((output.target_bearing + 0.5 - bearing) / degrees_per_radian), 0, 0.7 / degrees_per_radian);
  }
}

TEST(Consistency, BothBatteryMessagesShowTheSame) {
  const auto batteries = exact().all<messages::BatteryStatus>();
  const auto states = exact().all<messages::SysStatus>();
  ASSERT_EQ(batteries.size(), states.size());
  for (std::size_t i = 0; i < batteries.size(); ++i) {
    ASSERT_EQ(batteries[i].voltages[0], states[i].voltage_battery);
    ASSERT_EQ(batteries[i].voltages[1], 65535);
    ASSERT_EQ(batteries[i].current_battery, states[i].current_battery);
    ASSERT_EQ(batteries[i].battery_remaining, states[i].battery_remaining);
  }
  EXPECT_GT(batteries.back().current_consumed, batteries.front().current_consumed);
}

TEST(Consistency, ThePressureFallsWithTheAltitude) {
  const auto pressures = exact().all<messages::ScaledPressure>();
  EXPECT_NEAR(pressures.front().press_abs, 1007.26, 0.01) << "50 m";
  EXPECT_NEAR(pressures.back().press_abs, 1004.87, 0.06) << "70 m";
  EXPECT_EQ(pressures.front().temperature, 1468);
}

TEST(Consistency, NoiseIsSmallAndHasNoBias) {
  TestStation station{{}};
  station.wait(seconds{9});
  station.send(messages::RequestDataStream{.target_system = 1, .req_message_rate = 50, .start_stop = 1});
  station.forget();
  station.wait(minutes{1});
  NorthEastDown sum{};
  const auto positions = station.all<messages::GlobalPositionInt>();
  for (const auto& each : positions) {
    const auto error = offset_between(VehicleConfig{}.start, position_of(each));
    ASSERT_LT(horizontal(error), 0.15);
    ASSERT_LT(std::abs(error.down), 0.1);
    sum = sum + error;
  }
  EXPECT_LT(horizontal(sum) / static_cast<double>(positions.size()), 0.005);
  for (const auto& each : station.all<messages::Attitude>()) {
    ASSERT_LT(std::abs(each.roll), 0.002);
    ASSERT_LT(std::abs(each.yawspeed), 0.01);
  }
  bool varies = false;
  for (const auto& each : station.all<messages::GpsRawInt>()) varies |= each.lat != positions.front().lat;
  EXPECT_TRUE(varies);
}

}  // namespace
}  // namespace ponte::sim
