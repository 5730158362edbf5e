#include "ponte/autopilot/command_client.hpp"

#include "ponte/autopilot/test_station.hpp"
#include "ponte/mavlink/autopilots/command_cancel.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::start;
using Kind = CommandFact::Kind;

constexpr Peer copter{testing::vehicle_system, testing::autopilot_component, Stack::ardupilot_copter};
constexpr Command arm{.number = messages::MAV_CMD_COMPONENT_ARM_DISARM, .param1 = 1};
constexpr Command disarm{.number = messages::MAV_CMD_COMPONENT_ARM_DISARM};
constexpr Command photo{.number = messages::MAV_CMD_IMAGE_START_CAPTURE, .param3 = 1};
constexpr Command calibrate{.number = messages::MAV_CMD_PREFLIGHT_CALIBRATION, .param1 = 1};
constexpr Command reposition{.number = messages::MAV_CMD_DO_REPOSITION,
                             .x = -30,
                             .y = -51,
                             .z = 40,
                             .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT};

/// A client, and the vehicle whose part the test plays.
class Bench {
 public:
  explicit Bench(mavlink::Version version = mavlink::Version::v2) : station{version}, version_{version} {}

  CommandId ask(Timestamp now, const Command& command) { return client.request(now, command, station.voice()).value(); }
  void tick(Timestamp now) { client.on_tick(now, station.voice(), facts); }

  template <mavlink::Message M>
  void hear(Timestamp now, const M& message, std::uint8_t system = 1, std::uint8_t component = 1) {
    hear_again(now, message, sequence_++, system, component);
  }
  /// A frame with this sequence number.
  template <mavlink::Message M>
  void hear_again(Timestamp now, const M& message, std::uint8_t sequence, std::uint8_t system = 1,
                  std::uint8_t component = 1) {
    const testing::TestFrame frame{message, mavlink::SystemId{system}, mavlink::ComponentId{component}, version_,
                                   sequence};
    client.on_message(now, frame.view(), station.voice(), facts);
  }
  void answer(Timestamp now, const Command& command, unsigned result, std::uint8_t to = 255) {
    hear(now, messages::CommandAck{
                  .command = command.number,
                  .result = static_cast<std::uint8_t>(result),
                  .progress = result == messages::MAV_RESULT_IN_PROGRESS ? std::uint8_t{40} : std::uint8_t{},
                  .target_system = to,
                  .target_component = 190});
  }
  std::vector<Kind> kinds() {
    std::vector<Kind> result;
    for (const auto& fact : testing::take(facts)) result.push_back(fact.kind);
    return result;
  }
  /// Everything that is due until then, one deadline after the other.
  void run_until(Timestamp end) {
    for (auto next = client.next_deadline(); next && *next <= end; next = client.next_deadline()) tick(*next);
  }

  CommandClient client{copter};
  testing::Station station;
  Outbox<CommandFact> facts{64};

 private:
  mavlink::Version version_;
  std::uint8_t sequence_{};
};

TEST(CommandClient, EndsARequestWithItsAnswer) {
  Bench bench;
  const auto id = bench.ask(start, arm);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(),
              ElementsAre(messages::CommandLong{
                  .target_system = 1, .target_component = 1, .command = arm.number, .confirmation = 0, .param1 = 1}));
  bench.answer(start + 100ms, arm, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(testing::take(bench.facts),
              ElementsAre(CommandFact{.kind = Kind::accepted, .request = id, .command = arm.number, .attempts = 1}));
  EXPECT_FALSE(bench.client.next_deadline());
}

TEST(CommandClient, RepeatsWithConfirmationUntilItGivesUp) {
  Bench bench;
  bench.ask(start, arm);
  bench.run_until(start + 1h);
  const auto sent = bench.station.take<messages::CommandLong>();
  ASSERT_THAT(sent, SizeIs(5));
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(sent[i].confirmation, i);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::no_answer));
  EXPECT_FALSE(bench.client.next_deadline());
}

TEST(CommandClient, NeverRepeatsWhatCounts) {
  Bench bench;
  bench.ask(start, photo);
  bench.run_until(start + 1h);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), SizeIs(1));
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::no_answer));
}

TEST(CommandClient, WaitsWhileTheVehicleIsAtIt) {
  Bench bench;
  bench.ask(start, calibrate);
  for (auto at = 500ms; at <= 30s; at += 5s) bench.answer(start + at, calibrate, messages::MAV_RESULT_IN_PROGRESS);
  bench.answer(start + 31s, calibrate, messages::MAV_RESULT_ACCEPTED);
  const auto facts = testing::take(bench.facts);
  ASSERT_THAT(facts, SizeIs(7));
  EXPECT_EQ(facts[0].kind, Kind::progress);
  EXPECT_EQ(facts[0].progress, 40);
  EXPECT_EQ(facts[6].kind, Kind::accepted);
}

TEST(CommandClient, DoesNotWaitForeverForWhatIsInProgress) {
  Bench bench;
  bench.ask(start, calibrate);
  for (auto at = 500ms; at < 119s; at += 1s) bench.answer(start + at, calibrate, messages::MAV_RESULT_IN_PROGRESS);
  bench.kinds();
  bench.run_until(start + 121s);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::no_answer));
}

TEST(CommandClient, LetsOneOfANumberWaitForTheOtherAndOthersPass) {
  Bench bench;
  const auto first = bench.ask(start, arm);
  const auto second = bench.ask(start, disarm);
  bench.ask(start, calibrate);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(),
              ElementsAre(Field(&messages::CommandLong::command, arm.number),
                          Field(&messages::CommandLong::command, calibrate.number)));
  bench.answer(start + 10ms, arm, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), ElementsAre(Field(&messages::CommandLong::param1, 0)));
  bench.answer(start + 20ms, disarm, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(testing::take(bench.facts),
              ElementsAre(Field(&CommandFact::request, first), Field(&CommandFact::request, second)));
}

TEST(CommandClient, DoesNotTakeTheAnswerToASecondCopyForThatToTheNextRequest) {
  Bench bench;
  bench.ask(start, arm);
  bench.tick(start + 1s);                                            // the second copy
  bench.answer(start + 1100ms, arm, messages::MAV_RESULT_ACCEPTED);  // of the first, which was slow
  bench.station.take<messages::CommandLong>();
  bench.ask(start + 1200ms, disarm);
  EXPECT_TRUE(bench.station.is_silent()) << "an answer is still on its way";
  bench.answer(start + 1300ms, arm, messages::MAV_RESULT_ACCEPTED);  // of the second
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), SizeIs(1)) << "now the next";
  bench.answer(start + 1400ms, disarm, messages::MAV_RESULT_FAILED);
  bench.run_until(start + 3s);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::accepted, Kind::refused));
}

TEST(CommandClient, WaitsNoLongerForALateAnswerThanOneTakes) {
  Bench bench;
  bench.ask(start, arm);
  bench.tick(start + 1s);
  bench.answer(start + 1100ms, arm, messages::MAV_RESULT_ACCEPTED);
  bench.ask(start + 1200ms, disarm);
  bench.station.take<messages::CommandLong>();
  EXPECT_EQ(bench.client.next_deadline(), start + 3s);
  bench.tick(start + 3s);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), SizeIs(1));
}

TEST(CommandClient, DoesNotTakeTheAnswerToWhatWasSentElsewhereInOurNameForItsOwn) {
  Bench bench;
  bench.ask(start, arm);
  bench.client.on_sent_elsewhere(start + 10ms, arm.number);
  bench.answer(start + 100ms, arm, messages::MAV_RESULT_FAILED);
  EXPECT_EQ(bench.station.take<messages::CommandLong>().size(), 1U);
  bench.answer(start + 110ms, arm, messages::MAV_RESULT_FAILED);
  EXPECT_EQ(bench.station.take<messages::CommandLong>().size(), 1U) << "both are answered, one of them is ours";
  bench.answer(start + 200ms, arm, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::accepted));
}

TEST(CommandClient, DoesNotTakeARepeatedFrameForAnotherAnswer) {
  Bench bench;
  const messages::CommandAck ack{.command = arm.number, .target_system = 255, .target_component = 190};
  bench.ask(start, arm);
  bench.ask(start, disarm);
  bench.hear_again(start + 100ms, ack, 77);
  bench.hear_again(start + 110ms, ack, 77);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::accepted)) << "the second request has no answer yet";
}

TEST(CommandClient, PassesOverAnswersToAndOfOthers) {
  Bench bench;
  bench.ask(start, arm);
  bench.answer(start + 10ms, arm, messages::MAV_RESULT_FAILED, 254);
  bench.hear(start + 20ms, messages::CommandAck{.command = arm.number, .result = 4}, 2);
  bench.hear(start + 30ms, messages::CommandAck{.command = arm.number, .result = 4}, 1, 154);
  bench.answer(start + 40ms, disarm, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::accepted));
  bench.answer(start + 50ms, calibrate, messages::MAV_RESULT_FAILED);
  bench.run_until(start + 1h);
  EXPECT_THAT(bench.kinds(), IsEmpty()) << "nobody has asked";
}

TEST(CommandClient, TakesAnAnswerToNobodyForItsOwnInMavlink1) {
  Bench bench{mavlink::Version::v1};
  bench.ask(start, arm);
  bench.answer(start + 10ms, arm, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::accepted));
}

TEST(CommandClient, SaysWhatTheVehicleSaidBeforeAndAfterItsRefusal) {
  Bench bench;
  bench.ask(start, arm);
  bench.hear(start - 3s, messages::Statustext{.severity = 6, .text = std::string_view{"long ago"}});
  bench.hear(start + 90ms, messages::Statustext{.severity = 2, .text = std::string_view{"Arm: Accels inconsistent"}});
  bench.answer(start + 100ms, arm, messages::MAV_RESULT_FAILED);
  EXPECT_THAT(bench.facts.size(), 0U) << "there may be more";
  bench.hear(start + 400ms, messages::Statustext{.severity = 2, .text = std::string_view{"Arm: Compass not healthy"}});
  bench.run_until(start + 600ms);
  const auto facts = testing::take(bench.facts);
  ASSERT_THAT(facts, SizeIs(1));
  EXPECT_EQ(facts[0].kind, Kind::refused);
  EXPECT_EQ(facts[0].result, messages::MAV_RESULT_FAILED);
  EXPECT_EQ(facts[0].reason.view(), "Arm: Accels inconsistent; Arm: Compass not healthy");
}

TEST(CommandClient, TakesTheOtherCarrierOnce) {
  Bench bench;
  bench.hear(start, messages::HomePosition{.altitude = 50'000});
  bench.ask(start, reposition);
  EXPECT_THAT(bench.station.take<messages::CommandInt>(), SizeIs(1));
  bench.answer(start + 10ms, reposition, messages::MAV_RESULT_COMMAND_LONG_ONLY);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), ElementsAre(Field(&messages::CommandLong::param7, 90)));
  bench.answer(start + 20ms, reposition, messages::MAV_RESULT_COMMAND_INT_ONLY);
  EXPECT_TRUE(bench.station.is_silent());
  EXPECT_THAT(testing::take(bench.facts),
              ElementsAre(Field(&CommandFact::result, messages::MAV_RESULT_COMMAND_INT_ONLY)));
}

TEST(CommandClient, DoesNotTakeTheLateAnswerToTheFirstCarrierForThatToTheSecond) {
  Bench bench;
  bench.hear(start, messages::HomePosition{.altitude = 50'000});
  bench.ask(start, reposition);
  bench.tick(start + 1s);
  bench.answer(start + 1010ms, reposition, messages::MAV_RESULT_COMMAND_LONG_ONLY);
  bench.answer(start + 1020ms, reposition, messages::MAV_RESULT_COMMAND_LONG_ONLY);
  EXPECT_THAT(bench.kinds(), IsEmpty());
  bench.answer(start + 1100ms, reposition, messages::MAV_RESULT_ACCEPTED);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::accepted));
}

TEST(CommandClient, TakesTheOtherFrameOnceIfItKnowsHome) {
  Bench bench;
  bench.hear(start, messages::HomePosition{.altitude = 50'000});
  bench.ask(start, reposition);
  bench.answer(start + 10ms, reposition, messages::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME);
  const auto sent = bench.station.take<messages::CommandInt>();
  ASSERT_THAT(sent, SizeIs(2));
  EXPECT_EQ(sent[1].frame, messages::MAV_FRAME_GLOBAL);
  EXPECT_EQ(sent[1].z, 90);
  bench.answer(start + 20ms, reposition, messages::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::refused));

  Bench without_home;
  without_home.ask(start, reposition);
  without_home.answer(start, reposition, messages::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME);
  EXPECT_THAT(without_home.kinds(), ElementsAre(Kind::refused));
}

TEST(CommandClient, CancelsWhatIsInProgress) {
  Bench bench;
  const auto id = bench.ask(start, calibrate);
  bench.answer(start + 10ms, calibrate, messages::MAV_RESULT_IN_PROGRESS);
  bench.client.cancel(start + 20ms, id, bench.station.voice());
  EXPECT_THAT(bench.station.take<messages::CommandCancel>(),
              ElementsAre(messages::CommandCancel{1, 1, calibrate.number}));
  bench.answer(start + 30ms, calibrate, messages::MAV_RESULT_CANCELLED);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::progress, Kind::cancelled));
}

TEST(CommandClient, AsksThreeTimesToCancelAndThenDoesNotKnow) {
  Bench bench;
  const auto id = bench.ask(start, calibrate);
  bench.client.cancel(start, id, bench.station.voice());
  bench.run_until(start + 1h);
  EXPECT_THAT(bench.station.take<messages::CommandCancel>(), SizeIs(3));
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::no_answer));
}

TEST(CommandClient, CancelsWhatWasNotSentWithoutAWord) {
  Bench bench;
  bench.ask(start, arm);
  const auto second = bench.ask(start, disarm);
  bench.station.take<messages::CommandLong>();
  bench.client.cancel(start, second, bench.station.voice());
  bench.tick(start);
  EXPECT_TRUE(bench.station.is_silent());
  EXPECT_THAT(testing::take(bench.facts), ElementsAre(Field(&CommandFact::request, second)));
}

TEST(CommandClient, SendsAndTellsNoMoreOfWhatIsWithdrawn) {
  Bench bench;
  const auto first = bench.ask(start, arm);
  const auto second = bench.ask(start, disarm);
  bench.client.withdraw(start, first);
  bench.run_until(start + 1h);
  EXPECT_THAT(testing::take(bench.facts), ElementsAre(Field(&CommandFact::request, second)));
  const auto sent = bench.station.take<messages::CommandLong>();
  ASSERT_THAT(sent, SizeIs(6));
  EXPECT_EQ(sent[0].param1, 1);
  EXPECT_EQ(sent[1].param1, 0) << "no more copies of the first";
}

TEST(CommandClient, EndsEverythingWhenTheVehicleStartsAnew) {
  Bench bench;
  bench.ask(start, arm);
  bench.ask(start, disarm);
  bench.ask(start, {.number = messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, .param1 = 1});
  bench.client.on_reboot(bench.facts);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::rebooted, Kind::rebooted, Kind::accepted));
  EXPECT_FALSE(bench.client.next_deadline());
}

TEST(CommandClient, SendsNoMoreCopiesToAVehicleThatHasGoneToMavlink09) {
  Bench bench;
  bench.ask(start, arm);
  bench.station.set_version(mavlink::Version::v0_9);
  bench.station.take<messages::CommandLong>();
  bench.run_until(start + 1h);
  EXPECT_TRUE(bench.station.is_silent());
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::no_answer));
}

TEST(CommandClient, SaysWhyItCannotEvenSend) {
  Bench old{mavlink::Version::v0_9};
  EXPECT_EQ(old.client.request(start, arm, old.station.voice()), fail(CommandError::version_0_9));
  Bench bench;
  auto nowhere = reposition;
  nowhere.x = 95;
  EXPECT_EQ(bench.client.request(start, nowhere, bench.station.voice()), fail(CommandError::no_such_place));
  for (std::size_t i = 0; i < CommandClient::capacity; ++i) bench.ask(start, arm);
  EXPECT_EQ(bench.client.request(start, arm, bench.station.voice()), fail(CommandError::too_many));
  bench.run_until(start + 1h);
  EXPECT_THAT(bench.kinds(), SizeIs(CommandClient::capacity)) << "each ends once";
}

}  // namespace
}  // namespace ponte::autopilot
