#include "ponte/autopilot/mission_client.hpp"

#include "ponte/autopilot/test_client.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/autopilots/mission_request_list.hpp"
#include "ponte/mavlink/autopilots/mission_set_current.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::station_component;
using testing::station_system;
using testing::TestFrame;
using testing::vehicle_system;
using Kind = MissionFact::Kind;

WireItem waypoint(float height) {
  return {.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
          .command = messages::MAV_CMD_NAV_WAYPOINT,
          .autocontinue = 1,
          .x = -300'699'000,
          .y = -511'209'600,
          .z = height};
}

class MissionClientTest : public testing::ClientTest<MissionClient, MissionFact> {
 protected:
  void upload(std::vector<WireItem> items) {
    const auto started = client_->upload(now_, PlanType::mission, std::move(items), voice_);
    ASSERT_TRUE(started.has_value());
  }

  /// The vehicle says something to us, as far as its message has an addressee.
  template <mavlink::Message M>
  void hear(M message, mavlink::SystemId target = station_system) {
    if constexpr (requires { message.target_system; }) {
      message.target_system = target.value;
      message.target_component = station_component.value;
    }
    ClientTest::hear(TestFrame{message});
  }
  void ask_for(std::uint16_t item) { hear(messages::MissionRequest{.seq = item}); }
  void acknowledge(unsigned result) { hear(messages::MissionAck{.type = static_cast<std::uint8_t>(result)}); }
  void give(WireItem item, std::uint16_t number) {
    item.seq = number;
    hear(item);
  }

  /// What was sent since the last call: "count 2", "item 0", ...
  std::vector<std::string> said() {
    std::vector<std::string> result;
    out_.drain([&](const OutgoingFrame& frame) {
      const auto view = mavlink::parse_frame(frame.bytes());
      const auto add = [&]<class M>(M, std::string_view name, auto member) {
        if (view->message == M::info.id)
          result.push_back(fmt::format("{} {}", name, mavlink::decode<M>(*view).*member));
      };
      add(messages::MissionCount{}, "count", &messages::MissionCount::count);
      add(messages::MissionItemInt{}, "item", &messages::MissionItemInt::seq);
      add(messages::MissionRequestInt{}, "request", &messages::MissionRequestInt::seq);
      add(messages::MissionRequestList{}, "list", &messages::MissionRequestList::mission_type);
      add(messages::MissionAck{}, "ack", &messages::MissionAck::type);
      add(messages::MissionClearAll{}, "clear", &messages::MissionClearAll::mission_type);
      add(messages::MissionSetCurrent{}, "current", &messages::MissionSetCurrent::seq);
    });
    return result;
  }

  /// The vehicle takes a plan, and gives it back.
  void complete(const std::vector<WireItem>& plan) {
    for (std::uint16_t i = 0; i < plan.size(); ++i) ask_for(i);
    acknowledge(messages::MAV_MISSION_ACCEPTED);
    read_back(plan);
  }
  void read_back(const std::vector<WireItem>& plan) {
    hear(messages::MissionCount{.count = static_cast<std::uint16_t>(plan.size())});
    for (std::uint16_t i = 0; i < plan.size(); ++i) give(plan[i], i);
  }
};

TEST_F(MissionClientTest, UploadsAndReadsBack) {
  use(Stack::px4);
  upload({waypoint(10), waypoint(20)});
  EXPECT_THAT(said(), ElementsAre("count 2"));
  ask_for(0);
  ask_for(1);
  EXPECT_THAT(said(), ElementsAre("item 0", "item 1"));
  acknowledge(messages::MAV_MISSION_ACCEPTED);
  EXPECT_THAT(said(), ElementsAre("list 0"));
  EXPECT_THAT(facts(), IsEmpty());
  read_back({waypoint(10), waypoint(20)});
  EXPECT_THAT(said(), ElementsAre("request 0", "request 1", "ack 0"));
  EXPECT_THAT(facts(), ElementsAre(MissionFact{.kind = Kind::uploaded, .request = MissionRequestId{1}}));
  EXPECT_FALSE(client_->is_busy());
}

TEST_F(MissionClientTest, SendsNothingThatTheVehicleHas) {
  use(Stack::px4);
  upload({waypoint(10)});
  complete({waypoint(10)});
  (void)said(), (void)facts();
  upload({waypoint(10)});
  wait({});
  EXPECT_THAT(said(), IsEmpty());
  EXPECT_THAT(facts(),
              ElementsAre(MissionFact{.kind = Kind::uploaded, .request = MissionRequestId{2}, .was_on_board = true}));
}

TEST_F(MissionClientTest, SendsItAfterAReboot) {
  use(Stack::px4);
  upload({waypoint(10)});
  complete({waypoint(10)});
  client_->on_reboot(now_);
  EXPECT_EQ(client_->plan(PlanType::mission), nullptr);
  (void)said();
  upload({waypoint(10)});
  EXPECT_THAT(said(), ElementsAre("count 1"));
}

TEST_F(MissionClientTest, BeginsAnewAfterAReboot) {
  use(Stack::px4);
  upload({waypoint(10), waypoint(20)});
  ask_for(0);
  client_->on_reboot(now_);
  (void)said();
  wait({});
  EXPECT_THAT(said(), ElementsAre("count 2"));
  for (int reboot = 2; reboot <= MissionClient::most_attempts; ++reboot) {
    EXPECT_THAT(facts(), IsEmpty());
    client_->on_reboot(now_);
    wait({});
  }
  EXPECT_EQ(facts().at(0).failure, MissionFailure::silent);
}

TEST_F(MissionClientTest, SendsItAfterAnotherStationHasUploaded) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  complete({waypoint(0), waypoint(10)});
  ASSERT_NE(client_->plan(PlanType::mission), nullptr);
  hear(messages::MissionRequest{.seq = 0, .mission_type = 1}, mavlink::SystemId{254});
  EXPECT_NE(client_->plan(PlanType::mission), nullptr) << "that was a fence";
  hear(messages::MissionRequest{.seq = 0}, mavlink::SystemId{254});
  EXPECT_EQ(client_->plan(PlanType::mission), nullptr);
}

TEST_F(MissionClientTest, SendsItWhenTheVehicleNamesAnotherContent) {
  use(Stack::px4);
  (void)client_->download(now_, PlanType::mission, voice_);
  hear(messages::MissionCount{.count = 1, .opaque_id = 77});
  give(waypoint(10), 0);
  ASSERT_NE(client_->plan(PlanType::mission), nullptr);
  hear(messages::MissionCurrent{.total = 1, .mission_id = 77});
  EXPECT_NE(client_->plan(PlanType::mission), nullptr);
  hear(messages::MissionCurrent{.total = 1, .mission_id = 78});
  EXPECT_EQ(client_->plan(PlanType::mission), nullptr);
}

TEST_F(MissionClientTest, AnswersARepeatedRequestOnceInARoundTrip) {
  use(Stack::px4);
  upload({waypoint(10), waypoint(20)});
  now_ += milliseconds{400};
  ask_for(0);
  now_ += milliseconds{250};
  ask_for(0);
  EXPECT_THAT(said(), ElementsAre("count 2", "item 0"));
  now_ += milliseconds{250};
  ask_for(0);
  EXPECT_THAT(said(), ElementsAre("item 0"));
}

TEST_F(MissionClientTest, RepeatsTheAnnouncementAndTheItemWhenNothingComes) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  wait(milliseconds{499});
  EXPECT_THAT(said(), ElementsAre("count 2"));
  wait(milliseconds{1});
  EXPECT_THAT(said(), ElementsAre("count 2"));
  ask_for(0);
  wait(milliseconds{1});
  ask_for(1);
  wait(milliseconds{110});
  EXPECT_THAT(said(), ElementsAre("item 0", "item 1", "item 1"));
}

TEST_F(MissionClientTest, IgnoresAWrongSequenceNumberAndSomebodyElsesTransfer) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  ask_for(0);
  acknowledge(messages::MAV_MISSION_INVALID_SEQUENCE);
  acknowledge(messages::MAV_MISSION_DENIED);
  hear(messages::MissionAck{.type = messages::MAV_MISSION_UNSUPPORTED}, mavlink::SystemId{254});
  hear(messages::MissionAck{.type = messages::MAV_MISSION_UNSUPPORTED, .mission_type = 1});
  ask_for(1);
  EXPECT_THAT(said(), ElementsAre("count 2", "item 0", "item 1"));
  EXPECT_THAT(facts(), IsEmpty());
}

TEST_F(MissionClientTest, BeginsAnewWhenTheVehicleHasGivenUp) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10), waypoint(20)});
  ask_for(0);
  ask_for(1);
  acknowledge(messages::MAV_MISSION_OPERATION_CANCELLED);
  (void)said();
  wait(milliseconds{999});
  EXPECT_THAT(said(), IsEmpty());
  wait(milliseconds{1});
  EXPECT_THAT(said(), ElementsAre("count 3"));
}

TEST_F(MissionClientTest, GoesOnWithATransferUntilTheVehicleHasGivenItUp) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  ask_for(0);
  wait(milliseconds{7990});
  EXPECT_THAT(said(), ::testing::Not(::testing::Contains("count 3")));
  wait(seconds{1});
  EXPECT_THAT(said(), ::testing::Contains("count 2"));
}

TEST_F(MissionClientTest, FailsWhenNothingEverAnswers) {
  use(Stack::px4);
  upload({waypoint(10)});
  wait(seconds{30});
  EXPECT_THAT(facts(), ElementsAre(MissionFact{.kind = Kind::failed,
                                               .request = MissionRequestId{1},
                                               .failure = MissionFailure::silent,
                                               .plan = PlanOnBoard::unknown}));
  EXPECT_EQ(client_->next_deadline(), std::nullopt);
}

TEST_F(MissionClientTest, TellsWhichItemIsRefused) {
  use(Stack::px4);
  upload({waypoint(10), waypoint(20)});
  ask_for(0);
  ask_for(1);
  acknowledge(messages::MAV_MISSION_INVALID_PARAM7);
  EXPECT_THAT(facts(), ElementsAre(MissionFact{.kind = Kind::failed,
                                               .request = MissionRequestId{1},
                                               .failure = MissionFailure::refused,
                                               .result = messages::MAV_MISSION_INVALID_PARAM7,
                                               .item = 1,
                                               .plan = PlanOnBoard::unchanged}));
}

TEST_F(MissionClientTest, PutsTheOldMissionBackThatArduPilotHasOverwritten) {
  use(Stack::ardupilot_copter);
  const std::vector<WireItem> old{waypoint(0), waypoint(10)};
  upload(old);
  complete(old);
  (void)facts(), (void)said();
  upload({waypoint(0), waypoint(99), waypoint(98)});
  ask_for(0);
  ask_for(1);
  acknowledge(messages::MAV_MISSION_UNSUPPORTED);
  EXPECT_THAT(said(), ElementsAre("count 3", "item 0", "item 1", "count 2"));
  complete(old);
  const auto told = facts();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].failure, MissionFailure::refused);
  EXPECT_EQ(told[0].item, 1);
  EXPECT_EQ(told[0].plan, PlanOnBoard::restored);
  ASSERT_NE(client_->plan(PlanType::mission), nullptr);
  EXPECT_EQ(client_->plan(PlanType::mission)->at(1).z, 10);
}

TEST_F(MissionClientTest, SaysThatTheMissionIsNotKnownWhenTheOldOneWasNot) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  ask_for(0);
  acknowledge(messages::MAV_MISSION_INVALID_PARAM7);
  const auto told = facts();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].plan, PlanOnBoard::unknown);
}

TEST_F(MissionClientTest, UploadsAgainWhatWasReadBackDifferently) {
  use(Stack::px4);
  upload({waypoint(10)});
  for (int attempt = 0; attempt < MissionClient::most_attempts; ++attempt) {
    EXPECT_THAT(facts(), IsEmpty());
    complete({waypoint(11)});
  }
  const auto told = facts();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].failure, MissionFailure::differs);
}

TEST_F(MissionClientTest, ReadsBackWhenTheLastAcknowledgementWasLost) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  ask_for(0);
  ask_for(1);
  wait(milliseconds{500});
  (void)said();
  acknowledge(messages::MAV_MISSION_ERROR);  // there is no transfer any more, it says of the copy
  EXPECT_THAT(said(), ElementsAre("list 0"));
  read_back({waypoint(50), waypoint(10)});
  EXPECT_EQ(facts().at(0).kind, Kind::uploaded);
}

TEST_F(MissionClientTest, ServesAnUploadThatBeginsAgainWhileItIsReadBack) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  ask_for(0);
  ask_for(1);
  acknowledge(messages::MAV_MISSION_ACCEPTED);
  (void)said();
  now_ += seconds{1};
  ask_for(0);  // a late copy of the announcement has arrived
  EXPECT_THAT(said(), ElementsAre("item 0"));
  ask_for(1);
  acknowledge(messages::MAV_MISSION_ACCEPTED);
  read_back({waypoint(0), waypoint(10)});
  EXPECT_EQ(facts().at(0).kind, Kind::uploaded);
}

TEST_F(MissionClientTest, WaitsForAVehicleThatIsOccupied) {
  use(Stack::ardupilot_copter);
  upload({waypoint(0), waypoint(10)});
  for (int i = 0; i < 29; ++i) {
    acknowledge(messages::MAV_MISSION_DENIED);
    wait(seconds{1});
  }
  EXPECT_THAT(facts(), IsEmpty());
  wait(seconds{2});
  const auto told = facts();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].failure, MissionFailure::occupied);
  EXPECT_EQ(told[0].plan, PlanOnBoard::unchanged);
}

TEST_F(MissionClientTest, AsksArduPilotForSeveralItemsAtOnceAndPx4ForOne) {
  use(Stack::ardupilot_copter);
  (void)client_->download(now_, PlanType::rally, voice_);
  hear(messages::MissionCount{.count = 7, .mission_type = 2});
  EXPECT_THAT(said(), ElementsAre("list 2", "request 0", "request 1", "request 2", "request 3", "request 4"));
  use(Stack::px4);
  (void)client_->download(now_, PlanType::mission, voice_);
  hear(messages::MissionCount{.count = 7});
  EXPECT_THAT(said(), ElementsAre("list 0", "request 0"));
}

TEST_F(MissionClientTest, AsksAgainOnlyForWhatIsMissing) {
  use(Stack::ardupilot_copter);
  (void)client_->download(now_, PlanType::mission, voice_);
  hear(messages::MissionCount{.count = 4});
  (void)said();
  now_ += milliseconds{20};
  for (const auto item : std::array<std::uint16_t, 3>{0, 1, 3}) give(waypoint(5), item);
  EXPECT_THAT(said(), IsEmpty());
  wait(milliseconds{100});
  EXPECT_THAT(said(), ElementsAre("request 2"));
  give(waypoint(5), 2);
  EXPECT_THAT(said(), ElementsAre("ack 0"));
  EXPECT_EQ(facts().at(0).kind, Kind::downloaded);
}

TEST_F(MissionClientTest, ConfirmsWhatWasSentInAnotherWay) {
  use(Stack::ardupilot_copter);
  (void)client_->confirm(now_, PlanType::mission, {waypoint(0), waypoint(10)}, voice_);
  ask_for(0);  // nothing that we could answer
  EXPECT_THAT(said(), ElementsAre("list 0"));
  read_back({waypoint(50), waypoint(10)});
  EXPECT_EQ(facts().at(0).kind, Kind::uploaded);
  EXPECT_NE(client_->plan(PlanType::mission), nullptr);
}

TEST_F(MissionClientTest, UploadsWhatWasSentInAnotherWayAndIsNotThere) {
  use(Stack::ardupilot_copter);
  (void)client_->confirm(now_, PlanType::mission, {waypoint(0), waypoint(10)}, voice_);
  read_back({waypoint(50)});
  EXPECT_THAT(said(), ElementsAre("list 0", "request 0", "ack 0", "count 2"));
  complete({waypoint(50), waypoint(10)});
  EXPECT_EQ(facts().at(0).kind, Kind::uploaded);
}

TEST_F(MissionClientTest, ClearsAndMakesSure) {
  use(Stack::ardupilot_copter);
  (void)client_->clear(now_, PlanType::mission, voice_);
  acknowledge(messages::MAV_MISSION_ACCEPTED);
  EXPECT_THAT(said(), ElementsAre("clear 0", "list 0"));
  read_back({waypoint(50)});  // its home
  EXPECT_EQ(facts().at(0).kind, Kind::cleared);
}

TEST_F(MissionClientTest, SaysThatClearingIsRefused) {
  use(Stack::ardupilot_copter);
  (void)client_->clear(now_, PlanType::mission, voice_);
  acknowledge(messages::MAV_MISSION_ERROR);
  EXPECT_EQ(facts().at(0).failure, MissionFailure::refused);
}

TEST_F(MissionClientTest, SetsTheCurrentItemAndWaitsUntilItIs) {
  use(Stack::px4);
  (void)client_->set_current(now_, 3, voice_);
  hear(messages::MissionCurrent{.seq = 2});
  EXPECT_THAT(facts(), IsEmpty());
  wait(milliseconds{500});
  EXPECT_THAT(said(), ElementsAre("current 3", "current 3"));
  hear(messages::MissionCurrent{.seq = 3});
  EXPECT_EQ(facts().at(0).kind, Kind::current_set);
}

TEST_F(MissionClientTest, RefusesWhatCannotBegin) {
  use(Stack::px4);
  upload({waypoint(10)});
  EXPECT_EQ(client_->download(now_, PlanType::rally, voice_), fail(MissionRefusal::busy));
  use(Stack::px4);
  EXPECT_EQ(client_->upload(now_, PlanType::mission, std::vector<WireItem>(PlanDownload::item_limit + 1), voice_),
            fail(MissionRefusal::too_many_items));
  sender_.set_version(mavlink::Version::v1);
  EXPECT_EQ(client_->download(now_, PlanType::rally, voice_), fail(MissionRefusal::needs_mavlink_2));
  EXPECT_TRUE(client_->download(now_, PlanType::mission, voice_).has_value());
  sender_.set_version(mavlink::Version::v0_9);
  use(Stack::px4);
  EXPECT_EQ(client_->clear(now_, PlanType::mission, voice_), fail(MissionRefusal::not_in_mavlink_09));
}

}  // namespace
}  // namespace ponte::autopilot
