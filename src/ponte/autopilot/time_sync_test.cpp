#include "ponte/autopilot/time_sync.hpp"

#include "ponte/autopilot/test_station.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using testing::start;

/// A vehicle that started at `boot`, of our time.
class Bench {
 public:
  /// One exchange: the question takes `out` to arrive, the answer `back`.
  void exchange(Timestamp now, Duration out, Duration back) {
    sync.on_tick(now, station.voice());
    const auto questions = station.take<messages::Timesync>();
    ASSERT_EQ(questions.size(), 1U);
    hear(now + out + back, {.tc1 = (now + out - boot).count(), .ts1 = questions[0].ts1});
  }
  void hear(Timestamp now, const messages::Timesync& message, std::uint8_t system = 1) {
    const testing::TestFrame frame{message, mavlink::SystemId{system}};
    sync.on_message(now, frame.view());
  }

  Timestamp boot{start - 100s};
  testing::Station station;
  TimeSync sync{{testing::vehicle_system, testing::autopilot_component, Stack::px4}};
};

TEST(TimeSync, KnowsTheVehiclesClockByTheFastestExchange) {
  Bench bench;
  EXPECT_FALSE(bench.sync.best());
  bench.exchange(start, 300ms, 20ms);
  bench.exchange(start + 1s, 10ms, 10ms);
  bench.exchange(start + 2s, 10ms, 200ms);
  const auto best = bench.sync.best();
  ASSERT_TRUE(best);
  EXPECT_EQ(best->round_trip, 20ms);
  EXPECT_EQ(bench.sync.vehicle_time(start + 5s), 105s);
}

TEST(TimeSync, IsWrongByHalfARoundTripAtTheMost) {
  Bench bench;
  bench.exchange(start, 90ms, 10ms);
  const auto error = *bench.sync.vehicle_time(start + 1s) - 101s;
  EXPECT_LE(std::chrono::abs(error), 50ms);
  EXPECT_EQ(bench.sync.round_trip(), 100ms);
}

TEST(TimeSync, SmoothsTheRoundTrip) {
  Bench bench;
  bench.exchange(start, 40ms, 40ms);
  bench.exchange(start + 1s, 80ms, 80ms);
  EXPECT_EQ(bench.sync.round_trip(), 90ms);
}

TEST(TimeSync, MeasuresAfreshWhenTheClockCannotBeWhatItWas) {
  Bench bench;
  bench.exchange(start, 5ms, 5ms);
  bench.boot = start + 1s;
  bench.exchange(start + 2s, 50ms, 50ms);
  EXPECT_EQ(bench.sync.vehicle_time(start + 2s), 1s);
}

TEST(TimeSync, ForgetsReadingsThatAreTooOld) {
  Bench bench;
  bench.exchange(start, 1ms, 1ms);
  for (int i = 1; i <= int{TimeSync::window}; ++i) bench.exchange(start + i * 2s, 10ms, 10ms);
  EXPECT_EQ(bench.sync.best()->round_trip, 20ms);
}

TEST(TimeSync, PassesOverQuestionsAnswersToOthersAndNonsense) {
  Bench bench;
  bench.sync.on_tick(start, bench.station.voice());
  const auto asked = start.time_since_epoch().count();
  bench.hear(start + 10ms, {.tc1 = 0, .ts1 = asked});
  bench.hear(start + 10ms, {.tc1 = 5, .ts1 = asked + 1});
  bench.hear(start + 10ms, {.tc1 = -5, .ts1 = asked});
  bench.hear(start + 10ms, {.tc1 = std::numeric_limits<std::int64_t>::max(), .ts1 = asked});
  bench.hear(start + 10ms, {.tc1 = 5, .ts1 = asked}, 2);
  bench.hear(start + 10min, {.tc1 = 5, .ts1 = asked});
  bench.hear(start + 10ms, {.tc1 = 5, .ts1 = 0});
  EXPECT_FALSE(bench.sync.best());
}

TEST(TimeSync, AsksOftenAtFirstAndSeldomLater) {
  Bench bench;
  for (int i = 0; i < 5; ++i)
    bench.exchange(bench.sync.next_deadline() + (i == 0 ? start - Timestamp{} : 0ns), 1ms, 1ms);
  const auto then = bench.sync.next_deadline();
  bench.exchange(then, 1ms, 1ms);
  EXPECT_EQ(bench.sync.next_deadline(), then + TimeSync::interval);
  EXPECT_EQ(bench.sync.asked(), 6U);
  EXPECT_EQ(bench.sync.answered(), 6U);
}

}  // namespace
}  // namespace ponte::autopilot
