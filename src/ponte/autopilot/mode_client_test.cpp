#include "ponte/autopilot/mode_client.hpp"

#include "ponte/autopilot/test_commands.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::start;
using vehicle::ModeKind;
using Kind = ModeFact::Kind;

class Bench : public testing::CommandBench {
 public:
  using CommandBench::CommandBench;

  void run_until(Timestamp end) {
    const auto next = [this] {
      const auto one = commands.next_deadline(), other = modes.next_deadline();
      return one && other ? std::min(one, other) : one ? one : other;
    };
    pass_on(end);
    for (auto now = next(); now && *now <= end; now = next()) {
      commands.on_tick(*now, station.voice(), answers);
      pass_on(*now);
      modes.on_tick(*now, mode_facts);
    }
  }
  std::vector<ModeFact> told() { return testing::take(mode_facts); }
  std::vector<messages::CommandLong> sent() { return station.take<messages::CommandLong>(); }
  /// The number of the one command that has been sent, or 0.
  unsigned sent_command() {
    const auto all = sent();
    return all.size() == 1 ? all[0].command : 0U;
  }
};

constexpr unsigned set_mode = messages::MAV_CMD_DO_SET_MODE;
constexpr unsigned arming = messages::MAV_CMD_COMPONENT_ARM_DISARM;
constexpr unsigned take_off = messages::MAV_CMD_NAV_TAKEOFF;
constexpr unsigned mission_start = messages::MAV_CMD_MISSION_START;
constexpr std::uint32_t copter_auto = 3, copter_guided = 4, copter_rtl = 6;
constexpr std::uint32_t px4_hold = 0x0304'0000, px4_mission = 0x0404'0000, px4_take_off = 0x0204'0000;

TEST(ModeClient, IsDoneWithAModeWhenItIsAcceptedAndSeen) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_rtl, true);
  const auto id = bench.modes.change_mode(start, ModeKind::return_home, bench.station.voice());
  const auto sent = bench.sent();
  ASSERT_THAT(sent, SizeIs(1));
  EXPECT_EQ(sent[0].param1, 1);
  EXPECT_EQ(sent[0].param2, 6);
  bench.answer(start + 100ms, set_mode);
  EXPECT_THAT(bench.told(), IsEmpty()) << "the HEARTBEAT before the wish says nothing of it";
  bench.heartbeat(start + 1s, copter_rtl, true);
  EXPECT_THAT(bench.told(), ElementsAre(ModeFact{.kind = Kind::done, .request = id.value()}));
}

TEST(ModeClient, TellsPx4MainAndSubMode) {
  Bench bench{Stack::px4};
  bench.heartbeat(start, px4_hold, true);
  ASSERT_TRUE(bench.modes.change_mode(start, "AUTO.RTL", bench.station.voice()));
  const auto sent = bench.sent();
  ASSERT_THAT(sent, SizeIs(1));
  EXPECT_EQ(sent[0].param2, 4);
  EXPECT_EQ(sent[0].param3, 5);
}

TEST(ModeClient, SaysThatNothingCameOfAModeThatWasAccepted) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_guided, true);
  ASSERT_TRUE(bench.modes.change_mode(start, ModeKind::mission, bench.station.voice()));
  bench.answer(start + 100ms, set_mode);
  for (auto at = 1s; at < 10s; at += 1s) bench.heartbeat(start + at, copter_guided, true);
  bench.run_until(start + 1h);
  const auto told = bench.told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::no_effect);
}

TEST(ModeClient, BelievesWhatItSeesWhenTheAnswersGetLost) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_guided, false);
  ASSERT_TRUE(bench.modes.arm(start, bench.station.voice()));
  bench.run_until(start + 4s);
  bench.heartbeat(start + 4500ms, copter_guided, true);
  bench.run_until(start + 1h);
  const auto told = bench.told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::done);
}

TEST(ModeClient, BelievesWhatItSeesWhenTheSecondCopyIsRefused) {
  Bench bench{Stack::px4};
  bench.hear(start, messages::HomePosition{.altitude = 500'000});
  bench.heartbeat(start, px4_hold, false);
  ASSERT_TRUE(bench.modes.take_off(start, Metres{20}, bench.station.voice()));
  bench.answer(start + 10ms, set_mode);
  bench.answer(start + 20ms, arming);
  bench.run_until(start + 1100ms);  // the answer to the first NAV_TAKEOFF is lost
  bench.answer(start + 1200ms, take_off, messages::MAV_RESULT_TEMPORARILY_REJECTED);
  bench.heartbeat(start + 2s, px4_take_off, true);
  bench.run_until(start + 2500ms);
  bench.landed_state(start + 2600ms, messages::MAV_LANDED_STATE_IN_AIR);
  const auto told = bench.told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::done);
}

TEST(ModeClient, TellsWhyAndAtWhichStepItWasRefused) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_guided, false);
  ASSERT_TRUE(bench.modes.start_mission(start, bench.station.voice()));
  bench.answer(start, set_mode);
  bench.hear(start + 10ms,
             messages::Statustext{.severity = 2, .text = std::string_view{"Arm: Need Position Estimate"}});
  bench.answer(start + 20ms, arming, messages::MAV_RESULT_FAILED);
  bench.run_until(start + 1s);
  const auto told = bench.told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::refused);
  EXPECT_EQ(told[0].wish, ModeWish::start_mission);
  EXPECT_EQ(told[0].step, ModeStep::arm);
  EXPECT_EQ(told[0].result, messages::MAV_RESULT_FAILED);
  EXPECT_EQ(told[0].reason.view(), "Arm: Need Position Estimate");
}

TEST(ModeClient, BeginsAMissionOfACopterByGuidedArmingAndMissionStart) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_auto, false);
  ASSERT_TRUE(bench.modes.start_mission(start, bench.station.voice()));
  EXPECT_EQ(bench.sent().at(0).param2, copter_guided) << "it cannot be armed in AUTO";
  bench.answer(start + 10ms, set_mode);
  EXPECT_EQ(bench.sent_command(), arming);
  bench.answer(start + 20ms, arming);
  const auto last = bench.sent();
  ASSERT_THAT(last, SizeIs(1));
  EXPECT_EQ(last[0], (messages::CommandLong{.target_system = 1, .target_component = 1, .command = mission_start}))
      << "any parameter but 0 is DENIED";
  bench.answer(start + 30ms, mission_start);
  bench.heartbeat(start + 1s, copter_auto, true);
  EXPECT_THAT(bench.told(), IsEmpty()) << "it is still on the ground";
  bench.landed_state(start + 3s, messages::MAV_LANDED_STATE_IN_AIR);
  EXPECT_THAT(bench.told(), SizeIs(1));
}

TEST(ModeClient, BeginsAMissionOfAPlaneAndOfPx4ByArmingInItsMode) {
  for (const auto stack : {Stack::ardupilot_plane, Stack::px4}) {
    const std::uint32_t mission = stack == Stack::px4 ? px4_mission : 10;
    Bench bench{stack};
    bench.heartbeat(start, 0, false);
    ASSERT_TRUE(bench.modes.start_mission(start, bench.station.voice()));
    EXPECT_EQ(bench.sent_command(), set_mode);
    bench.answer(start + 10ms, set_mode);
    EXPECT_EQ(bench.sent_command(), arming);
    bench.answer(start + 20ms, arming);
    bench.heartbeat(start + 1s, mission, true);
    EXPECT_TRUE(bench.station.is_silent()) << "MISSION_START would begin PX4's mission anew";
    bench.landed_state(start + 2s, messages::MAV_LANDED_STATE_IN_AIR);
    const auto told = bench.told();
    ASSERT_THAT(told, SizeIs(1));
    EXPECT_EQ(told[0].kind, Kind::done);
  }
}

TEST(ModeClient, BeginsAMissionInTheAirByTheModeAlone) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_guided, true);
  bench.landed_state(start, messages::MAV_LANDED_STATE_IN_AIR);
  ASSERT_TRUE(bench.modes.start_mission(start + 1s, bench.station.voice()));
  bench.answer(start + 1500ms, set_mode);
  bench.heartbeat(start + 3s, copter_auto, true);
  EXPECT_THAT(bench.told(), SizeIs(1));
  EXPECT_THAT(bench.sent(), SizeIs(1));
}

TEST(ModeClient, TellsACopterAHeightAboveHomeAndPx4AnAltitude) {
  for (const auto stack : {Stack::ardupilot_copter, Stack::px4}) {
    Bench bench{stack};
    bench.hear(start, messages::HomePosition{.altitude = 500'000});
    bench.heartbeat(start, 0, false);
    ASSERT_TRUE(bench.modes.take_off(start, Metres{20}, bench.station.voice()));
    bench.answer(start + 10ms, set_mode);
    bench.answer(start + 20ms, arming);
    const auto sent = bench.sent();
    ASSERT_THAT(sent, SizeIs(3));
    EXPECT_EQ(sent[2].command, take_off);
    EXPECT_EQ(sent[2].param7, stack == Stack::px4 ? 520 : 20);
    EXPECT_EQ(std::isnan(sent[2].param5), stack == Stack::px4);
  }
}

TEST(ModeClient, SeesATakeOffByTheHeightWithoutALandedState) {
  Bench bench{Stack::ardupilot_plane};
  bench.heartbeat(start, 0, false);
  bench.hear(start, messages::GlobalPositionInt{.lat = 1, .lon = 1, .relative_alt = 300});
  ASSERT_TRUE(bench.modes.take_off(start, {}, bench.station.voice()));
  bench.answer(start + 10ms, set_mode);
  bench.answer(start + 20ms, arming);
  bench.heartbeat(start + 1s, 13, true);
  bench.hear(start + 2s, messages::GlobalPositionInt{.lat = 1, .lon = 1, .relative_alt = 1200});
  EXPECT_THAT(bench.told(), IsEmpty());
  bench.hear(start + 3s, messages::GlobalPositionInt{.lat = 1, .lon = 1, .relative_alt = 1400});
  EXPECT_THAT(bench.told(), SizeIs(1));
}

TEST(ModeClient, LetsANewWishTakeThePlaceOfTheOld) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_guided, true);
  const auto first = bench.modes.arm(start, bench.station.voice());
  const auto second = bench.modes.change_mode(start + 100ms, ModeKind::return_home, bench.station.voice());
  const auto sent = bench.sent();
  ASSERT_THAT(sent, SizeIs(2)) << "it does not wait";
  EXPECT_EQ(sent[1].command, set_mode);
  bench.answer(start + 200ms, arming);
  bench.answer(start + 200ms, set_mode);
  bench.heartbeat(start + 300ms, copter_rtl, true);
  const auto told = bench.told();
  ASSERT_THAT(told, SizeIs(2));
  EXPECT_EQ(
      told[0],
      (ModeFact{.kind = Kind::superseded, .request = first.value(), .wish = ModeWish::arm, .step = ModeStep::arm}));
  EXPECT_EQ(told[1].request, second.value());
  EXPECT_EQ(told[1].kind, Kind::done);
  bench.run_until(start + 1h);
  EXPECT_TRUE(bench.station.is_silent()) << "no more copies of the first";
}

TEST(ModeClient, EndsTheWishWhenTheVehicleStartsAnew) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_guided, false);
  ASSERT_TRUE(bench.modes.arm(start, bench.station.voice()));
  Outbox<ModeFact> facts{4};
  bench.modes.on_reboot(start, facts);
  const auto told = testing::take(facts);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::rebooted);
  bench.sent();
  bench.run_until(start + 1h);
  EXPECT_TRUE(bench.station.is_silent());
  EXPECT_EQ(bench.modes.arm(start, bench.station.voice()), fail(ModeError::not_heard));
}

TEST(ModeClient, SaysWhyItDoesNotEvenBegin) {
  Bench copter{Stack::ardupilot_copter};
  auto& voice = copter.station.voice();
  EXPECT_EQ(copter.modes.arm(start, voice), fail(ModeError::not_heard));
  copter.heartbeat(start, copter_guided, true);
  EXPECT_EQ(copter.modes.change_mode(start, ModeKind::take_off, voice), fail(ModeError::no_such_mode));
  EXPECT_EQ(copter.modes.change_mode(start, "AUTO.RTL", voice), fail(ModeError::no_such_mode));
  EXPECT_EQ(copter.modes.take_off(start, {}, voice), fail(ModeError::needs_height));
  EXPECT_EQ(copter.modes.take_off(start, Metres{-1}, voice), fail(ModeError::height_invalid));
  EXPECT_EQ(copter.modes.arm(start + 11s, voice), fail(ModeError::not_heard)) << "that was long ago";
  copter.landed_state(start, messages::MAV_LANDED_STATE_IN_AIR);
  EXPECT_EQ(copter.modes.take_off(start, Metres{20}, voice), fail(ModeError::in_the_air));

  Bench plane{Stack::ardupilot_plane};
  EXPECT_EQ(plane.modes.take_off(start, Metres{20}, voice), fail(ModeError::has_own_height));
  Bench px4{Stack::px4};
  EXPECT_EQ(px4.modes.take_off(start, Metres{20}, voice), fail(ModeError::home_unknown));
  Bench unknown{Stack::unknown};
  EXPECT_EQ(unknown.modes.start_mission(start, voice), fail(ModeError::unknown_stack));
  Bench old{Stack::ardupilot_copter, mavlink::Version::v0_9};
  old.heartbeat(start, copter_guided, false);
  EXPECT_EQ(old.modes.arm(start, old.station.voice()), fail(ModeError::not_sent));
}

}  // namespace
}  // namespace ponte::autopilot
