#include "ponte/autopilot/parameter_client.hpp"

#include "ponte/autopilot/test_client.hpp"
#include "ponte/mavlink/autopilots/param_request_list.hpp"
#include "ponte/mavlink/autopilots/param_request_read.hpp"
#include "ponte/mavlink/autopilots/param_set.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <string>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::station_component;
using testing::station_system;
using testing::TestFrame;
using testing::vehicle_system;
using Kind = ParameterFact::Kind;

constexpr std::uint8_t real32 = 9;
constexpr std::uint8_t int32 = 6;
constexpr std::uint16_t no_index = 65535;

class ParameterClientTest : public testing::ClientTest<ParameterClient, ParameterFact> {
 protected:
  template <mavlink::Message M>
  void hear(const M& message) {
    ClientTest::hear(TestFrame{message});
  }
  void tell(std::string_view name, float value, std::uint16_t index, std::uint16_t count, std::uint8_t type = real32) {
    hear(messages::ParamValue{
        .param_id = name, .param_value = value, .param_type = type, .param_count = count, .param_index = index});
  }
  void tell_hash(std::uint32_t hash) { tell("_HASH_CHECK", std::bit_cast<float>(hash), no_index, 2, 5); }

  /// What was sent since the last call: "list", "read A", "read 7", "set A 1".
  std::vector<std::string> said() {
    std::vector<std::string> result;
    out_.drain([&](const OutgoingFrame& frame) {
      const auto view = mavlink::parse_frame(frame.bytes());
      if (view->message == messages::ParamRequestList::info.id) result.emplace_back("list");
      if (view->message == messages::ParamRequestRead::info.id) {
        const auto read = mavlink::decode<messages::ParamRequestRead>(*view);
        result.push_back(read.param_index < 0 ? fmt::format("read {}", read.param_id.view())
                                              : fmt::format("read {}", read.param_index));
      }
      if (view->message == messages::ParamSet::info.id) {
        const auto set = mavlink::decode<messages::ParamSet>(*view);
        result.push_back(fmt::format("set {} {}", set.param_id.view(), set.param_value));
      }
    });
    return result;
  }
};

TEST_F(ParameterClientTest, FetchesTheListAndWhatIsMissing) {
  use(Stack::ardupilot_copter);
  (void)client_->fetch_all(now_, voice_);
  EXPECT_THAT(said(), ElementsAre("list"));
  tell("A", 1, 0, 4);
  tell("C", 3, 2, 4);
  wait(milliseconds{999});
  EXPECT_THAT(said(), IsEmpty());
  wait(milliseconds{1});
  EXPECT_THAT(said(), ElementsAre("read 1", "read 3"));
  tell("B", 2, 1, 4);
  EXPECT_THAT(facts(), IsEmpty());
  tell("D", 4, 3, 4);
  EXPECT_THAT(facts(), ElementsAre(ParameterFact{.kind = Kind::fetched, .request = ParameterRequestId{1}, .total = 4}));
  EXPECT_TRUE(client_->is_complete());
  EXPECT_THAT(client_->known(), SizeIs(4));
  EXPECT_EQ(client_->find("C")->value, 3);
  EXPECT_EQ(client_->find("E"), nullptr);
}

TEST_F(ParameterClientTest, AsksForAtMostTenAtATime) {
  use(Stack::ardupilot_copter);
  (void)client_->fetch_all(now_, voice_);
  tell("A0", 1, 0, 30);
  wait(seconds{1});
  EXPECT_THAT(said(), SizeIs(1 + 10));
  tell("A1", 1, 1, 30);
  EXPECT_THAT(said(), ElementsAre("read 11"));
}

TEST_F(ParameterClientTest, AsksForTheListAgainWhenNothingComes) {
  use(Stack::px4);
  (void)client_->fetch_all(now_, voice_);
  wait(seconds{1});
  EXPECT_THAT(said(), ElementsAre("list", "list"));
  wait(seconds{10});
  EXPECT_EQ(facts().at(0).failure, ParameterFailure::silent);
  EXPECT_EQ(client_->next_deadline(), std::nullopt);
}

// As ArduPilot's grew from 1335 to 1348 while it started.
TEST_F(ParameterClientTest, ForgetsTheOldPlacesWhenTheListGrows) {
  use(Stack::ardupilot_copter);
  (void)client_->fetch_all(now_, voice_);
  tell("A", 1, 0, 2);
  tell("A0", 5, 0, 3);
  tell("A", 1, 1, 3);
  EXPECT_THAT(facts(), IsEmpty());
  tell("B", 2, 2, 3);
  EXPECT_THAT(facts(), SizeIs(1));
  EXPECT_THAT(client_->known(), SizeIs(3));
}

TEST_F(ParameterClientTest, DoesNotTakeWhatIsToldUnaskedForTheList) {
  use(Stack::ardupilot_copter);
  (void)client_->fetch_all(now_, voice_);
  tell("STAT_RUNTIME", 1, no_index, 1335);
  tell("A", 1, no_index, 2);
  tell("A", 2, 0, 2);
  tell("STAT_RUNTIME", 1, 1, 2);
  EXPECT_EQ(facts().at(0).total, 2);
  EXPECT_THAT(client_->known(), SizeIs(2));
  EXPECT_EQ(client_->find("A")->value, 2);
}

TEST_F(ParameterClientTest, AsksPx4OnlyForItsHashWhenItKnowsTheList) {
  use(Stack::px4);
  (void)client_->fetch_all(now_, voice_);
  tell_hash(77);
  tell("A", 1, 0, 2);
  tell("B", 2, 1, 2);
  (void)facts(), (void)said();
  (void)client_->fetch_all(now_, voice_);
  EXPECT_THAT(said(), ElementsAre("read _HASH_CHECK"));
  tell_hash(77);
  EXPECT_THAT(facts(), ElementsAre(ParameterFact{
                           .kind = Kind::fetched, .request = ParameterRequestId{2}, .total = 2, .was_known = true}));
  (void)client_->fetch_all(now_, voice_);
  tell_hash(78);
  EXPECT_THAT(said(), ElementsAre("read _HASH_CHECK", "list"));
}

TEST_F(ParameterClientTest, FetchesTheListAgainAfterAReboot) {
  use(Stack::px4);
  (void)client_->fetch_all(now_, voice_);
  tell_hash(77);
  tell("A", 1, 0, 1);
  client_->on_reboot();
  EXPECT_FALSE(client_->is_complete());
  (void)said();
  (void)client_->fetch_all(now_, voice_);
  EXPECT_THAT(said(), ElementsAre("list"));
}

TEST_F(ParameterClientTest, GetsOneByName) {
  use(Stack::px4);
  (void)client_->get(now_, "B", voice_);
  EXPECT_THAT(said(), ElementsAre("read B"));
  tell("A", 1, 0, 2);
  EXPECT_THAT(facts(), IsEmpty());
  tell("B", std::bit_cast<float>(5), 1, 2, int32);
  EXPECT_EQ(facts().at(0).parameter, (Parameter{ParameterName{"B"}, ParameterType::int32, 5}));
}

TEST_F(ParameterClientTest, TellsThatPx4RefusesAndThatArduPilotIsSilent) {
  use(Stack::px4);
  (void)client_->get(now_, "NONE", voice_);
  messages::ParamError error{
      .target_system = 254, .target_component = 190, .param_id = std::string_view{"NONE"}, .error = 1};
  hear(error);
  EXPECT_THAT(facts(), IsEmpty()) << "that was for somebody else";
  error.target_system = station_system.value;
  hear(error);
  const auto told = facts();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].failure, ParameterFailure::refused);
  EXPECT_EQ(told[0].error, 1);

  use(Stack::ardupilot_copter);
  (void)client_->get(now_, "NONE", voice_);
  wait(seconds{10});
  EXPECT_EQ(facts().at(0).failure, ParameterFailure::silent);
}

TEST_F(ParameterClientTest, SetsAfterItHasAskedForTheType) {
  use(Stack::px4);
  (void)client_->set(now_, "B", 7, voice_);
  EXPECT_THAT(said(), ElementsAre("read B"));
  tell("B", std::bit_cast<float>(5), 1, 2, int32);
  EXPECT_THAT(said(), ElementsAre(fmt::format("set B {}", std::bit_cast<float>(7))));
  EXPECT_THAT(facts(), IsEmpty());
  tell("B", std::bit_cast<float>(7), 1, 2, int32);
  tell("B", std::bit_cast<float>(7), 1, 2, int32);  // PX4 says it twice
  EXPECT_THAT(facts(), ElementsAre(ParameterFact{.kind = Kind::set,
                                                 .request = ParameterRequestId{1},
                                                 .parameter = {ParameterName{"B"}, ParameterType::int32, 7}}));
  EXPECT_EQ(client_->find("B")->value, 7);
}

TEST_F(ParameterClientTest, IsNotSetUntilTheVehicleSaysSo) {
  use(Stack::ardupilot_copter);
  tell("A", 1, 0, 1);
  (void)client_->set(now_, "A", 2, voice_);
  EXPECT_THAT(said(), ElementsAre("set A 2"));
  tell("A", 1, no_index, 1);  // late news
  EXPECT_THAT(facts(), IsEmpty());
  wait(seconds{1});
  EXPECT_THAT(said(), ElementsAre("set A 2", "read A"));
  tell("A", 2, no_index, 1);
  EXPECT_EQ(facts().at(0).kind, Kind::set);
}

TEST_F(ParameterClientTest, TellsThatTheVehicleKeepsAnotherValue) {
  use(Stack::ardupilot_copter);
  tell("A", 1, 0, 1);
  (void)client_->set(now_, "A", 2, voice_);
  for (int i = 0; i < 10 && client_->is_busy(); ++i) {
    tell("A", 1.5, no_index, 1);
    wait(seconds{1});
  }
  const auto told = facts();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].failure, ParameterFailure::differs);
  EXPECT_EQ(told[0].parameter.value, 1.5);
}

TEST_F(ParameterClientTest, RefusesWhatCannotBegin) {
  use(Stack::px4);
  tell("B", std::bit_cast<float>(5), 1, 2, int32);
  EXPECT_EQ(client_->set(now_, "B", 1.5, voice_), fail(ParameterRefusal::bad_value));
  EXPECT_EQ(client_->get(now_, "", voice_), fail(ParameterRefusal::bad_name));
  EXPECT_EQ(client_->get(now_, "ABCDEFGHIJKLMNOPQ", voice_), fail(ParameterRefusal::bad_name));
  (void)client_->get(now_, "B", voice_);
  EXPECT_EQ(client_->fetch_all(now_, voice_), fail(ParameterRefusal::busy));
  use(Stack::px4);
  sender_.set_version(mavlink::Version::v0_9);
  EXPECT_EQ(client_->fetch_all(now_, voice_), fail(ParameterRefusal::not_in_mavlink_09));
}

TEST_F(ParameterClientTest, TellsThatATypeHasNoSuchValueOnceItIsKnown) {
  use(Stack::ardupilot_copter);
  (void)client_->set(now_, "B", 1.5, voice_);
  tell("B", 5, no_index, 2, int32);
  EXPECT_EQ(facts().at(0).failure, ParameterFailure::bad_value);
}

}  // namespace
}  // namespace ponte::autopilot
