#include "ponte/autopilot/gimbal_client.hpp"

#include "ponte/autopilot/test_commands.hpp"
#include "ponte/mavlink/autopilots/command_int.hpp"
#include "ponte/mavlink/autopilots/gimbal_device_attitude_status.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_information.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_status.hpp"
#include "ponte/mavlink/autopilots/mount_orientation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::start;
using Kind = GimbalFact::Kind;

constexpr unsigned request_message = messages::MAV_CMD_REQUEST_MESSAGE;
constexpr unsigned configure = messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE;
constexpr unsigned pitch_yaw = messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW;
constexpr unsigned mount_configure = messages::MAV_CMD_DO_MOUNT_CONFIGURE;
constexpr unsigned mount_control = messages::MAV_CMD_DO_MOUNT_CONTROL;
constexpr Pointing down_and_left{radians_from_degrees(-45), radians_from_degrees(-30), YawFrame::nose};

class Bench : public testing::CommandBench {
 public:
  Bench() : CommandBench{Stack::ardupilot_copter} {}

  template <mavlink::Message M>
  void hear(Timestamp now, const M& message) {
    CommandBench::hear(now, message);
    const testing::TestFrame frame{message};
    gimbal.on_message(now, frame.view(), station.voice(), facts_);
  }
  void status(Timestamp now, unsigned system, unsigned component) {
    hear(now, messages::GimbalManagerStatus{.gimbal_device_id = 1,
                                            .primary_control_sysid = static_cast<std::uint8_t>(system),
                                            .primary_control_compid = static_cast<std::uint8_t>(component)});
  }
  std::vector<GimbalFact> told(Timestamp now) {
    commands.on_tick(now, station.voice(), answers);
    for (const auto& each : testing::take(answers)) gimbal.on_answer(now, each, facts_);
    gimbal.on_tick(now, facts_);
    return testing::take(facts_);
  }
  messages::CommandLong sent() {
    const auto all = station.take<messages::CommandLong>();
    return all.size() == 1 ? all[0] : messages::CommandLong{};
  }
  /// A manager that we are in control of.
  void find_and_take() {
    ASSERT_TRUE(gimbal.find_manager(start, station.voice()));
    answer(start, request_message);
    hear(start + 1ms, messages::GimbalManagerInformation{.cap_flags = 7, .gimbal_device_id = 1});
    ASSERT_TRUE(gimbal.take_control(start + 2ms, station.voice()));
    answer(start + 3ms, configure);
    status(start + 4ms, 255, 190);
    EXPECT_THAT(told(start + 4ms), SizeIs(2));
    station.take<messages::CommandLong>();
  }

  GimbalClient gimbal{commands};

 private:
  Outbox<GimbalFact> facts_{8};
};

TEST(GimbalClient, FindsAManagerWhenItTellsOfItself) {
  Bench bench;
  const auto id = bench.gimbal.find_manager(start, bench.station.voice());
  EXPECT_EQ(bench.sent().param1, 280);
  bench.answer(start + 1ms, request_message);
  EXPECT_THAT(bench.told(start + 1ms), IsEmpty());
  bench.hear(start + 2ms, messages::GimbalManagerInformation{.cap_flags = 7, .gimbal_device_id = 1});
  EXPECT_THAT(bench.told(start + 2ms), ::testing::ElementsAre(GimbalFact{.kind = Kind::done, .request = id.value()}));
  EXPECT_EQ(bench.gimbal.kind(), GimbalClient::Kind::manager);
  EXPECT_EQ(bench.gimbal.capabilities(), 7);
}

TEST(GimbalClient, SaysThatThereIsNoneWhenNoneTells) {
  Bench bench;
  ASSERT_TRUE(bench.gimbal.find_manager(start, bench.station.voice()));
  bench.answer(start, request_message);
  bench.told(start);
  const auto told = bench.told(start + GimbalClient::patience);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::no_effect);
}

TEST(GimbalClient, TakesControlInItsOwnNameAndGivesItUpOnlyIfItHasIt) {
  Bench bench;
  bench.find_and_take();
  EXPECT_TRUE(bench.gimbal.is_in_control());
  ASSERT_TRUE(bench.gimbal.release_control(start + 1s, bench.station.voice()));
  const auto sent = bench.sent();
  EXPECT_EQ(sent.param1, -3);
  EXPECT_EQ(sent.param7, 1) << "the device";
  bench.answer(start + 1s, configure);
  bench.status(start + 2s, 0, 0);
  EXPECT_THAT(bench.told(start + 2s), SizeIs(1));
  EXPECT_FALSE(bench.gimbal.is_in_control());
}

TEST(GimbalClient, DoesNotPointWhileSomebodyElseIsInControl) {
  Bench bench;
  EXPECT_EQ(bench.gimbal.point(start, down_and_left, bench.station.voice()), fail(GimbalError::not_found));
  bench.find_and_take();
  bench.status(start + 1s, 254, 190);
  EXPECT_EQ(bench.gimbal.point(start + 1s, down_and_left, bench.station.voice()), fail(GimbalError::not_in_control));
}

TEST(GimbalClient, PointsFromTheNoseAndFromNorth) {
  Bench bench;
  bench.find_and_take();
  ASSERT_TRUE(bench.gimbal.point(start + 1s, down_and_left, bench.station.voice()));
  const auto from_nose = bench.sent();
  EXPECT_FLOAT_EQ(from_nose.param1, -45);
  EXPECT_FLOAT_EQ(from_nose.param2, -30);
  EXPECT_TRUE(std::isnan(from_nose.param3));
  EXPECT_EQ(from_nose.param5, 4 + 8 + 32);
  bench.answer(start + 1s, pitch_yaw);
  EXPECT_THAT(bench.told(start + 1s), SizeIs(1));
  ASSERT_TRUE(bench.gimbal.point(start + 2s, {.yaw = Radians{1}, .frame = YawFrame::north}, bench.station.voice()));
  const auto from_north = bench.sent();
  EXPECT_TRUE(std::isnan(from_north.param1)) << "the pitch stays";
  EXPECT_EQ(from_north.param5, 4 + 8 + 16 + 64);
}

TEST(GimbalClient, TurnsWithARateAndLetsTheNewestWishCount) {
  Bench bench;
  bench.find_and_take();
  const auto first = bench.gimbal.turn(start + 1s, {.pitch = RadiansPerSecond{0.1}}, bench.station.voice());
  const auto sent = bench.sent();
  EXPECT_TRUE(std::isnan(sent.param1));
  EXPECT_NEAR(sent.param3, 5.7296, 1e-3);
  EXPECT_EQ(sent.param4, 0);
  ASSERT_TRUE(bench.gimbal.turn(start + 1s, {.pitch = RadiansPerSecond{0.2}}, bench.station.voice()));
  ASSERT_TRUE(bench.gimbal.turn(start + 1s, {.pitch = RadiansPerSecond{0.3}}, bench.station.voice()));
  const auto told = bench.told(start + 1s);
  ASSERT_THAT(told, SizeIs(2));
  EXPECT_EQ(told[0], (GimbalFact{.kind = Kind::superseded, .request = first.value(), .wish = GimbalWish::point}));
  bench.answer(start + 1100ms, pitch_yaw);
  EXPECT_NEAR(bench.sent().param3, 17.1887, 1e-3) << "the one in between was never sent";
}

TEST(GimbalClient, LooksAtAPlaceAndAheadAgain) {
  Bench bench;
  bench.find_and_take();
  ASSERT_TRUE(bench.gimbal.look_at(start + 1s, Target{Radians{-0.5}, Radians{-0.9}, {}}, bench.station.voice()));
  const auto places = bench.station.take<messages::CommandInt>();
  ASSERT_THAT(places, SizeIs(1));
  EXPECT_EQ(places[0].command, messages::MAV_CMD_DO_SET_ROI_LOCATION);
  EXPECT_EQ(places[0].frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT);
  ASSERT_TRUE(bench.gimbal.look_at(start + 2s, std::nullopt, bench.station.voice()));
  EXPECT_EQ(bench.sent().command, messages::MAV_CMD_DO_SET_ROI_NONE);
}

TEST(GimbalClient, PointsAnOldMountByAngles) {
  Bench bench;
  ASSERT_TRUE(bench.gimbal.find_mount(start, bench.station.voice()));
  bench.answer(start, mount_configure);
  EXPECT_THAT(bench.told(start), SizeIs(1));
  EXPECT_EQ(bench.gimbal.kind(), GimbalClient::Kind::mount);
  bench.station.take<messages::CommandLong>();
  ASSERT_TRUE(bench.gimbal.point(start, down_and_left, bench.station.voice()));
  const auto sent = bench.sent();
  EXPECT_EQ(sent.command, mount_control);
  EXPECT_FLOAT_EQ(sent.param1, -45);
  EXPECT_FLOAT_EQ(sent.param3, -30);
  EXPECT_EQ(sent.param7, 2);
  auto& voice = bench.station.voice();
  EXPECT_EQ(bench.gimbal.turn(start, {}, voice), fail(GimbalError::not_supported));
  EXPECT_EQ(bench.gimbal.point(start, {.pitch = Radians{}}, voice), fail(GimbalError::not_supported));
  EXPECT_EQ(bench.gimbal.take_control(start, voice), fail(GimbalError::not_supported));
}

TEST(GimbalClient, KnowsWhereItPoints) {
  Bench bench;
  const auto half = static_cast<float>(std::sqrt(0.5));
  bench.hear(start, messages::GimbalDeviceAttitudeStatus{.flags = messages::GIMBAL_DEVICE_FLAGS_YAW_LOCK,
                                                         .q = {half, 0, 0, half}});
  ASSERT_TRUE(bench.gimbal.attitude());
  EXPECT_NEAR(bench.gimbal.attitude()->yaw.value, radians_from_degrees(90).value, 1e-6);
  EXPECT_EQ(bench.gimbal.attitude()->frame, YawFrame::north) << "locked, and no frame is named";
  bench.hear(start, messages::MountOrientation{.pitch = -20, .yaw = 10});
  EXPECT_NEAR(bench.gimbal.attitude()->pitch.value, radians_from_degrees(-20).value, 1e-6);
  Outbox<GimbalFact> facts{1};
  const testing::TestFrame of_another{messages::MountOrientation{.pitch = 5}, mavlink::SystemId{2}};
  bench.gimbal.on_message(start, of_another.view(), bench.station.voice(), facts);
  EXPECT_NEAR(bench.gimbal.attitude()->pitch.value, radians_from_degrees(-20).value, 1e-6)
      << "that was another vehicle";
}

TEST(GimbalClient, RefusesWhatIsNoAngle) {
  Bench bench;
  bench.find_and_take();
  auto& voice = bench.station.voice();
  const Radians endless{std::numeric_limits<double>::infinity()};
  EXPECT_EQ(bench.gimbal.point(start, {.pitch = endless}, voice), fail(GimbalError::invalid));
  EXPECT_EQ(bench.gimbal.turn(start, {.yaw = RadiansPerSecond{endless.value}}, voice), fail(GimbalError::invalid));
  EXPECT_EQ(bench.gimbal.look_at(start, Target{Radians{2}, {}, {}}, voice), fail(GimbalError::invalid));
}

TEST(GimbalClient, ForgetsTheGimbalWhenTheVehicleStartsAnew) {
  Bench bench;
  bench.find_and_take();
  ASSERT_TRUE(bench.gimbal.point(start, down_and_left, bench.station.voice()));
  Outbox<GimbalFact> facts{4};
  bench.gimbal.on_reboot(start, facts);
  EXPECT_EQ(testing::take(facts).at(0).kind, Kind::rebooted);
  EXPECT_EQ(bench.gimbal.kind(), GimbalClient::Kind::none);
  EXPECT_FALSE(bench.gimbal.is_in_control());
}

}  // namespace
}  // namespace ponte::autopilot
