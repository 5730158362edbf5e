#include "replay/dialogue.hpp"

#include "ponte/autopilot/command_client.hpp"
#include "ponte/mavlink/autopilots/command_int.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>

// Our client asks for what the recorded station asked for. The recorded autopilot answers each of our messages as it
// answered the same message then, with the time it took.
namespace ponte::replay {
namespace {

namespace messages = mavlink::autopilots;
using autopilot::Command;
using autopilot::CommandFact;
using autopilot::CommandId;
using autopilot::Stack;

constexpr std::uint8_t vehicle_component = 1;

/// The command in a frame to the autopilot itself.
std::optional<Command> command_in(const mavlink::FrameView& frame) {
  const auto is_ours = [](const auto& m) {
    return m.target_system == vehicle_system.value && m.target_component == vehicle_component;
  };
  if (mavlink::carries<messages::CommandLong>(frame)) {
    const auto m = mavlink::decode<messages::CommandLong>(frame);
    if (!is_ours(m)) return std::nullopt;
    return Command{m.command, m.param1, m.param2, m.param3, m.param4, double{m.param5}, double{m.param6}, m.param7, {}};
  }
  if (mavlink::carries<messages::CommandInt>(frame)) {
    const auto m = mavlink::decode<messages::CommandInt>(frame);
    if (!is_ours(m)) return std::nullopt;
    return Command{m.command, m.param1, m.param2, m.param3, m.param4, m.x * 1e-7, m.y * 1e-7, m.z, m.frame};
  }
  return std::nullopt;
}

/// One command of the recorded station, and what the vehicle said until the next one.
struct Exchange {
  const Dialogue::Entry* question{};
  std::vector<const Dialogue::Entry*> answers{};
  std::optional<std::uint8_t> result{};  // MAV_RESULT
  bool is_used{};
};

std::vector<Exchange> exchanges_in(const Dialogue& dialogue) {
  std::vector<Exchange> exchanges;
  bool is_open = false;
  for (const auto& entry : dialogue.entries()) {
    if (entry.is_of_station()) {
      const bool is_command =
          mavlink::carries<messages::CommandLong>(entry.frame) || mavlink::carries<messages::CommandInt>(entry.frame);
      if (is_command) is_open = command_in(entry.frame).has_value();
      if (is_command && is_open) exchanges.push_back({.question = &entry});
      continue;
    }
    if (!is_open) continue;
    exchanges.back().answers.push_back(&entry);
    if (!mavlink::carries<messages::CommandAck>(entry.frame)) continue;
    const auto ack = mavlink::decode<messages::CommandAck>(entry.frame);
    if (ack.target_system == station_system.value) exchanges.back().result = ack.result;
  }
  return exchanges;
}

/// The client before the autopilot of a recording.
class Stage {
 public:
  Stage(const Dialogue& dialogue, Stack stack)
      : exchanges_{exchanges_in(dialogue)}, client_{{vehicle_system, mavlink::ComponentId{vehicle_component}, stack}} {}

  /// Asks for everything at the times at which the recorded station did, and lets all answers come.
  void play() {
    for (const auto& each : exchanges_) {
      go_on_until(Timestamp{each.question->time});
      const auto request = client_.request(now_, *command_in(each.question->frame), voice_);
      ASSERT_TRUE(request);
      asked_[*request] = &each;
      answer();
    }
    go_on_until(now_ + std::chrono::minutes{1});
  }

  [[nodiscard]] const std::vector<Exchange>& exchanges() const { return exchanges_; }
  /// What was told of the command of this exchange.
  [[nodiscard]] std::vector<CommandFact> told_of(const Exchange& exchange) const {
    std::vector<CommandFact> result;
    for (const auto& fact : told_)
      if (asked_.at(fact.request) == &exchange) result.push_back(fact);
    return result;
  }

 private:
  void go_on_until(Timestamp end) {
    while (true) {
      auto next = client_.next_deadline().value_or(end);
      if (!underway_.empty()) next = std::min(next, underway_.begin()->first);
      if (next > end) break;
      now_ = std::max(now_, next);
      while (!underway_.empty() && underway_.begin()->first <= now_) {
        client_.on_message(now_, underway_.extract(underway_.begin()).mapped()->frame, voice_, facts_);
        answer();
      }
      client_.on_tick(now_, voice_, facts_);
      answer();
      if (next == end) break;
    }
    now_ = std::max(now_, end);
    facts_.drain([this](const CommandFact& fact) { told_.push_back(fact); });
  }

  /// Finds what the vehicle said to each message that the client has sent.
  void answer() {
    out_.drain([this](const autopilot::OutgoingFrame& sent) {
      const auto frame = mavlink::parse_frame(sent.bytes());
      ASSERT_TRUE(frame);
      const auto is_same = [&](const Exchange& exchange) {
        return !exchange.is_used && frame->message == exchange.question->frame.message &&
               std::ranges::equal(frame->payload, exchange.question->frame.payload);
      };
      const auto found = std::ranges::find_if(exchanges_, is_same);
      ASSERT_NE(found, exchanges_.end()) << "no station has sent this to the vehicle: command "
                                         << command_in(*frame).value_or(Command{}).number;
      found->is_used = true;
      for (const auto* each : found->answers) underway_.emplace(now_ + (each->time - found->question->time), each);
    });
  }

  std::vector<Exchange> exchanges_;
  autopilot::CommandClient client_;
  mavlink::FrameSender sender_{mavlink::Version::v2, station_system, mavlink::ComponentId{190}};
  Outbox<autopilot::OutgoingFrame> out_{64};
  autopilot::Voice voice_{sender_, autopilot::LinkId{1}, out_};
  Outbox<CommandFact> facts_{256};
  std::vector<CommandFact> told_;
  std::map<CommandId, const Exchange*> asked_;
  std::multimap<Timestamp, const Dialogue::Entry*> underway_;
  Timestamp now_{};
};

struct Recording {
  std::string_view name;
  Stack stack;
};

class CommandsOf : public testing::TestWithParam<Recording> {};

TEST_P(CommandsOf, AreSentOnceAndUnderstoodAsTheyWereAnswered) {
  const Dialogue dialogue{GetParam().name};
  Stage stage{dialogue, GetParam().stack};
  ASSERT_FALSE(stage.exchanges().empty());
  stage.play();
  for (const auto& exchange : stage.exchanges()) {
    const auto number = command_in(exchange.question->frame)->number;
    SCOPED_TRACE(number);
    ASSERT_TRUE(exchange.result) << "the recording has no answer";
    EXPECT_TRUE(exchange.is_used) << "the client did not send it";
    const auto told = stage.told_of(exchange);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].attempts, 1);
    EXPECT_EQ(told[0].result, *exchange.result);
    const bool is_accepted = *exchange.result == messages::MAV_RESULT_ACCEPTED;
    EXPECT_EQ(told[0].kind, is_accepted ? CommandFact::Kind::accepted : CommandFact::Kind::refused);
  }
}

INSTANTIATE_TEST_SUITE_P(Replay, CommandsOf,
                         testing::Values(Recording{"ap_rest_v2", Stack::ardupilot_copter},
                                         Recording{"ap_mission_v2", Stack::ardupilot_copter},
                                         Recording{"ap_protocol_v2", Stack::ardupilot_copter},
                                         Recording{"plane_mission_v2", Stack::ardupilot_plane},
                                         Recording{"px4_rest_v2", Stack::px4}, Recording{"px4_mission_v2", Stack::px4}),
                         [](const auto& recording) { return std::string{recording.param.name}; });

}  // namespace
}  // namespace ponte::replay
