#include "ponte/mavlink/autopilots/gimbal_device_attitude_status.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_information.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_set_attitude.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_set_pitchyaw.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_status.hpp"
#include "ponte/mavlink/autopilots/mount_orientation.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::sim {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr auto accepted = unsigned{messages::MAV_RESULT_ACCEPTED};

VehicleConfig with_gimbal(Personality personality) {
  const bool is_px4 = personality == Personality::px4;
  return {.personality = personality,
          .fly_square = false,
          .parameters = {is_px4 ? ParameterSetting{"MNT_MODE_IN", 4} : ParameterSetting{"MNT1_TYPE", 1}}};
}

class GimbalTest : public ::testing::TestWithParam<Personality> {
 protected:
  GimbalTest() {
    station_.wait(seconds{9});
    station_.set_interval(messages::GimbalDeviceAttitudeStatus::info.id, 100'000);
  }

  /// Degrees, after it has had time to turn.
  struct Angles {
    double pitch;
    double yaw;
  };
  Angles angles() {
    station_.wait(seconds{4});
    const auto [w, x, y, z] = station_.last<messages::GimbalDeviceAttitudeStatus>().q;
    constexpr double degree = 57.29577951308232;
    return {std::asin(2.0 * (double{w} * y - double{z} * x)) * degree,
            std::atan2(2.0 * (double{w} * z + double{x} * y), 1 - 2.0 * (double{y} * y + double{z} * z)) * degree};
  }

  unsigned point(float pitch, float yaw, float flags = 0) {
    return station_.command(messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW, {pitch, yaw, nan, nan, flags});
  }

  TestStation station_{with_gimbal(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Both, GimbalTest, ::testing::Values(Personality::ardupilot, Personality::px4));

TEST_P(GimbalTest, TellsWhatItIs) {
  ASSERT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {280}), accepted);
  EXPECT_EQ(station_.last<messages::GimbalManagerInformation>().gimbal_device_id, 1);
}

TEST_P(GimbalTest, PointsWhereItIsTold) {
  ASSERT_EQ(point(-30, 20), accepted);
  EXPECT_NEAR(angles().pitch, -30, 0.1);
  EXPECT_NEAR(angles().yaw, 20, 0.1);
  ASSERT_EQ(point(nan, -40), accepted);
  EXPECT_NEAR(angles().pitch, -30, 0.1) << "left as it is";
  EXPECT_NEAR(angles().yaw, -40, 0.1);
  ASSERT_EQ(point(-200, 0), accepted);
  EXPECT_NEAR(angles().pitch, -90, 0.1) << "as far as it goes";
}

TEST_P(GimbalTest, TakesMessagesAsWellAsCommands) {
  station_.send(messages::GimbalManagerSetPitchyaw{.target_system = 1, .pitch = -0.5F, .yaw = 0.25F});
  EXPECT_NEAR(angles().pitch, -28.65, 0.1);
  EXPECT_NEAR(angles().yaw, 14.32, 0.1);
  station_.send(messages::GimbalManagerSetAttitude{.target_system = 1, .q = {1, 0, 0, 0}});
  EXPECT_NEAR(angles().pitch, 0, 0.1);
}

TEST_P(GimbalTest, KnowsWhoHasControl) {
  const auto controller = [&] { return station_.last<messages::GimbalManagerStatus>().primary_control_sysid; };
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE, {-2, -2, -1, -1}), accepted);
  EXPECT_EQ(controller(), 255);
  station_.speak_as(mavlink::SystemId{254}, mavlink::ComponentId{190});
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE, {-3, -3, -1, -1}), accepted);
  EXPECT_EQ(controller(), 255) << "not this one's to give up";
  station_.speak_as(mavlink::SystemId{255}, mavlink::ComponentId{190});
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE, {-3, -3, -1, -1}), accepted);
  EXPECT_EQ(controller(), 0);
}

TEST_P(GimbalTest, LooksAtAPlace) {
  // 100 m to the east, on the ground
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_SET_ROI_LOCATION, {0, 0, 0, 0, -30.06898F, -51.12075F, 50}),
            accepted);
  EXPECT_NEAR(angles().yaw, 90, 3);
  EXPECT_NEAR(angles().pitch, 0, 3);
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_SET_ROI_NONE), accepted);
  EXPECT_NEAR(angles().yaw, 0, 0.1);
}

TEST_P(GimbalTest, IsAnOldMountToo) {
  ASSERT_EQ(station_.command(messages::MAV_CMD_DO_MOUNT_CONTROL, {-45, 0, 10, 0, 0, 0, 2}), accepted);
  station_.wait(seconds{4});
  ASSERT_EQ(station_.command(messages::MAV_CMD_REQUEST_MESSAGE, {265}), accepted);
  EXPECT_NEAR(station_.last<messages::MountOrientation>().pitch, -45, 0.1);
  EXPECT_NEAR(station_.last<messages::MountOrientation>().yaw, 10, 0.1);
}

TEST(NoGimbal, IsThereByDefault) {
  TestStation ardupilot{{}};
  ardupilot.wait(seconds{9});
  EXPECT_EQ(ardupilot.command(messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW, {10, 10}),
            unsigned{messages::MAV_RESULT_FAILED});
  TestStation px4{{.personality = Personality::px4}};
  px4.wait(seconds{9});
  EXPECT_EQ(px4.command(messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW, {10, 10}),
            unsigned{messages::MAV_RESULT_UNSUPPORTED});
}

}  // namespace
}  // namespace ponte::sim
