#include "ponte/autopilot/fleet_session.hpp"

#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/signer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = FleetFact::Kind;

constexpr LinkId radio{1};
constexpr LinkId cable{2};
constexpr Timestamp start{};

/// A session with links that are up, and everything that came out of it.
class Bench {
 public:
  explicit Bench(FleetConfig config = {}) : session{config} {
    session.on_link_up(start, radio);
    session.on_link_up(start, cable);
    tick(start);
  }

  template <mavlink::Message M>
  bool hear(Timestamp now, const M& message, std::uint8_t system = 1, LinkId link = radio, std::uint8_t component = 1,
            mavlink::Version version = mavlink::Version::v2) {
    std::array<std::byte, mavlink::max_frame_size> buffer{};
    const auto size = mavlink::encode(
        message,
        {.version = version, .system = mavlink::SystemId{system}, .component = mavlink::ComponentId{component}},
        buffer);
    return hear(now, link, Bytes{buffer}.first(*size));
  }
  bool hear(Timestamp now, LinkId link, Bytes frame) {
    const bool followed = session.on_frame(now, link, *mavlink::parse_frame(frame), out, facts);
    collect();
    return followed;
  }
  void tick(Timestamp now) {
    session.on_tick(now, out, facts);
    collect();
  }
  void take_down(LinkId link) {
    session.on_link_down(link, facts);
    collect();
  }
  void clear() {
    sent.clear();
    told.clear();
  }
  template <mavlink::Message M>
  std::vector<M> sent_as() const {
    std::vector<M> result;
    for (const auto& frame : sent) {
      const auto view = *mavlink::parse_frame(frame.bytes());
      if (view.message == M::info.id) result.push_back(mavlink::decode<M>(view));
    }
    return result;
  }
  std::vector<Kind> kinds() const {
    std::vector<Kind> result;
    for (const auto& fact : told) result.push_back(fact.kind);
    return result;
  }

  FleetSession session;
  std::vector<OutgoingFrame> sent;
  std::vector<FleetFact> told;

 private:
  void collect() {
    out.drain([&](const OutgoingFrame& frame) { sent.push_back(frame); });
    facts.drain([&](const FleetFact& fact) { told.push_back(fact); });
  }

  Outbox<OutgoingFrame> out{64};
  Outbox<FleetFact> facts{64};
};

constexpr messages::Heartbeat copter{.type = messages::MAV_TYPE_QUADROTOR,
                                     .autopilot = messages::MAV_AUTOPILOT_ARDUPILOTMEGA};
constexpr messages::Heartbeat px4{.type = messages::MAV_TYPE_QUADROTOR, .autopilot = messages::MAV_AUTOPILOT_PX4};
constexpr messages::Heartbeat station{.type = messages::MAV_TYPE_GCS, .autopilot = messages::MAV_AUTOPILOT_INVALID};

TEST(FleetSession, SaysWhoWeAreOnEveryLinkOnceASecond) {
  Bench bench;
  EXPECT_THAT(bench.sent_as<messages::Heartbeat>(), SizeIs(2));
  bench.clear();
  bench.tick(start + 999ms);
  EXPECT_THAT(bench.sent, IsEmpty());
  bench.tick(start + 1s);
  ASSERT_THAT(bench.sent, SizeIs(2));
  const auto frame = *mavlink::parse_frame(bench.sent[0].bytes());
  EXPECT_NE(frame.system.value, 255) << "255 would stand in for the station whose silence is a failsafe";
  EXPECT_EQ(mavlink::decode<messages::Heartbeat>(frame).type, messages::MAV_TYPE_GCS);
}

TEST(FleetSession, FollowsAutopilotsOnly) {
  Bench bench;
  EXPECT_FALSE(bench.hear(start, messages::Attitude{}));
  EXPECT_FALSE(bench.hear(start, station, 255));
  EXPECT_TRUE(bench.hear(start, copter));
  EXPECT_TRUE(bench.hear(start, messages::Attitude{}));
  EXPECT_FALSE(bench.hear(start, messages::Attitude{}, 1, radio, 154)) << "a gimbal of the same vehicle";
  EXPECT_THAT(bench.told, ElementsAre(FleetFact{Kind::appeared, mavlink::SystemId{1}, mavlink::ComponentId{1}, radio}));
}

TEST(FleetSession, AsksArduPilotForGroupsAndPx4ForWhatIsMissing) {
  Bench bench;
  bench.clear();
  bench.hear(start, copter);
  const auto groups = bench.sent_as<messages::RequestDataStream>();
  EXPECT_THAT(groups, SizeIs(6));
  EXPECT_THAT(groups, Contains(messages::RequestDataStream{.target_system = 1,
                                                           .target_component = 1,
                                                           .req_stream_id = messages::MAV_DATA_STREAM_EXTRA1,
                                                           .req_message_rate = 10,
                                                           .start_stop = 1}));
  EXPECT_THAT(bench.sent_as<messages::CommandLong>(),
              Contains(messages::CommandLong{.target_system = 1,
                                             .target_component = 1,
                                             .command = messages::MAV_CMD_SET_MESSAGE_INTERVAL,
                                             .param1 = 245,
                                             .param2 = 500'000}));
  bench.clear();
  bench.hear(start, px4, 2);
  EXPECT_THAT(bench.sent_as<messages::RequestDataStream>(), IsEmpty()) << "PX4 ignores them";
  EXPECT_THAT(bench.sent_as<messages::CommandLong>(),
              Contains(messages::CommandLong{.target_system = 2,
                                             .target_component = 1,
                                             .command = messages::MAV_CMD_SET_MESSAGE_INTERVAL,
                                             .param1 = 105,
                                             .param2 = 100'000}));
}

TEST(FleetSession, AsksForNothingWhenToldNotTo) {
  Bench bench{{.ask_for_streams = false}};
  bench.clear();
  bench.hear(start, copter);
  EXPECT_THAT(bench.sent, IsEmpty());
}

TEST(FleetSession, AsksAgainWhileNoAttitudeComes) {
  Bench bench;
  bench.hear(start, copter);
  for (auto now = start; now < start + 5s; now += 1s) bench.hear(now, copter);
  bench.clear();
  bench.hear(start + 5s, copter);
  EXPECT_THAT(bench.sent_as<messages::RequestDataStream>(), SizeIs(6));
  bench.clear();
  for (auto now = start + 6s; now < start + 20s; now += 1s) {
    bench.hear(now, copter);
    bench.hear(now, messages::Attitude{});
  }
  EXPECT_THAT(bench.sent_as<messages::RequestDataStream>(), IsEmpty());
}

TEST(FleetSession, AsksAgainAfterAReboot) {
  Bench bench;
  bench.hear(start, copter);
  bench.hear(start + 1s, messages::SystemTime{.time_boot_ms = 60'000});
  bench.clear();
  bench.hear(start + 2s, messages::SystemTime{.time_boot_ms = 800});
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::rebooted));
  EXPECT_THAT(bench.sent_as<messages::RequestDataStream>(), SizeIs(6));
}

TEST(FleetSession, DoesNotTakeDisorderForAReboot) {
  Bench bench;
  bench.hear(start, copter);
  bench.hear(start + 1s, messages::SystemTime{.time_boot_ms = 60'000});
  bench.clear();
  bench.hear(start + 1s, messages::SystemTime{.time_boot_ms = 59'100});
  EXPECT_THAT(bench.told, IsEmpty());
}

TEST(FleetSession, TellsALossAndAReturnAndAsksAgain) {
  Bench bench;
  bench.hear(start, copter);
  bench.clear();
  bench.tick(start + 10s - 1ns);
  EXPECT_THAT(bench.told, IsEmpty());
  bench.tick(start + 10s);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::lost));
  bench.clear();
  EXPECT_TRUE(bench.hear(start + 12s, copter, 1, cable));
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::returned));
  EXPECT_THAT(bench.sent_as<messages::RequestDataStream>(), SizeIs(6));
  EXPECT_EQ(bench.sent.back().link, cable);
}

TEST(FleetSession, LetsAVehicleComeBackAtOnceWhenItsLinkHasEnded) {
  Bench bench;
  bench.hear(start, copter);
  bench.clear();
  bench.take_down(radio);
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::lost));
  EXPECT_TRUE(bench.hear(start + 100ms, copter, 1, cable));
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::lost, Kind::returned));
}

TEST(FleetSession, LeavesOutASecondVehicleWithTheSameIdOnAnotherLink) {
  Bench bench;
  bench.hear(start, copter);
  EXPECT_FALSE(bench.hear(start + 100ms, copter, 1, cable));
  EXPECT_FALSE(bench.hear(start + 200ms, messages::Attitude{}, 1, cable));
  EXPECT_FALSE(bench.hear(start + 300ms, copter, 1, cable));
  EXPECT_TRUE(bench.hear(start + 400ms, messages::Attitude{}, 1, radio));
  EXPECT_THAT(bench.told,
              ElementsAre(FleetFact{Kind::appeared, mavlink::SystemId{1}, mavlink::ComponentId{1}, radio},
                          FleetFact{Kind::duplicate_id, mavlink::SystemId{1}, mavlink::ComponentId{1}, cable}));
}

TEST(FleetSession, NoticesTwoVehiclesThatShareAnIdAndALink) {
  Bench bench;
  bench.hear(start, copter);
  for (std::uint32_t second = 0; second < 10; ++second) {
    bench.hear(start + std::chrono::seconds{second}, messages::SystemTime{.time_boot_ms = 500'000 + second * 1000});
    bench.hear(start + std::chrono::seconds{second}, messages::SystemTime{.time_boot_ms = 20'000 + second * 1000});
  }
  EXPECT_THAT(bench.kinds(), ElementsAre(Kind::appeared, Kind::rebooted, Kind::duplicate_id));
}

TEST(FleetSession, KeepsSeveralVehiclesOnOneLinkApart) {
  Bench bench;
  bench.hear(start, copter, 3);
  bench.hear(start, px4, 1);
  bench.hear(start, copter, 2);
  ASSERT_THAT(bench.session.vehicles(), SizeIs(3));
  EXPECT_EQ(bench.session.vehicles()[0].stack, Stack::px4);
  EXPECT_EQ(bench.session.vehicles()[2].system, mavlink::SystemId{3});
}

TEST(FleetSession, SpeaksTheVersionOfItsPeer) {
  Bench bench;
  bench.clear();
  bench.hear(start, copter, 1, radio, 1, mavlink::Version::v1);
  ASSERT_FALSE(bench.sent.empty());
  EXPECT_EQ(bench.sent.front().buffer[0], mavlink::start_v1);
}

TEST(FleetSession, IsNotTalkedDownToMavlink1ByOneFrameOnceTheLinkIsSigned) {
  Bench bench;
  mavlink::Signer signer{mavlink::SigningKey{std::array<std::byte, mavlink::SigningKey::size>{}}, {}};
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const auto size = signer.sign({}, 1, buffer, mavlink::encode(copter, {}, buffer).value());
  bench.hear(start, radio, Bytes{buffer}.first(size));
  bench.clear();
  bench.hear(start, copter, 1, radio, 1, mavlink::Version::v1);
  ASSERT_FALSE(bench.sent.empty());
  for (const auto& frame : bench.sent) EXPECT_EQ(frame.buffer[0], mavlink::start_v2);
}

TEST(FleetSession, AnswersTimesyncRequestsOnly) {
  Bench bench;
  bench.clear();
  bench.hear(start + 5ms, messages::Timesync{.tc1 = 0, .ts1 = 42});
  EXPECT_THAT(bench.sent_as<messages::Timesync>(),
              ElementsAre(messages::Timesync{.tc1 = 5'000'000, .ts1 = 42, .target_system = 1, .target_component = 1}));
  bench.clear();
  bench.hear(start + 6ms, messages::Timesync{.tc1 = 7, .ts1 = 42});
  EXPECT_THAT(bench.sent, IsEmpty());
}

TEST(FleetSession, WakesUpForTheNextThingToDo) {
  Bench bench;
  EXPECT_EQ(bench.session.next_deadline(), start + 1s);
  bench.take_down(radio);
  bench.take_down(cable);
  bench.hear(start, copter);
  bench.clear();
  bench.tick(start + 10s);
  EXPECT_THAT(bench.sent, IsEmpty()) << "no link is left to send on";
}

}  // namespace
}  // namespace ponte::autopilot
