#include "ponte/vsm/bridge.hpp"

#include "ponte/autopilot/test_frames.hpp"
#include "ponte/dli/codec.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/dli/messages/subsystem_status_alert.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::vsm {
namespace {

namespace from = mavlink::autopilots;
namespace to = dli::messages;
using namespace std::chrono_literals;
using autopilot::FleetFact;
using autopilot::LinkId;
using autopilot::testing::TestFrame;
using mavlink::ComponentId;
using mavlink::SystemId;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr LinkId radio{1}, cable{2};
constexpr WallTime wall = wall_time_from_unix_us(1'700'000'000'000'000);
constexpr from::Heartbeat copter{.type = from::MAV_TYPE_QUADROTOR, .autopilot = from::MAV_AUTOPILOT_ARDUPILOTMEGA};

/// A bridge with two links up, and what came out of it.
class Bench {
 public:
  explicit Bench(const BridgeConfig& config = {}, BridgeListener* listener = nullptr) : bridge{config, listener} {
    bridge.on_link_up(now, radio);
    bridge.on_link_up(now, cable);
  }

  template <class M>
  void hear(LinkId link, const M& message, SystemId system = SystemId{1}, ComponentId component = ComponentId{1}) {
    const TestFrame frame{message, system, component};
    bridge.on_datagram(now, wall, link, frame.view().whole);
  }
  template <class M>
  std::vector<M> messages() {
    std::vector<M> result;
    bridge.messages.drain([&](const OutgoingMessage& message) {
      dli::DatagramCounters counters;
      const dli::Profile profile;
      const auto view = dli::DatagramReader{message.bytes(), profile, counters}.next();
      if (view && *view && (*view)->number == M::info.number) result.push_back(*dli::decode<M>((*view)->data, profile));
    });
    return result;
  }
  std::vector<FleetFact::Kind> facts() {
    std::vector<FleetFact::Kind> result;
    bridge.facts.drain([&](const FleetFact& fact) { result.push_back(fact.kind); });
    return result;
  }

  Bridge bridge;
  Timestamp now{};
};

TEST(Bridge, FollowsAVehicleFromItsFirstHeartbeatOn) {
  Bench bench;
  bench.hear(radio, from::Attitude{.roll = 0.1F});
  EXPECT_THAT(bench.messages<to::InertialStates>(), IsEmpty());
  bench.hear(radio, copter);
  bench.hear(radio, from::Attitude{.roll = 0.1F});
  EXPECT_THAT(bench.messages<to::InertialStates>(), SizeIs(1));
  EXPECT_THAT(bench.facts(), ElementsAre(FleetFact::Kind::appeared));
  EXPECT_FALSE(bench.bridge.frames.empty()) << "it is asked for its streams";
}

TEST(Bridge, TellsWhatAnotherDialectMakesOfAFrameAndTranslatesOnlyWhatIsOurs) {
  struct Names : BridgeListener {
    void on_decoded(const mavlink::FrameView&, const mavlink::MessageInfo* message) override {
      heard.emplace_back(message == nullptr ? "unknown" : message->name);
    }
    void on_translated(const mavlink::FrameView&, const mavlink::MessageInfo*) override {}
    std::vector<std::string> heard;
  };
  auto lamp = from::Attitude::info;  // the same bytes, another meaning
  lamp.name = "LAMP";
  const std::array messages{&from::Heartbeat::info, static_cast<const mavlink::MessageInfo*>(&lamp)};
  const mavlink::Dialect other{"other", messages};
  Names names;
  Bench bench{{.dialect = &other}, &names};
  bench.hear(radio, copter);
  bench.hear(radio, from::Attitude{.roll = 0.1F});
  EXPECT_THAT(names.heard, ElementsAre("HEARTBEAT", "LAMP"));
  EXPECT_THAT(bench.facts(), ElementsAre(FleetFact::Kind::appeared));
  EXPECT_THAT(bench.messages<to::InertialStates>(), IsEmpty());
}

TEST(Bridge, ReadsAStreamInPieces) {
  Bench bench;
  const TestFrame heartbeat{copter};
  const TestFrame attitude{from::Attitude{.roll = 0.1F}};
  for (const auto* frame : {&heartbeat, &attitude})
    for (const auto byte : frame->view().whole) bench.bridge.on_bytes(bench.now, wall, radio, Bytes{&byte, 1});
  EXPECT_THAT(bench.messages<to::InertialStates>(), SizeIs(1));
}

TEST(Bridge, FindsAFrameBehindAFalseStartWhenTheLineFallsSilent) {
  Bench bench;
  bench.hear(radio, copter);
  const std::array noise{std::byte{0xFE}, std::byte{0xFF}};  // begins a frame of 263 bytes
  bench.bridge.on_bytes(bench.now, wall, radio, noise);
  const TestFrame attitude{from::Attitude{.roll = 0.1F}};
  bench.bridge.on_bytes(bench.now, wall, radio, attitude.view().whole);
  EXPECT_THAT(bench.messages<to::InertialStates>(), IsEmpty());
  EXPECT_LE(bench.bridge.next_deadline(), bench.now + 50ms);
  bench.now += 50ms;
  bench.bridge.on_tick(bench.now, wall);
  EXPECT_THAT(bench.messages<to::InertialStates>(), SizeIs(1));
}

TEST(Bridge, DoesNotMixTwoVehiclesWithOneId) {
  Bench bench;
  bench.hear(radio, copter);
  bench.hear(cable, copter);
  bench.hear(cable, from::Attitude{.roll = 1.0F});
  EXPECT_THAT(bench.facts(), ElementsAre(FleetFact::Kind::appeared, FleetFact::Kind::duplicate_id));
  bench.hear(radio, from::Attitude{.roll = 0.1F});
  std::vector<std::string> alerts;
  std::vector<std::int16_t> rolls;
  bench.bridge.messages.drain([&](const OutgoingMessage& message) {
    dli::DatagramCounters counters;
    const dli::Profile profile;
    const auto view = *dli::DatagramReader{message.bytes(), profile, counters}.next();
    if (view->number == to::SubsystemStatusAlert::info.number)
      alerts.emplace_back(dli::decode<to::SubsystemStatusAlert>(view->data, profile)->text->view());
    if (view->number == to::InertialStates::info.number)
      rolls.push_back(*dli::decode<to::InertialStates>(view->data, profile)->roll);
  });
  EXPECT_THAT(alerts, ElementsAre("two vehicles use one MAVLink id"));
  EXPECT_THAT(rolls, ElementsAre(1043));  // 0.1 rad * 32768 / pi
}

TEST(Bridge, GoesOnWhenALinkComesBack) {
  Bench bench;
  bench.hear(radio, copter);
  bench.bridge.on_link_down(bench.now, wall, radio);
  bench.hear(radio, from::Attitude{.roll = 0.1F});
  EXPECT_THAT(bench.messages<to::InertialStates>(), IsEmpty());
  bench.bridge.on_link_up(bench.now, radio);
  bench.now += 1s;
  bench.hear(radio, copter);
  bench.hear(radio, from::Attitude{.roll = 0.2F});
  EXPECT_THAT(bench.messages<to::InertialStates>(), SizeIs(1));
  EXPECT_THAT(bench.bridge.links(), SizeIs(2));
}

TEST(Bridge, DoesNotListenToWhatItsPolicyRefuses) {
  struct Refused final : BridgeListener {
    void on_decoded(const mavlink::FrameView&, const mavlink::MessageInfo*) override {}
    void on_translated(const mavlink::FrameView&, const mavlink::MessageInfo*) override {}
    void on_refused(LinkId link, mavlink::Refusal refusal, std::uint64_t count) override {
      EXPECT_EQ(link, radio);
      EXPECT_EQ(refusal, mavlink::Refusal::unsigned_frame);
      EXPECT_EQ(count, ++refusals);
    }
    std::uint64_t refusals{};
  } listener;
  const mavlink::SigningKey key{std::array<std::byte, mavlink::SigningKey::size>{}};
  mavlink::Signer ours{key, {}};
  mavlink::Signer peers{key, {}};
  Bridge bridge{{.link_policy = {.unsigned_frames = mavlink::UnsignedPolicy::listed}}, &listener, &ours};
  bridge.on_link_up({}, radio);

  const TestFrame heartbeat{copter};
  const auto whole = heartbeat.view().whole;
  bridge.on_datagram({}, wall, radio, whole);
  bridge.on_datagram({}, wall, radio, whole);
  EXPECT_EQ(listener.refusals, 2U);
  EXPECT_THAT(bridge.fleet().vehicles(), IsEmpty());
  EXPECT_THAT(bridge.links().front()->losses.senders(), IsEmpty());

  std::array<std::byte, mavlink::max_frame_size> signed_frame{};
  std::ranges::copy(whole, signed_frame.begin());
  const auto size = peers.sign(wall, 1, signed_frame, whole.size());
  bridge.on_datagram({}, wall, radio, Bytes{signed_frame}.first(size));
  EXPECT_THAT(bridge.fleet().vehicles(), SizeIs(1));
  EXPECT_EQ(listener.refusals, 2U);
}

// Ended links were kept, and after 256 of them the bridge was deaf to every new one.
TEST(Bridge, StillHearsAVehicleAfterAThousandReconnections) {
  Bench bench;
  for (std::uint16_t number = 10; number < 1010; ++number) {
    bench.bridge.on_link_up(bench.now, LinkId{number});
    bench.bridge.on_link_down(bench.now, wall, LinkId{number});
  }
  bench.bridge.on_link_up(bench.now, LinkId{2000});
  bench.hear(LinkId{2000}, copter);
  bench.hear(LinkId{2000}, from::Attitude{.roll = 0.1F});
  EXPECT_THAT(bench.messages<to::InertialStates>(), SizeIs(1));
  EXPECT_THAT(bench.bridge.links(), SizeIs(3));
}

TEST(Bridge, CountsWhatGetsLostAndWhatIsNoFrame) {
  Bench bench;
  bench.hear(radio, copter);
  bench.bridge.on_datagram(bench.now, wall, radio, std::as_bytes(std::span{"noise"}));
  const auto& link = *bench.bridge.links()[0];
  EXPECT_EQ(link.parser.counters().frames, 1U);
  EXPECT_EQ(link.parser.counters().skipped[0], 6U);
  EXPECT_THAT(link.losses.senders(), SizeIs(1));
}

TEST(Bridge, KeepsInTouchButSaysNothingWhileItDoesNotConvert) {
  Bench bench;
  bench.bridge.convert(false);
  bench.hear(radio, copter);
  bench.hear(radio, from::Attitude{.roll = 0.1F});
  bench.bridge.on_tick(bench.now, wall);
  EXPECT_TRUE(bench.bridge.messages.empty());
  EXPECT_THAT(bench.facts(), ElementsAre(FleetFact::Kind::appeared));
  EXPECT_FALSE(bench.bridge.frames.empty()) << "heartbeats and requests go on";
  bench.bridge.convert(true);
  bench.hear(radio, from::Attitude{.roll = 0.2F});
  EXPECT_THAT(bench.messages<to::InertialStates>(), SizeIs(1));
}

TEST(Bridge, TellsItsListenerOfEachFrameBeforeAndAfter) {
  struct Listener final : BridgeListener {
    void on_decoded(const mavlink::FrameView& frame, const mavlink::MessageInfo*) override {
      steps.push_back({frame.message.value, bridge->messages.size()});
    }
    void on_translated(const mavlink::FrameView& frame, const mavlink::MessageInfo*) override {
      steps.push_back({frame.message.value, bridge->messages.size()});
      bridge->messages.drain([](const OutgoingMessage&) {});
    }
    Bridge* bridge{};
    std::vector<std::pair<std::uint32_t, std::size_t>> steps;  ///< message id, messages in the outbox
  } listener;
  Bridge bridge{{}, &listener};
  listener.bridge = &bridge;
  bridge.on_link_up(Timestamp{}, radio);
  bridge.on_tick(Timestamp{}, wall);
  const TestFrame heartbeat{copter, SystemId{1}, ComponentId{1}};
  bridge.on_datagram(Timestamp{}, wall, radio, heartbeat.view().whole);
  listener.steps.clear();
  const TestFrame attitude{from::Attitude{.roll = 0.1F}, SystemId{1}, ComponentId{1}};
  bridge.on_datagram(Timestamp{}, wall, radio, attitude.view().whole);
  using Step = std::pair<std::uint32_t, std::size_t>;
  EXPECT_THAT(listener.steps, ElementsAre(Step{30, 0}, Step{30, 1}));
  listener.steps.clear();
  bridge.on_datagram(Timestamp{1ms}, wall, radio, attitude.view().whole);
  bridge.messages.drain([](const OutgoingMessage&) {});
  bridge.on_datagram(Timestamp{1s}, wall, radio, heartbeat.view().whole);
  ASSERT_THAT(listener.steps, SizeIs(4));
  EXPECT_GT(listener.steps[2].second, 0U) << "the VSM's heartbeat and what else was due stand there before the frame";
}

TEST(Bridge, IgnoresLinksThatItHasNotBeenToldOf) {
  Bench bench;
  bench.hear(LinkId{9}, copter);
  EXPECT_THAT(bench.facts(), IsEmpty());
}

}  // namespace
}  // namespace ponte::vsm
