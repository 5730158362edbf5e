#include "ponte/transport/replay.hpp"

#include "ponte/core/bytes.hpp"
#include "ponte/transport/test_witness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ponte::transport {
namespace {

using namespace std::chrono_literals;
using testing::Datagram;
using ::testing::ElementsAre;
using ::testing::SizeIs;
using testing::wait_for;
using testing::Witness;

struct Recorded {
  WallTime time;
  std::string text;
};

constexpr auto noon = WallTime{1'700'000'000s};

/// Hands out records from memory, and fails the test when it is asked beyond the end.
ReplaySource source_of(std::vector<Recorded> records) {
  auto state = std::make_shared<std::pair<std::vector<Recorded>, std::size_t>>(std::move(records), 0);
  return [state]() -> std::optional<ReplayRecord> {
    auto& [all, next] = *state;
    EXPECT_LE(next, all.size()) << "asked again after the end";
    const auto index = next++;
    if (index >= all.size()) return {};
    return ReplayRecord{all[index].time, bytes_of(all[index].text)};
  };
}

TEST(Replay, KeepsThePaceOfTheRecording) {
  Loop loop;
  Witness witness;
  const Replay replay{loop, source_of({{noon, "a"}, {noon + 10ms, "b"}, {noon + 10ms, "c"}, {noon + 40ms, "d"}}), 1,
                      witness};
  EXPECT_THAT(witness.states, SizeIs(0)) << "begins when the loop runs";
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_THAT(witness.datagrams, ElementsAre(Datagram{Replay::peer, "a"}, Datagram{Replay::peer, "b"},
                                             Datagram{Replay::peer, "c"}, Datagram{Replay::peer, "d"}));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::up, LinkState::down));
  EXPECT_EQ(witness.reasons.back(), "end of file");
  EXPECT_THAT(witness.joined, ElementsAre(Replay::peer));
  EXPECT_THAT(witness.left, ElementsAre(Replay::peer));
  // Never early. The beginning itself may be late by what the machine was busy with.
  EXPECT_GE(witness.times[1], Timestamp{} + 10ms);
  EXPECT_GE(witness.times[3] - Timestamp{}, 40ms);
  EXPECT_EQ(replay.record_time(), noon + 40ms);
}

TEST(Replay, RunsAtAnotherSpeed) {
  Loop loop;
  Witness witness;
  const Replay fast{loop, source_of({{noon, "a"}, {noon + 18s, "b"}}), 1000, witness};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_GE(witness.times[1], Timestamp{} + 18ms);

  Witness slow_witness;
  const auto began = loop.now();
  const Replay slow{loop, source_of({{noon, "a"}, {noon + 1ms, "b"}}), 0.1, slow_witness};
  ASSERT_TRUE(wait_for(loop, [&] { return slow_witness.is_down(); }));
  EXPECT_GE(slow_witness.times[1], began + 10ms);
}

TEST(Replay, GoesAsFastAsPossibleAtSpeedZero) {
  Loop loop;
  Witness witness;
  std::vector<Recorded> records;
  for (auto i = 0; i < 1000; ++i) records.push_back({noon + i * 1min, std::to_string(i)});
  const Replay replay{loop, source_of(records), 0, witness};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  ASSERT_THAT(witness.datagrams, SizeIs(1000));
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(witness.datagrams[i].text, std::to_string(i));
}

TEST(Replay, LeavesTheLoopAttentiveAtSpeedZero) {
  Loop loop;
  Witness witness;
  const ReplaySource endless = [] { return ReplayRecord{noon, {}}; };
  const Replay replay{loop, endless, 0, witness};
  auto turns = 0;
  std::function<void()> again = [&] {
    ++turns;
    loop.post(again);
  };
  again();
  EXPECT_TRUE(wait_for(loop, [&] { return turns > 100 && witness.datagrams.size() > 1000; }));
}

TEST(Replay, DoesNotWaitWhereAClockWasSet) {
  Loop loop;
  Witness witness;
  const auto first = wall_time_from_unix_us(std::numeric_limits<std::int64_t>::min());
  const auto last = wall_time_from_unix_us(std::numeric_limits<std::int64_t>::max());
  const Replay replay{
      loop, source_of({{noon, "a"}, {noon - 24h, "b"}, {noon + 2h, "c"}, {first, "d"}, {last, "e"}, {noon, "f"}}), 1,
      witness};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_THAT(witness.texts(), ElementsAre("a", "b", "c", "d", "e", "f"));
}

TEST(Replay, TellsWhenTheRecordWasMade) {
  Loop loop;
  Witness witness;
  const Replay replay{loop, source_of({{noon, "a"}, {noon + 1h, "b"}}), 0, witness};
  EXPECT_EQ(replay.record_time(), WallTime{});
  std::vector<WallTime> times;
  witness.and_then = [&] { times.push_back(replay.record_time()); };
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_THAT(times, ElementsAre(noon, noon + 1h));
}

TEST(Replay, OfNothingEndsAtOnce) {
  Loop loop;
  Witness witness;
  const Replay replay{loop, source_of({}), 1, witness};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::up, LinkState::down));
}

TEST(Replay, MayBeDestroyedByItsHandler) {
  Loop loop;
  Witness witness;
  auto replay = std::make_unique<Replay>(loop, source_of({{noon, "a"}, {noon, "b"}}), 0, witness);
  witness.and_then = [&] { replay.reset(); };
  ASSERT_TRUE(wait_for(loop, [&] { return replay == nullptr; }));
  loop.run_for(5ms);
  EXPECT_THAT(witness.texts(), ElementsAre("a"));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::up));
}

}  // namespace
}  // namespace ponte::transport
