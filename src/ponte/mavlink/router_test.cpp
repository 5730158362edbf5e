#include "ponte/mavlink/router.hpp"

#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/setup_signing.hpp"
#include "ponte/mavlink/test_signing.hpp"
#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::mavlink {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::array<FieldInfo, 1> ping_fields{{{"target_system", FieldType::uint8, 0, 0, false, "", "", nullptr}}};
constexpr MessageInfo ping{MessageId{4}, "PING", 237, 2, 2, ping_fields};
constexpr MessageInfo command_long{MessageId{76}, "COMMAND_LONG", 152, 33, 33, {}};
constexpr MessageInfo serial_control{MessageId{126}, "SERIAL_CONTROL", 220, 81, 81, {}};
constexpr MessageInfo file_transfer{MessageId{110}, "FILE_TRANSFER_PROTOCOL", 84, 254, 254, {}};

constexpr RouteLinkId a{1};
constexpr RouteLinkId b{2};
constexpr RouteLinkId c{3};

/// A router with some links, frames that are all different, and a clock.
struct Scene {
  explicit Scene(std::initializer_list<RouteLinkId> links) {
    for (const auto link : links) EXPECT_TRUE(router.add_link(link, {}));
  }

  std::vector<RouteLinkId> send(RouteLinkId from, unsigned system, const MessageInfo& message,
                                std::vector<std::byte> payload = {}) {
    payload.resize(message.full_length);
    const FrameHeader header{
        .system = SystemId{static_cast<std::uint8_t>(system)}, .component = ComponentId{1}, .sequence = sequence++};
    const auto size = write_frame(header, message, payload, buffer).value();
    return pass(from, Bytes{buffer}.first(size), &message);
  }
  std::vector<RouteLinkId> pass(RouteLinkId from, Bytes frame, const MessageInfo* message) {
    const auto targets = router.on_frame(now, from, parse_frame(frame).value(), message);
    return {targets.begin(), targets.end()};
  }
  std::vector<RouteLinkId> heartbeat(RouteLinkId from, unsigned system) {
    return send(from, system, testing::Heartbeat::info);
  }
  std::vector<RouteLinkId> ping_to(unsigned target, RouteLinkId from, unsigned system) {
    return send(from, system, ping, {static_cast<std::byte>(target), std::byte{1}});
  }
  std::vector<RouteLinkId> command(unsigned number, RouteLinkId from) {
    std::vector<std::byte> payload(command_long.full_length);
    store_le(&payload[28], static_cast<std::uint16_t>(number));
    return send(from, 255, command_long, payload);
  }
  std::uint64_t dropped(RouteLinkId link, RouteDrop reason) const {
    return router.counters(link)->dropped[static_cast<std::size_t>(reason)];
  }

  Router router{1};
  Timestamp now{};
  std::uint8_t sequence{};
  std::array<std::byte, max_frame_size> buffer{};
};

TEST(Router, SendsWhatIsForAllToAllOthers) {
  Scene scene{a, b, c};
  EXPECT_THAT(scene.heartbeat(a, 1), ElementsAre(b, c));
  EXPECT_THAT(scene.ping_to(0, b, 255), ElementsAre(a, c));
  EXPECT_EQ(scene.router.counters(a)->sent, 1U);
  EXPECT_EQ(scene.router.counters(c)->sent, 2U);
}

TEST(Router, SendsWhatIsForOneWhereItWasHeard) {
  Scene scene{a, b, c};
  scene.heartbeat(a, 1);
  scene.heartbeat(b, 2);
  EXPECT_THAT(scene.ping_to(1, c, 255), ElementsAre(a));
  EXPECT_THAT(scene.ping_to(2, c, 255), ElementsAre(b));
  scene.heartbeat(b, 1);  // the same system on a second link
  EXPECT_THAT(scene.ping_to(1, c, 255), ElementsAre(a, b));
  EXPECT_THAT(scene.router.systems_on(scene.now, b), ElementsAre(SystemId{1}, SystemId{2}));
}

TEST(Router, NeverSendsBackAndCountsWhatHasNoTarget) {
  Scene scene{a, b};
  scene.heartbeat(a, 1);
  EXPECT_THAT(scene.ping_to(1, a, 2), IsEmpty());
  EXPECT_THAT(scene.ping_to(9, b, 255), IsEmpty());
  EXPECT_EQ(scene.dropped(a, RouteDrop::unknown_target), 1U);
  EXPECT_EQ(scene.dropped(b, RouteDrop::unknown_target), 1U);
  Scene alone{a};
  EXPECT_THAT(alone.heartbeat(a, 1), IsEmpty());
  EXPECT_EQ(alone.dropped(a, RouteDrop::no_other_link), 1U);
}

TEST(Router, TakesATargetThatMavlink2LeftOutForEverybody) {
  Scene scene{a, b, c};
  const auto targets = scene.send(a, 1, ping);
  EXPECT_EQ(u8(scene.buffer, 1), 1) << "one byte is left of the payload";
  EXPECT_THAT(targets, ElementsAre(b, c));
  static constexpr std::array<FieldInfo, 1> late{{{"target_system", FieldType::uint8, 0, 1, false, "", "", nullptr}}};
  static constexpr MessageInfo message{MessageId{5}, "LATE", 1, 2, 2, late};
  EXPECT_THAT(scene.send(a, 1, message, {std::byte{7}}), ElementsAre(b, c));
}

TEST(Router, ForgetsASystemThatWasSilentForAMinute) {
  Scene scene{a, b};
  scene.heartbeat(a, 1);
  scene.now += Router::address_lifetime - 1ns;
  EXPECT_THAT(scene.ping_to(1, b, 255), ElementsAre(a));
  scene.now += 1ns;
  EXPECT_THAT(scene.ping_to(1, b, 255), IsEmpty());
}

TEST(Router, PassesOnMessagesThatNobodyKnows) {
  Scene scene{a, b};
  EXPECT_THAT(scene.pass(a, bytes(testing::radio_status_frame), nullptr), ElementsAre(b));
}

TEST(Router, TakesLinksInAndOutWhileItRuns) {
  Scene scene{a, b};
  scene.heartbeat(a, 1);
  scene.router.remove_link(a);
  EXPECT_THAT(scene.ping_to(1, b, 255), IsEmpty());
  EXPECT_TRUE(scene.router.add_link(c, {}));
  EXPECT_THAT(scene.heartbeat(b, 255), ElementsAre(c));
  EXPECT_EQ(scene.router.counters(a), nullptr);
  for (std::uint16_t number = 10; number < 10 + Router::link_limit - 2; ++number)
    EXPECT_TRUE(scene.router.add_link(RouteLinkId{number}, {}));
  EXPECT_FALSE(scene.router.add_link(RouteLinkId{9}, {}));
}

TEST(Router, NeverPassesOnAKey) {
  Scene scene{a, b};
  std::array<std::byte, max_frame_size> frame{};
  const auto size =
      write_setup_signing({SystemId{1}, ComponentId{1}, testing::key(), {}}, SystemId{255}, ComponentId{1}, 0, frame);
  EXPECT_THAT(scene.pass(a, Bytes{frame}.first(size), nullptr), IsEmpty());
  EXPECT_EQ(scene.dropped(a, RouteDrop::setup_signing), 1U);
}

TEST(Router, KeepsRiskyMessagesOffUntrustedLinksBothWays) {
  Scene scene{a, b};
  EXPECT_TRUE(scene.router.add_link(c, {.untrusted = true}));
  for (const auto* message : {&serial_control, &file_transfer}) {
    EXPECT_THAT(scene.send(c, 255, *message), IsEmpty());
    EXPECT_THAT(scene.send(a, 1, *message), ElementsAre(b));
  }
  for (const auto number : {241U, 245U, 246U}) {
    EXPECT_THAT(scene.command(number, c), IsEmpty()) << number;
    EXPECT_THAT(scene.command(number, a), ElementsAre(b)) << number;
  }
  for (const auto number : {240U, 247U, 400U, 0U}) {
    EXPECT_THAT(scene.command(number, c), ElementsAre(a, b)) << number;
    EXPECT_THAT(scene.command(number, a), ElementsAre(b, c)) << number;
  }
  EXPECT_EQ(scene.dropped(c, RouteDrop::untrusted), 10U);
}

TEST(Router, DropsTheSecondCopyOfAFrameThatComesOnTwoLinks) {
  Scene scene{a, b, c};
  const auto frame = bytes(testing::heartbeat_signed_frame);
  EXPECT_THAT(scene.pass(a, frame, &testing::Heartbeat::info), ElementsAre(b, c));
  EXPECT_THAT(scene.pass(b, frame, &testing::Heartbeat::info), IsEmpty());
  EXPECT_EQ(scene.dropped(b, RouteDrop::duplicate), 1U);
  EXPECT_THAT(scene.router.systems_on(scene.now, b), IsEmpty()) << "a detour is no address";
  EXPECT_THAT(scene.pass(a, frame, &testing::Heartbeat::info), ElementsAre(b, c)) << "the sender may repeat itself";
  EXPECT_EQ(scene.router.counters(a)->repeated, 1U);
  scene.now += RecentFrames::window + 1ns;
  EXPECT_THAT(scene.pass(b, frame, &testing::Heartbeat::info), ElementsAre(a, c));
  EXPECT_EQ(scene.router.counters(b)->repeated, 0U);
}

TEST(Router, WhatAnUntrustedLinkWasRefusedIsNoDuplicateElsewhere) {
  Scene scene{a, b};
  EXPECT_TRUE(scene.router.add_link(c, {.untrusted = true}));
  EXPECT_THAT(scene.command(246, c), IsEmpty());
  const Bytes same = Bytes{scene.buffer}.first(parse_frame(scene.buffer)->whole.size());
  EXPECT_THAT(scene.pass(a, same, &command_long), ElementsAre(b));
}

TEST(Router, LimitsWhatOneLinkIsSentOfAMessage) {
  Scene scene{a, b};
  EXPECT_TRUE(scene.router.add_link(c, {.limits = {{testing::Heartbeat::info.id, 100ms}, {ping.id, std::nullopt}}}));
  int passed = 0;
  for (int i = 0; i < 250; ++i, scene.now += 40ms) {  // 25 Hz for 10 s
    const auto targets = scene.heartbeat(a, 1);
    EXPECT_EQ(targets.front(), b);
    if (targets.size() == 2) ++passed;
  }
  EXPECT_EQ(passed, 100);
  EXPECT_EQ(scene.dropped(c, RouteDrop::rate_limit), 150U);
  EXPECT_THAT(scene.heartbeat(a, 2), ElementsAre(b, c)) << "each sender for itself";
  EXPECT_THAT(scene.ping_to(0, a, 1), ElementsAre(b)) << "none at all";
}

}  // namespace
}  // namespace ponte::mavlink
