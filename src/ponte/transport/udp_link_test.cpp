#include "ponte/core/bytes.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/test_witness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace ponte::transport {
namespace {

using namespace std::chrono_literals;
using testing::at_port_of;
using testing::Datagram;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::must_open;
using ::testing::SizeIs;
using testing::wait_for;
using testing::Witness;

Bytes text(std::string_view text) { return bytes_of(text); }

/// Somebody who calls a listener.
struct Caller {
  Caller(Loop& loop, const std::string& endpoint) : link{must_open(loop, endpoint, witness)} {}

  Witness witness;
  std::unique_ptr<Link> link;
};

class UdpLinks : public ::testing::Test {
 protected:
  std::unique_ptr<Link> listen(const LinkOptions& options = {}) {
    return must_open(loop, "udpin://127.0.0.1:0", witness, options);
  }

  Loop loop;
  Witness witness;
};

TEST_F(UdpLinks, CarryWholeDatagramsBothWays) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  const std::string large(65'507, 'x');
  caller.link->send(text("hello"));  // before the loop has run
  caller.link->send(text(""));
  caller.link->send(text(large));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.datagrams.size() == 3; }));
  EXPECT_THAT(witness.texts(), ElementsAre("hello", "", large));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::up));
  EXPECT_THAT(witness.joined, SizeIs(1));
  EXPECT_EQ(witness.names[witness.joined[0]], at_port_of("127.0.0.1", *caller.link));
  EXPECT_EQ(listener->peer_name(witness.joined[0]), at_port_of("127.0.0.1", *caller.link));
  EXPECT_EQ(listener->peer_name(PeerId{99}), "");

  listener->send(text("answer"));
  ASSERT_TRUE(wait_for(loop, [&] { return !caller.witness.datagrams.empty(); }));
  EXPECT_THAT(caller.witness.texts(), ElementsAre("answer"));
  EXPECT_THAT(caller.witness.states, ElementsAre(LinkState::up));
  EXPECT_EQ(caller.link->peer_name(caller.witness.joined.at(0)), at_port_of("127.0.0.1", *listener));

  EXPECT_EQ(listener->counters().datagrams_in, 3U);
  EXPECT_EQ(listener->counters().bytes_in, 5 + large.size());
  EXPECT_EQ(listener->counters().messages_out, 1U);
  EXPECT_EQ(listener->counters().bytes_out, 6U);
  EXPECT_EQ(caller.link->counters().messages_out, 3U);
}

TEST_F(UdpLinks, StampWhatTheyReceive) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  const auto sent = loop.now();
  caller.link->send(text("one"));
  caller.link->send(text("two"));
  auto handled = Timestamp::max();
  witness.and_then = [&] { handled = std::min(handled, loop.now()); };
  ASSERT_TRUE(wait_for(loop, [&] { return witness.times.size() == 2; }));
  EXPECT_LE(sent, witness.times[0]);
  EXPECT_LE(witness.times[0], handled);
  EXPECT_LE(handled, witness.times[1]) << "the second was received after the first was handled";
}

TEST_F(UdpLinks, AnswerEveryoneOrOne) {
  const auto listener = listen();
  const auto endpoint = at_port_of("udpout://127.0.0.1", *listener);
  Caller a{loop, endpoint};
  Caller b{loop, endpoint};
  a.link->send(text("from a"));
  b.link->send(text("from b"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.datagrams.size() == 2; }));
  ASSERT_THAT(witness.joined, SizeIs(2));
  EXPECT_NE(witness.joined[0], witness.joined[1]);
  EXPECT_THAT(witness.datagrams,
              ElementsAre(Datagram{witness.joined[0], "from a"}, Datagram{witness.joined[1], "from b"}));

  listener->send(text("to all"));
  listener->send_to(witness.joined[1], text("to b"));
  listener->send_to(PeerId{99}, text("to nobody"));
  ASSERT_TRUE(wait_for(loop, [&] { return a.witness.datagrams.size() + b.witness.datagrams.size() == 3; }));
  EXPECT_THAT(a.witness.texts(), ElementsAre("to all"));
  EXPECT_THAT(b.witness.texts(), ElementsAre("to all", "to b"));
  EXPECT_EQ(listener->counters().dropped_by(DropReason::not_connected), 1U);
}

TEST_F(UdpLinks, CountWhatNobodyIsThereFor) {
  const auto listener = listen();
  listener->send(text("anybody?"));
  EXPECT_EQ(listener->counters().dropped_by(DropReason::not_connected), 1U);
  EXPECT_EQ(listener->counters().messages_out, 0U);
}

TEST_F(UdpLinks, RefuseSendersBeyondTheLimit) {
  const auto listener = listen({.peers = 1});
  const auto endpoint = at_port_of("udpout://127.0.0.1", *listener);
  Caller known{loop, endpoint};
  Caller stranger{loop, endpoint};
  known.link->send(text("1"));
  stranger.link->send(text("2"));
  known.link->send(text("3"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.datagrams.size() == 2; }));
  EXPECT_THAT(witness.texts(), ElementsAre("1", "3"));
  EXPECT_EQ(listener->counters().dropped_by(DropReason::too_many_peers), 1U);
  EXPECT_EQ(listener->counters().datagrams_in, 2U);
}

TEST_F(UdpLinks, ForgetTheSilentAndMakeRoom) {
  const auto listener = listen({.peers = 1, .peer_silence = 1ms});
  const auto endpoint = at_port_of("udpout://127.0.0.1", *listener);
  Caller first{loop, endpoint};
  first.link->send(text("1"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.left.size() == 1; }));
  EXPECT_EQ(witness.left, witness.joined);
  EXPECT_EQ(listener->counters().peers_left, 1U);
  listener->send(text("gone"));
  EXPECT_EQ(listener->counters().dropped_by(DropReason::not_connected), 1U);

  Caller second{loop, endpoint};
  second.link->send(text("2"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.left.size() == 2; }));
  EXPECT_THAT(witness.texts(), ElementsAre("1", "2"));
  EXPECT_NE(witness.joined[0], witness.joined[1]);
}

TEST_F(UdpLinks, HearNobodyButWhomTheyCall) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  Caller stranger{loop, at_port_of("udpout://127.0.0.1", *caller.link)};
  stranger.link->send(text("forged"));
  caller.link->send(text("hello"));
  ASSERT_TRUE(wait_for(loop, [&] { return !witness.datagrams.empty(); }));
  listener->send(text("answer"));
  ASSERT_TRUE(wait_for(loop, [&] { return !caller.witness.datagrams.empty(); }));
  EXPECT_THAT(caller.witness.texts(), ElementsAre("answer"));
}

TEST_F(UdpLinks, SurviveThatNobodyListens) {
  auto listener = listen();
  const auto place = at_port_of("127.0.0.1", *listener);
  listener.reset();
  Caller caller{loop, "udpout://" + place};
  caller.link->send(text("lost"));
  ASSERT_TRUE(wait_for(loop, [&] { return caller.link->counters().dropped_by(DropReason::unreachable) > 0; }));

  listener = must_open(loop, "udpin://" + place, witness);
  caller.link->send(text("found"));
  ASSERT_TRUE(wait_for(loop, [&] { return !witness.datagrams.empty(); }));
  EXPECT_THAT(witness.texts(), ElementsAre("found"));
  EXPECT_THAT(caller.witness.states, ElementsAre(LinkState::up));
}

// The refusal of an earlier datagram comes out of the next send, which has then sent nothing.
TEST_F(UdpLinks, LoseNoDatagramToTheRefusalOfAnother) {
  auto listener = listen();
  const auto place = at_port_of("127.0.0.1", *listener);
  listener.reset();
  Caller caller{loop, "udpout://" + place};
  caller.link->send(text("lost"));
  listener = must_open(loop, "udpin://" + place, witness);
  caller.link->send(text("found"));
  ASSERT_TRUE(wait_for(loop, [&] { return !witness.datagrams.empty(); }));
  EXPECT_THAT(witness.texts(), ElementsAre("found"));
  EXPECT_EQ(caller.link->counters().dropped_by(DropReason::unreachable), 1U);
}

TEST_F(UdpLinks, CountWhatIsTooLarge) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  caller.link->send(text(std::string(65'508, 'x')));
  EXPECT_EQ(caller.link->counters().dropped_by(DropReason::oversize), 1U);
  EXPECT_EQ(caller.link->counters().messages_out, 0U);
}

TEST_F(UdpLinks, AccountForAFlood) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  const std::string message(1000, 'x');
  constexpr auto flood = 20'000U;
  for (auto i = 0U; i < flood; ++i) caller.link->send(text(message));
  auto drained = [&] { return listener->counters().datagrams_in > 0; };
  ASSERT_TRUE(wait_for(loop, drained));
  // The next datagram tells of those that were lost; it comes through once there is room.
  const auto lost = [&] { return listener->counters().dropped_by(DropReason::receive_overflow); };
  ASSERT_TRUE(wait_for(loop, [&] {
    caller.link->send(text("last"));
    return witness.datagrams.back().text == "last" && lost() > 0;
  }));
  // Some of the last ones may be under way still.
  const auto& counters = listener->counters();
  const auto sent = [&] { return caller.link->counters().messages_out; };
  EXPECT_TRUE(wait_for(loop, [&] { return counters.datagrams_in + lost() == sent(); }));
  EXPECT_GT(counters.datagrams_in, 100U);
}

TEST_F(UdpLinks, FindAHostByItsName) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://localhost", *listener)};
  EXPECT_EQ(caller.link->state(), LinkState::connecting);
  caller.link->send(text("too early"));
  EXPECT_EQ(caller.link->counters().dropped_by(DropReason::not_connected), 1U);
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_up(); }));
  caller.link->send(text("hello"));
  ASSERT_TRUE(wait_for(loop, [&] { return !witness.datagrams.empty(); }));
  EXPECT_THAT(witness.texts(), ElementsAre("hello"));
  EXPECT_THAT(caller.witness.states, ElementsAre(LinkState::connecting, LinkState::up));
}

// No name has a label of more than 63 letters, so no name server is asked.
TEST_F(UdpLinks, SayOnceThatAHostIsNotFound) {
  const std::string host(70, 'x');
  const auto link = must_open(loop, "udpout://" + host + ":14550", witness, {.retry_first = 1ms, .retry_longest = 1ms});
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  loop.run_for(20ms);
  EXPECT_THAT(witness.states, ElementsAre(LinkState::connecting, LinkState::down));
  EXPECT_THAT(witness.reasons.back(), HasSubstr("cannot find the host " + host));
  EXPECT_EQ(link->state(), LinkState::down);
}

TEST_F(UdpLinks, AreNotOpenedOnAPortInUse) {
  const auto listener = listen();
  const auto endpoint = at_port_of("udpin://127.0.0.1", *listener);
  const auto second = open_link(loop, *parse_endpoint(endpoint), witness);
  ASSERT_FALSE(second);
  EXPECT_EQ(to_text(second.error()), endpoint + ": Address already in use");
}

TEST_F(UdpLinks, AreNotOpenedOnAnAddressThatIsNotOurs) {
  const auto link = open_link(loop, *parse_endpoint("udpin://203.0.113.1:0"), witness);
  ASSERT_FALSE(link);
  EXPECT_EQ(to_text(link.error()), "udpin://203.0.113.1:0: Cannot assign requested address");
}

TEST_F(UdpLinks, SpeakIpv6AndHearIpv4OnTheSamePort) {
  const auto listener = open_link(loop, *parse_endpoint("udpin://[::]:0"), witness);
  if (!listener) GTEST_SKIP() << "no IPv6 here: " << to_text(listener.error());
  Caller v6{loop, at_port_of("udpout://[::1]", **listener)};
  Caller v4{loop, at_port_of("udpout://127.0.0.1", **listener)};
  v6.link->send(text("six"));
  v4.link->send(text("four"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.datagrams.size() == 2; }));
  EXPECT_THAT(witness.texts(), ElementsAre("six", "four"));
  EXPECT_EQ(witness.names[witness.joined[0]], at_port_of("[::1]", *v6.link));
  EXPECT_EQ(witness.names[witness.joined[1]], at_port_of("127.0.0.1", *v4.link));
  (*listener)->send(text("answer"));
  EXPECT_TRUE(wait_for(loop, [&] { return !v6.witness.datagrams.empty() && !v4.witness.datagrams.empty(); }));
}

TEST_F(UdpLinks, MayBeDestroyedByTheirHandler) {
  auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  caller.link->send(text("one"));
  caller.link->send(text("two"));
  witness.and_then = [&] { listener.reset(); };
  ASSERT_TRUE(wait_for(loop, [&] { return listener == nullptr; }));
  loop.run_for(5ms);
  EXPECT_THAT(witness.texts(), ElementsAre("one"));
}

TEST_F(UdpLinks, LetExceptionsOfTheirHandlerOut) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  caller.link->send(text("one"));
  witness.and_then = [] { throw std::runtime_error{"the handler failed"}; };
  EXPECT_THROW(loop.run(), std::runtime_error);
}

TEST_F(UdpLinks, AreSilentOnceDestroyed) {
  auto listener = listen();
  Caller caller{loop, at_port_of("udpout://127.0.0.1", *listener)};
  caller.link->send(text("unheard"));
  listener.reset();
  loop.run_for(5ms);
  EXPECT_THAT(witness.states, ::testing::IsEmpty());
  EXPECT_THAT(witness.datagrams, ::testing::IsEmpty());
}

TEST_F(UdpLinks, AreNamedAsConfigured) {
  const auto listener = listen();
  EXPECT_EQ(listener->name(), "udpin://127.0.0.1:0");
  EXPECT_NE(listener->local_port(), 0);
}

TEST(OpenLink, RefusesAFile) {
  Loop loop;
  Witness witness;
  const auto link = open_link(loop, FileEndpoint{"/flight.tlog"}, witness);
  ASSERT_FALSE(link);
  EXPECT_EQ(to_text(link.error()), "file:///flight.tlog: a recording can be replayed, not talked with");
}

TEST(Names, AreDifferentForEveryReason) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < drop_reason_count; ++i) {
    const auto name = name_of(static_cast<DropReason>(i));
    EXPECT_FALSE(name.empty());
    EXPECT_THAT(names, ::testing::Not(::testing::Contains(name)));
    names.push_back(name);
  }
  EXPECT_EQ(name_of(LinkState::connecting), "connecting");
  EXPECT_EQ(name_of(LinkState::up), "up");
  EXPECT_EQ(name_of(LinkState::down), "down");
}

}  // namespace
}  // namespace ponte::transport
