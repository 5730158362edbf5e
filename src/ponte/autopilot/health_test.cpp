#include "ponte/autopilot/health.hpp"

#include "ponte/autopilot/test_station.hpp"
#include "ponte/mavlink/autopilots/ekf_status_report.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/estimator_status.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using testing::start;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class HealthTest : public ::testing::Test {
 protected:
  template <mavlink::Message M>
  void hear(const M& message, std::uint8_t system = 1) {
    const testing::TestFrame frame{message, mavlink::SystemId{system}};
    health.on_message(start, frame.view());
  }

  Health health{{testing::vehicle_system, testing::autopilot_component, Stack::px4}};
};

TEST_F(HealthTest, KnowsNothingUntilItIsTold) {
  EXPECT_FALSE(health.sensors(start) || health.battery(start) || health.estimator(start) || health.satellites(start));
  hear(messages::SysStatus{}, 2);
  EXPECT_FALSE(health.sensors(start)) << "that was another vehicle";
}

TEST_F(HealthTest, KnowsSensorsAndBattery) {
  hear(messages::SysStatus{.onboard_control_sensors_present = 7,
                           .onboard_control_sensors_enabled = 3,
                           .onboard_control_sensors_health = 1,
                           .voltage_battery = 12'345,
                           .current_battery = 250,
                           .battery_remaining = 80});
  EXPECT_EQ(health.sensors(start)->present, 7U);
  EXPECT_EQ(health.sensors(start)->healthy, 1U);
  EXPECT_EQ(health.battery(start), (BatteryHealth{12.345, 2.5, Percent{80}}));
  hear(messages::SysStatus{.voltage_battery = 65535, .current_battery = -1, .battery_remaining = -1});
  EXPECT_EQ(health.battery(start), BatteryHealth{});
}

TEST_F(HealthTest, KnowsTheEstimatorOfPx4) {
  constexpr unsigned flags = messages::ESTIMATOR_ATTITUDE | messages::ESTIMATOR_VELOCITY_HORIZ |
                             messages::ESTIMATOR_POS_HORIZ_ABS | messages::ESTIMATOR_POS_VERT_ABS;
  hear(messages::EstimatorStatus{.flags = flags,
                                 .vel_ratio = 0.2F,
                                 .pos_horiz_ratio = 0.7F,
                                 .mag_ratio = nan,
                                 .pos_horiz_accuracy = 1.5,
                                 .pos_vert_accuracy = nan});
  const auto estimator = health.estimator(start).value();
  EXPECT_TRUE(estimator.attitude && estimator.velocity && estimator.position && estimator.altitude);
  EXPECT_FALSE(estimator.satellites_glitch);
  EXPECT_NEAR(estimator.worst_ratio, 0.7, 1e-6);
  EXPECT_EQ(estimator.horizontal_accuracy, Metres{1.5});
  EXPECT_FALSE(estimator.vertical_accuracy);
  hear(messages::EstimatorStatus{.flags = flags | messages::ESTIMATOR_CONST_POS_MODE | messages::ESTIMATOR_GPS_GLITCH});
  EXPECT_FALSE(health.estimator(start)->position) << "it only holds the last one";
  EXPECT_TRUE(health.estimator(start)->satellites_glitch);
}

TEST_F(HealthTest, KnowsTheEstimatorOfArduPilot) {
  hear(messages::EkfStatusReport{.flags = messages::EKF_ATTITUDE | messages::EKF_GPS_GLITCHING,
                                 .velocity_variance = 0.1F,
                                 .compass_variance = 1.2F});
  const auto estimator = health.estimator(start).value();
  EXPECT_TRUE(estimator.attitude && estimator.satellites_glitch);
  EXPECT_FALSE(estimator.position || estimator.horizontal_accuracy);
  EXPECT_NEAR(estimator.worst_ratio, 1.2, 1e-6);
}

TEST_F(HealthTest, KnowsTheSatellites) {
  hear(messages::GpsRawInt{.fix_type = 3, .eph = 121, .satellites_visible = 10});
  EXPECT_EQ(health.satellites(start), (SatelliteHealth{3, 10, 1.21}));
  hear(messages::GpsRawInt{.eph = 65535, .satellites_visible = 255});
  EXPECT_EQ(health.satellites(start), SatelliteHealth{});
}

TEST_F(HealthTest, ForgetsWhatIsOldOrWasBeforeAStartAnew) {
  hear(messages::SysStatus{});
  EXPECT_TRUE(health.battery(start + 10s));
  EXPECT_FALSE(health.battery(start + 11s));
  health.on_reboot();
  EXPECT_FALSE(health.battery(start));
}

}  // namespace
}  // namespace ponte::autopilot
