#include "ponte/autopilot/setpoint_stream.hpp"

#include "ponte/autopilot/test_commands.hpp"
#include "ponte/mavlink/autopilots/set_position_target_local_ned.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using testing::start;
using Kind = StreamFact::Kind;
using Setpoint = messages::SetPositionTargetLocalNed;

constexpr std::uint32_t copter_guided = 4, copter_rtl = 6, px4_offboard = 0x0006'0000, px4_hold = 0x0304'0000;
constexpr unsigned set_mode = messages::MAV_CMD_DO_SET_MODE;
constexpr Motion northward{.north = MetresPerSecond{3}};

class Bench : public testing::CommandBench {
 public:
  explicit Bench(Stack stack) : CommandBench{stack} {
    heartbeat(start - 1s, 0);
    landed_state(start - 1s, messages::MAV_LANDED_STATE_IN_AIR);
  }

  /// All that is due until then.
  void run_until(Timestamp end) {
    for (auto now = next(); now && *now <= end; now = next()) tick(*now);
    tick(end);
  }
  std::vector<Kind> kinds() {
    std::vector<Kind> result;
    for (const auto& fact : testing::take(facts_)) result.push_back(fact.kind);
    return result;
  }

  SetpointStream stream{peer, modes};

 private:
  [[nodiscard]] std::optional<Timestamp> next() const {
    std::optional<Timestamp> first;
    for (const auto& each : {commands.next_deadline(), modes.next_deadline(), stream.next_deadline()})
      if (each && (!first || *each < *first)) first = each;
    return first;
  }
  void tick(Timestamp now) {
    commands.on_tick(now, station.voice(), answers);
    pass_on(now);
    modes.on_tick(now, mode_facts);
    for (const auto& each : testing::take(mode_facts)) stream.on_mode_fact(now, each, facts_);
    stream.on_tick(now, station.voice(), facts_);
  }

  Outbox<StreamFact> facts_{64};
};

TEST(SetpointStream, AsksACopterForGuidedAndRepeatsTheMotion) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  bench.run_until(start);
  bench.answer(start + 10ms, set_mode);
  bench.heartbeat(start + 20ms, copter_guided);
  bench.run_until(start + 900ms);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::steers));
  const auto sent = bench.station.take<Setpoint>();
  ASSERT_THAT(sent, SizeIs(5));
  EXPECT_EQ(sent[0].vx, 3);
  EXPECT_EQ(sent[0].type_mask, 0x0DC7);
  EXPECT_EQ(sent[0].coordinate_frame, messages::MAV_FRAME_LOCAL_NED);
}

TEST(SetpointStream, HoldsACopterThatNobodySteersAnyMore) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  bench.answer(start + 10ms, set_mode);
  bench.heartbeat(start + 20ms, copter_guided);
  bench.run_until(start + 900ms);
  bench.kinds();
  bench.station.take<Setpoint>();
  bench.run_until(start + 10s);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::held));
  const auto sent = bench.station.take<Setpoint>();
  ASSERT_THAT(sent, SizeIs(10));
  for (const auto& each : sent) EXPECT_EQ(each.vx, 0);
  EXPECT_FALSE(bench.stream.next_deadline());
}

TEST(SetpointStream, GivesPx4SetpointsBeforeItSwitches) {
  Bench bench{Stack::px4};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  bench.run_until(start + 900ms);
  EXPECT_THAT(bench.station.take<messages::CommandLong>(), IsEmpty());
  ASSERT_TRUE(bench.stream.steer(start + 900ms, northward, bench.station.voice()));
  bench.run_until(start + 1s);
  const auto sent = bench.station.take<messages::CommandLong>();
  ASSERT_THAT(sent, SizeIs(1));
  EXPECT_EQ(sent[0].param2, 6) << "OFFBOARD";
}

TEST(SetpointStream, HoldsPx4InItsHoldModeAndStreamsUntilItIsThere) {
  Bench bench{Stack::px4};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  bench.run_until(start + 900ms);
  ASSERT_TRUE(bench.stream.steer(start + 900ms, northward, bench.station.voice()));
  bench.run_until(start + 1s);
  bench.answer(start + 1100ms, set_mode);
  bench.heartbeat(start + 1200ms, px4_offboard);
  bench.run_until(start + 1300ms);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::steers));
  bench.stream.stop(start + 1400ms);
  bench.station.take<Setpoint>();
  bench.run_until(start + 2s);
  EXPECT_THAT(bench.station.take<Setpoint>(), Not(IsEmpty()));
  bench.answer(start + 2100ms, set_mode);
  bench.heartbeat(start + 2200ms, px4_hold);
  bench.run_until(start + 3s);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::held));
  EXPECT_FALSE(bench.stream.next_deadline());
}

TEST(SetpointStream, StopsWhenTheVehicleOrSomebodyElseHasChangedTheMode) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  bench.answer(start + 10ms, set_mode);
  bench.heartbeat(start + 20ms, copter_guided);
  bench.run_until(start + 900ms);
  for (auto at = 900ms; at <= 1800ms; at += 300ms)
    ASSERT_TRUE(bench.stream.steer(start + at, northward, bench.station.voice()));
  bench.heartbeat(start + 1900ms, copter_rtl);
  bench.run_until(start + 2s);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::steers, Kind::mode_left));
  EXPECT_FALSE(bench.stream.next_deadline());
}

TEST(SetpointStream, GivesWayToAWishForAnotherMode) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  ASSERT_TRUE(bench.modes.change_mode(start, vehicle::ModeKind::return_home, bench.station.voice()));
  bench.run_until(start);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::mode_left));
}

TEST(SetpointStream, EndsWhenTheModeIsRefused) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.stream.steer(start, northward, bench.station.voice()));
  bench.answer(start + 10ms, set_mode, messages::MAV_RESULT_FAILED);
  bench.run_until(start + 600ms);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::refused));
}

TEST(SetpointStream, SaysWhyItDoesNotSteer) {
  Bench plane{Stack::ardupilot_plane};
  EXPECT_EQ(plane.stream.steer(start, northward, plane.station.voice()).error(), StreamError::not_supported);
  Bench copter{Stack::ardupilot_copter};
  const Motion endless{.north = MetresPerSecond{std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(copter.stream.steer(start, endless, copter.station.voice()).error(), StreamError::invalid);
  copter.landed_state(start, messages::MAV_LANDED_STATE_ON_GROUND);
  EXPECT_EQ(copter.stream.steer(start, northward, copter.station.voice()).error(), StreamError::on_the_ground);
}

}  // namespace
}  // namespace ponte::autopilot
