#include "ponte/autopilot/guided_flight.hpp"

#include "ponte/autopilot/test_commands.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::start;
using Kind = GuidedFact::Kind;

constexpr std::uint32_t copter_guided = 4, copter_loiter = 5, px4_hold = 0x0304'0000, px4_orbit = 0x0103'0000;
constexpr unsigned repositioned = messages::MAV_CMD_DO_REPOSITION;
constexpr Target place{radians_from_degrees(-30.069), radians_from_degrees(-51.122), {Metres{40}}};

class Bench : public testing::CommandBench {
 public:
  using CommandBench::CommandBench;

  /// What has been told, after all that is due until then.
  std::vector<GuidedFact> told(Timestamp now) {
    commands.on_tick(now, station.voice(), answers);
    for (const auto& each : testing::take(answers)) guided.on_answer(now, each, facts_);
    guided.on_tick(now, facts_);
    return testing::take(facts_);
  }
  messages::CommandInt sent_int() {
    const auto sent = station.take<messages::CommandInt>();
    return sent.size() == 1 ? sent[0] : messages::CommandInt{};
  }
  messages::CommandLong sent_long() {
    const auto sent = station.take<messages::CommandLong>();
    return sent.size() == 1 ? sent[0] : messages::CommandLong{};
  }

  GuidedFlight guided{commands, modes};

 private:
  Outbox<GuidedFact> facts_{64};
};

TEST(GuidedFlight, GoesToAPlaceAndIsDoneWhenTheModeIsSeen) {
  Bench bench{Stack::ardupilot_copter};
  bench.heartbeat(start, copter_loiter);
  const auto id = bench.guided.go_to(start, place, MetresPerSecond{7}, bench.station.voice());
  const auto sent = bench.sent_int();
  EXPECT_EQ(sent.command, repositioned);
  EXPECT_EQ(sent.frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT);
  EXPECT_EQ(sent.x, -300'690'000);
  EXPECT_EQ(sent.z, 40);
  EXPECT_EQ(sent.param1, 7);
  EXPECT_EQ(sent.param2, 1) << "it changes the mode by itself";
  EXPECT_TRUE(std::isnan(sent.param4));
  bench.answer(start + 10ms, repositioned);
  EXPECT_THAT(bench.told(start + 10ms), IsEmpty());
  bench.heartbeat(start + 1s, copter_guided);
  EXPECT_THAT(bench.told(start + 1s), ElementsAre(GuidedFact{.kind = Kind::done, .request = id.value()}));
}

TEST(GuidedFlight, SaysThatTheVehicleStaysInItsMode) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.guided.go_to(start, place, {}, bench.station.voice()));
  bench.answer(start, repositioned);
  bench.told(start);
  EXPECT_EQ(bench.guided.next_deadline(), start + 10s);
  bench.heartbeat(start + 9s, copter_loiter);
  const auto told = bench.told(start + 10s);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::no_effect);
}

TEST(GuidedFlight, TakesTheNewestWishOfWhereToFly) {
  Bench bench{Stack::ardupilot_copter};
  const auto first = bench.guided.go_to(start, place, {}, bench.station.voice());
  const auto speed = bench.guided.change_speed(start, MetresPerSecond{5}, bench.station.voice());
  const auto second = bench.guided.go_to(start + 1ms, place, {}, bench.station.voice());
  ASSERT_TRUE(speed && second);
  EXPECT_THAT(bench.told(start + 1ms), ElementsAre(GuidedFact{.kind = Kind::superseded, .request = first.value()}));
  bench.answer(start + 2ms, messages::MAV_CMD_DO_CHANGE_SPEED);
  EXPECT_THAT(bench.told(start + 2ms),
              ElementsAre(GuidedFact{.kind = Kind::done, .request = *speed, .wish = GuidedWish::change_speed}));
}

TEST(GuidedFlight, ChangesTheAltitudeOverWhereItWasSentOrIs) {
  Bench bench{Stack::ardupilot_copter};
  EXPECT_EQ(bench.guided.change_altitude(start, {Metres{60}}, bench.station.voice()),
            fail(GuidedError::position_unknown));
  bench.hear(start, messages::GlobalPositionInt{.lat = -300'000'000, .lon = -510'000'000});
  ASSERT_TRUE(bench.guided.change_altitude(start, {Metres{60}}, bench.station.voice()));
  EXPECT_EQ(bench.sent_int().x, -300'000'000);
  bench.answer(start + 1ms, repositioned);
  ASSERT_TRUE(bench.guided.go_to(start + 1s, place, {}, bench.station.voice()));
  bench.answer(start + 1s, repositioned);
  bench.heartbeat(start + 2s, copter_guided);
  bench.station.take<messages::CommandInt>();
  ASSERT_TRUE(bench.guided.change_altitude(start + 3s, {Metres{60}, Height::Above::sea}, bench.station.voice()));
  const auto sent = bench.sent_int();
  EXPECT_EQ(sent.x, -300'690'000);
  EXPECT_EQ(sent.frame, messages::MAV_FRAME_GLOBAL);
  EXPECT_EQ(sent.z, 60);
}

TEST(GuidedFlight, LeavesOpenToPx4WhatStaysAsItIs) {
  Bench bench{Stack::px4};
  EXPECT_EQ(bench.guided.change_altitude(start, {Metres{60}}, bench.station.voice()), fail(GuidedError::home_unknown));
  bench.hear(start, messages::HomePosition{.altitude = 500'000});
  ASSERT_TRUE(bench.guided.change_altitude(start, {Metres{60}}, bench.station.voice()));
  const auto climb = bench.sent_long();
  EXPECT_EQ(climb.param7, 560);
  EXPECT_TRUE(std::isnan(climb.param5) && std::isnan(climb.param6) && std::isnan(climb.param4));
  bench.answer(start + 1ms, repositioned);
  ASSERT_TRUE(bench.guided.turn_to(start + 2ms, Radians{1.5}, bench.station.voice()));
  const auto turn = bench.sent_long();
  EXPECT_FLOAT_EQ(turn.param4, 1.5);
  EXPECT_TRUE(std::isnan(turn.param7));
  bench.answer(start + 3ms, repositioned);
  bench.heartbeat(start + 1s, px4_hold);
  EXPECT_THAT(bench.told(start + 1s), SizeIs(2));
}

TEST(GuidedFlight, TurnsACopterFromNorthByTheShorterWay) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.guided.turn_to(start, radians_from_degrees(-90), bench.station.voice()));
  const auto sent = bench.sent_long();
  EXPECT_EQ(sent.command, messages::MAV_CMD_CONDITION_YAW);
  EXPECT_FLOAT_EQ(sent.param1, 270);
  EXPECT_EQ(sent.param4, 0) << "not by a difference";
}

TEST(GuidedFlight, FliesRoundAPlaceInPx4AndInAPlane) {
  Bench px4{Stack::px4};
  EXPECT_EQ(px4.guided.orbit(start, place, Metres{30}, {}, px4.station.voice()), fail(GuidedError::home_unknown));
  px4.hear(start, messages::HomePosition{.altitude = 500'000});
  ASSERT_TRUE(px4.guided.orbit(start, place, Metres{-30}, MetresPerSecond{4}, px4.station.voice()));
  const auto orbit = px4.sent_int();
  EXPECT_EQ(orbit.command, messages::MAV_CMD_DO_ORBIT);
  EXPECT_EQ(orbit.param1, -30);
  EXPECT_EQ(orbit.frame, messages::MAV_FRAME_GLOBAL) << "PX4 means altitudes above mean sea level";
  EXPECT_EQ(orbit.z, 540);
  px4.answer(start, messages::MAV_CMD_DO_ORBIT);
  px4.heartbeat(start + 1s, px4_orbit);
  EXPECT_THAT(px4.told(start + 1s), SizeIs(1));

  Bench plane{Stack::ardupilot_plane};
  ASSERT_TRUE(plane.guided.orbit(start, place, Metres{-80}, {}, plane.station.voice()));
  const auto loiter = plane.sent_int();
  EXPECT_EQ(loiter.command, repositioned);
  EXPECT_EQ(loiter.param3, 80);
  EXPECT_EQ(loiter.param4, 1) << "anticlockwise";
}

TEST(GuidedFlight, TellsARefusalWithItsReason) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.guided.change_speed(start, MetresPerSecond{5}, bench.station.voice()));
  bench.hear(start, messages::Statustext{.severity = 4, .text = std::string_view{"not armed"}});
  bench.answer(start, messages::MAV_CMD_DO_CHANGE_SPEED, messages::MAV_RESULT_FAILED);
  const auto told = bench.told(start + 500ms);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::refused);
  EXPECT_EQ(told[0].reason.view(), "not armed");
}

TEST(GuidedFlight, SaysWhyItDoesNotEvenAsk) {
  Bench copter{Stack::ardupilot_copter};
  auto& voice = copter.station.voice();
  EXPECT_EQ(copter.guided.orbit(start, place, Metres{30}, {}, voice), fail(GuidedError::not_supported));
  EXPECT_EQ(copter.guided.go_to(start, {Radians{2}, {}, {}}, {}, voice), fail(GuidedError::invalid));
  EXPECT_EQ(copter.guided.go_to(start, place, MetresPerSecond{0}, voice), fail(GuidedError::invalid));
  EXPECT_EQ(copter.guided.turn_to(start, Radians{std::numeric_limits<double>::infinity()}, voice),
            fail(GuidedError::invalid));
  Bench plane{Stack::ardupilot_plane};
  EXPECT_EQ(plane.guided.turn_to(start, Radians{}, voice), fail(GuidedError::not_supported));
  Bench unknown{Stack::unknown};
  EXPECT_EQ(unknown.guided.go_to(start, place, {}, voice), fail(GuidedError::not_supported));
}

TEST(GuidedFlight, EndsEverythingWhenTheVehicleStartsAnew) {
  Bench bench{Stack::ardupilot_copter};
  ASSERT_TRUE(bench.guided.go_to(start, place, {}, bench.station.voice()));
  Outbox<GuidedFact> facts{4};
  bench.guided.on_reboot(start, facts);
  const auto told = testing::take(facts);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].kind, Kind::rebooted);
  EXPECT_FALSE(bench.guided.next_deadline());
}

}  // namespace
}  // namespace ponte::autopilot
