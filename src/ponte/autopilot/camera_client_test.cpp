#include "ponte/autopilot/camera_client.hpp"

#include "ponte/autopilot/test_commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::SizeIs;
using testing::start;

class Bench : public testing::CommandBench {
 public:
  Bench() : CommandBench{Stack::ardupilot_copter} {}

  std::vector<CameraFact> told(Timestamp now) {
    for (auto next = commands.next_deadline(); next && *next <= now; next = commands.next_deadline())
      commands.on_tick(*next, station.voice(), answers);
    for (const auto& each : testing::take(answers)) camera.on_answer(now, each, facts_);
    return testing::take(facts_);
  }
  messages::CommandLong sent() {
    const auto all = station.take<messages::CommandLong>();
    return all.size() == 1 ? all[0] : messages::CommandLong{};
  }

  CameraClient camera{commands};

 private:
  Outbox<CameraFact> facts_{8};
};

TEST(CameraClient, TakesOnePictureAndSaysSo) {
  Bench bench;
  const auto id = bench.camera.take_picture(start, bench.station.voice());
  const auto sent = bench.sent();
  EXPECT_EQ(sent.command, messages::MAV_CMD_IMAGE_START_CAPTURE);
  EXPECT_EQ(sent.param3, 1);
  bench.answer(start + 10ms, messages::MAV_CMD_IMAGE_START_CAPTURE);
  EXPECT_THAT(bench.told(start + 10ms),
              ::testing::ElementsAre(CameraFact{.kind = CameraFact::Kind::done, .request = id.value()}));
}

TEST(CameraClient, AsksForAPictureOnceOnly) {
  Bench bench;
  ASSERT_TRUE(bench.camera.take_picture(start, bench.station.voice()));
  const auto told = bench.told(start + 1h);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, CameraFact::Kind::no_answer);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), SizeIs(1));
}

TEST(CameraClient, TakesOneAfterTheOtherUntilItIsStopped) {
  Bench bench;
  ASSERT_TRUE(bench.camera.take_pictures(start, 2500ms, {}, bench.station.voice()));
  const auto sent = bench.sent();
  EXPECT_EQ(sent.param2, 2.5F);
  EXPECT_EQ(sent.param3, 0);
  ASSERT_TRUE(bench.camera.stop(start, bench.station.voice()));
  EXPECT_EQ(bench.sent().command, messages::MAV_CMD_IMAGE_STOP_CAPTURE);
}

TEST(CameraClient, TellsRefusalsAndWhatItDoesNotEvenAsk) {
  Bench bench;
  EXPECT_EQ(bench.camera.take_pictures(start, 0s, {}, bench.station.voice()), fail(CameraError::invalid));
  EXPECT_EQ(bench.camera.take_pictures(start, 1s, 0, bench.station.voice()), fail(CameraError::invalid));
  ASSERT_TRUE(bench.camera.take_picture(start, bench.station.voice()));
  bench.answer(start, messages::MAV_CMD_IMAGE_START_CAPTURE, messages::MAV_RESULT_UNSUPPORTED);
  const auto told = bench.told(start);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, CameraFact::Kind::refused);
  EXPECT_EQ(told[0].result, messages::MAV_RESULT_UNSUPPORTED);
}

}  // namespace
}  // namespace ponte::autopilot
