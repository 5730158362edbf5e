#include "ponte/autopilot/vehicle_client.hpp"

#include "ponte/autopilot/test_station.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"

#include "support/allocations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::SizeIs;
using testing::start;

constexpr Command prearm{.number = messages::MAV_CMD_RUN_PREARM_CHECKS};

class Bench {
 public:
  explicit Bench(Stack stack = Stack::ardupilot_copter)
      : client{{testing::vehicle_system, testing::autopilot_component, stack}} {}

  template <mavlink::Message M>
  void hear(Timestamp now, const M& message) {
    const testing::TestFrame frame{message, testing::vehicle_system, testing::autopilot_component, mavlink::Version::v2,
                                   sequence_++};
    client.on_message(now, frame.view(), station.voice(), facts);
  }
  void heartbeat(Timestamp now, bool armed) {
    unsigned base_mode = messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
    if (armed) base_mode |= messages::MAV_MODE_FLAG_SAFETY_ARMED;
    hear(now, messages::Heartbeat{.base_mode = static_cast<std::uint8_t>(base_mode), .custom_mode = 4});
  }
  void answer(Timestamp now, unsigned command, unsigned result = messages::MAV_RESULT_ACCEPTED) {
    hear(now, messages::CommandAck{.command = static_cast<std::uint16_t>(command),
                                   .result = static_cast<std::uint8_t>(result)});
  }
  void tick(Timestamp now) { client.on_tick(now, station.voice(), facts); }

  testing::Station station;
  VehicleClient client;
  Outbox<VehicleFact> facts{64};

 private:
  std::uint8_t sequence_{};
};

TEST(VehicleClient, HandsAnswersToTheServiceThatAskedAndTheRestToTheUser) {
  Bench bench;
  bench.heartbeat(start, false);
  ASSERT_TRUE(bench.client.commands().request(start, prearm, bench.station.voice()));
  ASSERT_TRUE(bench.client.modes().arm(start, bench.station.voice()));
  ASSERT_TRUE(bench.client.camera().take_picture(start, bench.station.voice()));
  bench.answer(start + 10ms, prearm.number);
  bench.answer(start + 10ms, messages::MAV_CMD_COMPONENT_ARM_DISARM);
  bench.answer(start + 10ms, messages::MAV_CMD_IMAGE_START_CAPTURE);
  bench.heartbeat(start + 1s, true);
  const auto told = testing::take(bench.facts);
  ASSERT_THAT(told, SizeIs(3)) << "one for each wish, and none of the commands behind them";
  EXPECT_TRUE(std::holds_alternative<CommandFact>(told[0]));
  EXPECT_TRUE(std::holds_alternative<CameraFact>(told[1]));
  EXPECT_TRUE(std::holds_alternative<ModeFact>(told[2]));
}

TEST(VehicleClient, KnowsWhetherThereAreFilesUntilTheVehicleStartsAnew) {
  Bench bench;
  EXPECT_FALSE(bench.client.offers_files()) << "it has not said so";
  bench.hear(start, messages::AutopilotVersion{.capabilities = messages::MAV_PROTOCOL_CAPABILITY_MISSION_INT});
  EXPECT_FALSE(bench.client.offers_files());
  bench.hear(start, messages::AutopilotVersion{.capabilities = messages::MAV_PROTOCOL_CAPABILITY_FTP});
  EXPECT_TRUE(bench.client.offers_files());
  bench.client.on_reboot(start, bench.facts);
  EXPECT_FALSE(bench.client.capabilities());
}

TEST(VehicleClient, TellsAtOnceWhatAStreamHasSuperseded) {
  Bench bench{Stack::px4};
  bench.heartbeat(start, true);
  bench.hear(start, messages::ExtendedSysState{.landed_state = messages::MAV_LANDED_STATE_IN_AIR});
  for (const auto time : {start, start + 900ms})
    ASSERT_TRUE(bench.client.stream().steer(time, {.north = MetresPerSecond{2}}, bench.station.voice()));
  ASSERT_TRUE(bench.client.modes().disarm(start + 900ms, bench.station.voice()));
  static_cast<void>(testing::take(bench.facts));
  bench.tick(start + 1s);  // the stream asks for OFFBOARD
  const auto told = testing::take(bench.facts);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(std::get<ModeFact>(told[0]).kind, ModeFact::Kind::superseded);
  EXPECT_GT(bench.client.next_deadline(), start + 1s);
}

TEST(VehicleClient, EndsEverythingOnceWhenTheVehicleStartsAnew) {
  Bench bench;
  bench.heartbeat(start, true);
  auto& voice = bench.station.voice();
  ASSERT_TRUE(bench.client.commands().request(start, prearm, voice));
  ASSERT_TRUE(bench.client.modes().arm(start, voice));
  ASSERT_TRUE(bench.client.guided().change_speed(start, MetresPerSecond{5}, voice));
  ASSERT_TRUE(bench.client.camera().take_picture(start, voice));
  ASSERT_TRUE(bench.client.gimbal().find_manager(start, voice));
  bench.client.on_reboot(start + 1s, bench.facts);
  EXPECT_THAT(testing::take(bench.facts), SizeIs(5));
  for (auto at = 1s; at < 60s; at += 1s) bench.tick(start + at);
  EXPECT_THAT(testing::take(bench.facts), SizeIs(0));
}

TEST(VehicleClient, AsksForTheTimeByItself) {
  Bench bench;
  EXPECT_LE(bench.client.next_deadline(), start);
  bench.tick(start);
  EXPECT_THAT(bench.station.take<messages::Timesync>(), SizeIs(1));
  EXPECT_GT(bench.client.next_deadline(), start);
}

TEST(VehicleClient, AllocatesNothingOnceItIsThere) {
  if (!count_allocations()) GTEST_SKIP() << "a build without a sanitizer";
  Bench bench;
  auto& voice = bench.station.voice();
  const auto live = [&](Timestamp from) {
    bool all_begun = true;
    for (int i = 0; i < 200; ++i) {
      const auto now = from + i * 100ms;
      bench.heartbeat(now, i % 2 == 0);
      bench.hear(now, messages::Statustext{.severity = 2, .text = std::string_view{"Arm: no"}});
      all_begun = all_begun && bench.client.modes().arm(now, voice).has_value();
      static_cast<void>(bench.client.commands().request(now, prearm, voice));
      static_cast<void>(bench.client.guided().change_speed(now, MetresPerSecond{5}, voice));
      bench.answer(now, messages::MAV_CMD_COMPONENT_ARM_DISARM, messages::MAV_RESULT_FAILED);
      bench.answer(now, prearm.number);
      bench.tick(now + 50ms);
      bench.facts.drain([](const VehicleFact&) {});
    }
    return all_begun;
  };
  const auto before = allocation_count.load();
  EXPECT_TRUE(live(start));
  EXPECT_EQ(allocation_count.load() - before, 0U);
}

}  // namespace
}  // namespace ponte::autopilot
