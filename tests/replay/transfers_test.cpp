#include "replay/dialogue.hpp"

#include "ponte/autopilot/mission_client.hpp"
#include "ponte/autopilot/parameter_client.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/autopilots/mission_request_list.hpp"
#include "ponte/mavlink/autopilots/param_request_read.hpp"
#include "ponte/mavlink/autopilots/param_set.hpp"
#include "ponte/mavlink/codec.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

// What real autopilots said in recorded transfers is said to our clients, which have to say what an attentive station
// would: each thing once, and nothing that was not asked for.
namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

constexpr mavlink::SystemId vehicle{1};

using replay::Dialogue;
using Recorded = Dialogue::Entry;

/// Whether the recorded station begins another exchange with this.
bool opens(const mavlink::FrameView& frame) {
  return frame.system != vehicle &&
         (mavlink::carries<messages::MissionCount>(frame) || mavlink::carries<messages::MissionRequestList>(frame) ||
          mavlink::carries<messages::MissionClearAll>(frame) || mavlink::carries<messages::ParamRequestRead>(frame) ||
          mavlink::carries<messages::ParamSet>(frame));
}

using Exchange = std::span<const Recorded>;

/// The recording, cut where the recorded station began another exchange. What comes before the first is left out.
std::vector<Exchange> exchanges(const Dialogue& dialogue) {
  const auto& frames = dialogue.entries();
  std::vector<Exchange> result;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (opens(frames[i].frame)) result.push_back(Exchange{frames}.subspan(i, 0));
    if (!result.empty()) result.back() = {result.back().data(), result.back().size() + 1};
  }
  return result;
}

/// Those that the recorded station began with this message.
template <mavlink::Message M>
std::vector<Exchange> exchanges_of(const Dialogue& dialogue) {
  auto result = exchanges(dialogue);
  std::erase_if(result, [](Exchange each) { return !mavlink::carries<M>(each.front().frame); });
  return result;
}

/// What belongs to a transfer, of all that a vehicle says.
bool is_of_a_transfer(const mavlink::FrameView& frame) {
  return mavlink::carries<messages::MissionRequest>(frame) || mavlink::carries<messages::MissionRequestInt>(frame) ||
         mavlink::carries<messages::MissionAck>(frame) || mavlink::carries<messages::MissionCount>(frame) ||
         mavlink::carries<messages::MissionItemInt>(frame) || mavlink::carries<messages::ParamValue>(frame) ||
         mavlink::carries<messages::ParamError>(frame);
}

/// A client in the place of the recorded station. The vehicle's frames come 5 ms after one another, as its answers did:
/// how long the recorded station waited between its questions does not count.
template <class Client, class Fact>
class Player {
 public:
  explicit Player(Stack stack) : client{Peer{vehicle, mavlink::ComponentId{1}, stack}} {}

  void play(Exchange exchange) {
    for (const auto& each : exchange) {
      if (each.is_of_station() || !is_of_a_transfer(each.frame)) continue;
      now += milliseconds{5};
      client.on_tick(now, voice, facts_);
      client.on_message(now, each.frame, voice, facts_);
    }
  }

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
      add(messages::ParamRequestRead{}, "read", &messages::ParamRequestRead::param_index);
      add(messages::ParamSet{}, "set", &messages::ParamSet::param_value);
    });
    return result;
  }
  std::vector<Fact> facts() {
    std::vector<Fact> result;
    facts_.drain([&](const Fact& fact) {
      if (fact.kind != Fact::Kind::progress) result.push_back(fact);
    });
    return result;
  }

  Client client;
  Timestamp now{};
  mavlink::FrameSender sender{mavlink::Version::v2, mavlink::SystemId{255}, mavlink::ComponentId{190}};

 private:
  Outbox<OutgoingFrame> out_{256};
  Outbox<Fact> facts_{256};

 public:
  Voice voice{sender, LinkId{}, out_};
};
using MissionPlayer = Player<MissionClient, MissionFact>;
using ParameterPlayer = Player<ParameterClient, ParameterFact>;

/// Begins the upload of what the recorded station sent.
void begin_upload(MissionPlayer& player, Exchange exchange) {
  const auto count = mavlink::decode<messages::MissionCount>(exchange.front().frame);
  std::vector<WireItem> items(count.count);
  for (const auto& each : exchange) {
    if (!each.is_of_station() || !mavlink::carries<messages::MissionItemInt>(each.frame)) continue;
    const auto item = mavlink::decode<messages::MissionItemInt>(each.frame);
    if (item.seq < items.size()) items[item.seq] = item;
  }
  (void)player.client.upload(player.now, static_cast<PlanType>(count.mission_type), items, player.voice);
}

std::vector<std::string> numbered(std::string_view name, std::size_t first, std::size_t end) {
  std::vector<std::string> result;
  for (auto i = first; i < end; ++i) result.push_back(fmt::format("{} {}", name, i));
  return result;
}

struct Flight {
  std::string_view name;
  Stack stack;
  std::size_t items;
};

class ReplayedFlight : public ::testing::TestWithParam<Flight> {};

TEST_P(ReplayedFlight, IsUploadedAndReadBackWithoutARepeat) {
  const Dialogue dialogue{GetParam().name};
  const auto uploads = exchanges_of<messages::MissionCount>(dialogue);
  const auto downloads = exchanges_of<messages::MissionRequestList>(dialogue);
  ASSERT_EQ(uploads.size(), 1U);
  MissionPlayer player{GetParam().stack};
  begin_upload(player, uploads[0]);
  player.play(uploads[0]);
  auto expected = numbered("item", 0, GetParam().items);
  expected.insert(expected.begin(), fmt::format("count {}", GetParam().items));
  expected.emplace_back("list 0");
  EXPECT_THAT(player.said(), ElementsAreArray(expected));
  EXPECT_THAT(player.facts(), IsEmpty());
  if (downloads.empty()) return;  // as far as it was recorded

  player.play(downloads[0]);
  expected = numbered("request", 0, GetParam().items);
  expected.emplace_back("ack 0");
  EXPECT_THAT(player.said(), ElementsAreArray(expected));
  const auto facts = player.facts();
  ASSERT_EQ(facts.size(), 1U);
  EXPECT_EQ(facts[0].kind, MissionFact::Kind::uploaded) << "what the real one keeps is what was sent";
}

INSTANTIATE_TEST_SUITE_P(Recorded, ReplayedFlight,
                         ::testing::Values(Flight{"ap_mission_v2", Stack::ardupilot_copter, 9},
                                           Flight{"plane_mission_v2", Stack::ardupilot_plane, 11},
                                           Flight{"px4_mission_v2", Stack::px4, 8}),
                         [](const auto& instance) { return std::string{instance.param.name}; });

TEST(ReplayedClear, IsMadeSureOf) {
  const Dialogue dialogue{"px4_mission_v2"};
  const auto clears = exchanges_of<messages::MissionClearAll>(dialogue);
  const auto downloads = exchanges_of<messages::MissionRequestList>(dialogue);
  ASSERT_EQ(clears.size(), 1U);
  MissionPlayer player{Stack::px4};
  (void)player.client.clear(player.now, PlanType::mission, player.voice);
  player.play(clears[0]);
  EXPECT_THAT(player.said(), ElementsAre("clear 0", "list 0"));
  player.play(downloads.back());
  EXPECT_THAT(player.said(), ElementsAre("ack 0"));
  EXPECT_EQ(player.facts().at(0).kind, MissionFact::Kind::cleared);
}

/// What became of an upload that ArduPilot treated so.
class ReplayedErrors : public ::testing::Test {
 protected:
  MissionPlayer& play(std::size_t upload) {
    begin_upload(player_, uploads_.at(upload));
    player_.play(uploads_.at(upload));
    return player_;
  }

  Dialogue dialogue_{"ap_protocol_v2"};
  std::vector<Exchange> uploads_{exchanges_of<messages::MissionCount>(dialogue_)};
  MissionPlayer player_{Stack::ardupilot_copter};
};

TEST_F(ReplayedErrors, ThereWereTenUploads) { EXPECT_EQ(uploads_.size(), 10U); }

TEST_F(ReplayedErrors, NoItemsAreAccepted) { EXPECT_THAT(play(0).said(), ElementsAre("count 0", "list 0")); }

TEST_F(ReplayedErrors, TooManyItemsAreRefusedAndChangeNothing) {
  const auto fact = play(1).facts().at(0);
  EXPECT_EQ(fact.failure, MissionFailure::refused);
  EXPECT_EQ(fact.result, messages::MAV_MISSION_NO_SPACE);
  EXPECT_EQ(fact.plan, PlanOnBoard::unchanged);
}

// The recorded station kept silent, and the vehicle gave up; ours begins anew.
TEST_F(ReplayedErrors, AnUploadThatTheVehicleHasGivenUpBeginsAnew) {
  auto& player = play(2);
  EXPECT_THAT(player.facts(), IsEmpty());
  (void)player.said();
  player.now += std::chrono::seconds{1};
  Outbox<MissionFact> facts{16};
  player.client.on_tick(player.now, player.voice, facts);
  EXPECT_THAT(player.said(), ElementsAre("count 9"));
}

// The recorded station sent items out of order and twice: the vehicle said INVALID_SEQUENCE, and went on.
TEST_F(ReplayedErrors, AWrongSequenceNumberEndsNothing) {
  auto& player = play(3);
  EXPECT_THAT(player.said(), ElementsAre("count 9", "item 0", "item 1"));
  EXPECT_THAT(player.facts(), IsEmpty());
  EXPECT_TRUE(player.client.is_busy());
}

TEST_F(ReplayedErrors, ARefusedItemIsNamedWithTheReason) {
  struct Refusal {
    std::size_t upload;
    unsigned result;
  };
  for (const auto& [upload, result] :
       {Refusal{5, messages::MAV_MISSION_UNSUPPORTED}, Refusal{6, messages::MAV_MISSION_INVALID_PARAM5_X},
        Refusal{7, messages::MAV_MISSION_UNSUPPORTED_FRAME}}) {
    const auto facts = play(upload).facts();
    ASSERT_EQ(facts.size(), 1U) << upload;
    EXPECT_EQ(facts[0].result, result);
    EXPECT_EQ(facts[0].item, 3);
    EXPECT_EQ(facts[0].plan, PlanOnBoard::unknown);
  }
}

TEST_F(ReplayedErrors, AFenceIsUploadedToo) {
  EXPECT_THAT(play(9).said(), ElementsAre("count 4", "item 0", "item 1", "item 2", "item 3", "list 1"));
}

/// What becomes of the exchange that the recorded station began, when ours begins it.
template <mavlink::Message M>
std::vector<std::string> outcomes(std::string_view name, Stack stack) {
  std::vector<std::string> result;
  const Dialogue dialogue{name};
  for (const auto& exchange : exchanges_of<M>(dialogue)) {
    ParameterPlayer player{stack};
    const auto request = mavlink::decode<M>(exchange.front().frame);
    const auto parameter = request.param_id.view();
    if constexpr (std::is_same_v<M, messages::ParamSet>) {
      // Its type is known, or the vehicle would be asked for it first.
      player.client.take_over({{request.param_id, *parameter_type(request.param_type), 0}});
      const auto type = *parameter_type(request.param_type);
      (void)player.client.set(player.now, parameter, decode_parameter(stack, type, request.param_value), player.voice);
    } else {
      if (request.param_index >= 0) continue;  // by index
      (void)player.client.get(player.now, parameter, player.voice);
    }
    player.play(exchange);
    EXPECT_EQ(player.said().size(), 1U) << "each thing is said once";
    const auto facts = player.facts();
    const auto outcome = [&]() -> std::string {
      if (facts.empty()) return "nothing yet";
      switch (facts[0].kind) {
        case ParameterFact::Kind::got: return "got";
        case ParameterFact::Kind::set: return "set";
        default: return fmt::format("error {}", facts[0].error);
      }
    }();
    result.push_back(outcome);
    EXPECT_LE(facts.size(), 1U);
  }
  return result;
}

TEST(ReplayedParameters, OfArduPilotAreReadAndSet) {
  EXPECT_THAT(outcomes<messages::ParamRequestRead>("ap_params_v2", Stack::ardupilot_copter),
              ElementsAre("nothing yet", "got", "got", "nothing yet"));
  EXPECT_THAT(outcomes<messages::ParamSet>("ap_params_v2", Stack::ardupilot_copter),
              ElementsAre("set", "set", "set", "nothing yet", "set", "set"));
}

TEST(ReplayedParameters, OfPx4AreReadSetAndRefused) {
  EXPECT_THAT(outcomes<messages::ParamRequestRead>("px4_params_v2", Stack::px4), ElementsAre("got", "error 1"));
  EXPECT_THAT(outcomes<messages::ParamSet>("px4_params_v2", Stack::px4),
              ElementsAre("set", "error 1", "set", "error 7"));
}

}  // namespace
}  // namespace ponte::autopilot
