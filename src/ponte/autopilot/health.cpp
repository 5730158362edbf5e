#include "ponte/autopilot/health.hpp"

#include "ponte/mavlink/autopilots/ekf_status_report.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/estimator_status.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

/// The two messages share their flags, but for this of a glitch.
EstimatorHealth health_of(unsigned flags, unsigned glitch) {
  const auto has = [flags](unsigned flag) { return (flags & flag) != 0; };
  return {.attitude = has(messages::ESTIMATOR_ATTITUDE),
          .velocity = has(messages::ESTIMATOR_VELOCITY_HORIZ),
          .position = has(messages::ESTIMATOR_POS_HORIZ_ABS) && !has(messages::ESTIMATOR_CONST_POS_MODE),
          .altitude = has(messages::ESTIMATOR_POS_VERT_ABS),
          .satellites_glitch = has(glitch)};
}

double worst_of(std::initializer_list<float> ratios) {
  double worst = 0;
  for (const float each : ratios)
    if (std::isfinite(each)) worst = std::max(worst, double{each});
  return worst;
}

std::optional<Metres> accuracy(float metres) {
  if (!std::isfinite(metres) || metres < 0) return std::nullopt;
  return Metres{metres};
}

EstimatorHealth health_in(const messages::EstimatorStatus& status) {
  auto health = health_of(status.flags, messages::ESTIMATOR_GPS_GLITCH);
  health.worst_ratio = worst_of({status.vel_ratio, status.pos_horiz_ratio, status.pos_vert_ratio, status.mag_ratio});
  health.horizontal_accuracy = accuracy(status.pos_horiz_accuracy);
  health.vertical_accuracy = accuracy(status.pos_vert_accuracy);
  return health;
}

EstimatorHealth health_in(const messages::EkfStatusReport& report) {
  auto health = health_of(report.flags, messages::EKF_GPS_GLITCHING);
  health.worst_ratio = worst_of(
      {report.velocity_variance, report.pos_horiz_variance, report.pos_vert_variance, report.compass_variance});
  return health;
}

SatelliteHealth health_in(const messages::GpsRawInt& raw) {
  constexpr unsigned unknown_count = 255;
  constexpr unsigned unknown_dilution = 65535;
  SatelliteHealth health{.fix_type = raw.fix_type};
  if (raw.satellites_visible != unknown_count) health.satellites = raw.satellites_visible;
  if (raw.eph != unknown_dilution) health.horizontal_dilution = raw.eph / 100.0;
  return health;
}

BatteryHealth battery_in(const messages::SysStatus& status) {
  constexpr unsigned unknown_voltage = 65535;
  BatteryHealth health;
  if (status.voltage_battery != unknown_voltage) health.voltage_v = status.voltage_battery / 1000.0;
  if (status.current_battery >= 0) health.current_a = status.current_battery / 100.0;
  if (status.battery_remaining >= 0) health.remaining = Percent{static_cast<double>(status.battery_remaining)};
  return health;
}

}  // namespace

void Health::on_message(Timestamp now, const mavlink::FrameView& frame) {
  if (frame.system != peer_.system || frame.component != peer_.component) return;
  if (mavlink::carries<messages::SysStatus>(frame)) {
    const auto status = mavlink::decode<messages::SysStatus>(frame);
    sensors_.learn(now, sensor_bits(status));
    battery_.learn(now, battery_in(status));
  }
  if (mavlink::carries<messages::EstimatorStatus>(frame))
    estimator_.learn(now, health_in(mavlink::decode<messages::EstimatorStatus>(frame)));
  if (mavlink::carries<messages::EkfStatusReport>(frame))
    estimator_.learn(now, health_in(mavlink::decode<messages::EkfStatusReport>(frame)));
  if (mavlink::carries<messages::GpsRawInt>(frame))
    satellites_.learn(now, health_in(mavlink::decode<messages::GpsRawInt>(frame)));
}

}  // namespace ponte::autopilot
