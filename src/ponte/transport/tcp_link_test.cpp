#include "ponte/core/bytes.hpp"
#include "ponte/transport/file_descriptor.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/test_witness.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace ponte::transport {
namespace {

using namespace std::chrono_literals;
using testing::at_port_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::must_open;
using ::testing::SizeIs;
using testing::wait_for;
using testing::Witness;

Bytes text(std::string_view text) { return bytes_of(text); }

constexpr LinkOptions impatient{.retry_first = 1ms, .retry_longest = 1ms};

/// Somebody who connects to a listener and reconnects quickly.
struct Caller {
  Caller(Loop& loop, const std::string& endpoint) : link{must_open(loop, endpoint, witness, impatient)} {}

  [[nodiscard]] std::string heard() const { return witness.streams.empty() ? "" : witness.streams.rbegin()->second; }

  Witness witness;
  std::unique_ptr<Link> link;
};

/// A connection without a link of ours, which does as badly as a test wants.
class RawCaller {
 public:
  explicit RawCaller(const Link& listener) : socket_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
    const int little = 4096;
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &little, sizeof little);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(listener.local_port());
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  }

  /// What has arrived.
  std::string read() {
    std::array<char, 4096> buffer{};
    const auto size = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
    return size > 0 ? std::string{buffer.data(), static_cast<std::size_t>(size)} : std::string{};
  }

  /// Goes without a goodbye: the other side sees a reset.
  void die() {
    const linger at_once{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    socket_ = FileDescriptor{};
  }

 private:
  FileDescriptor socket_;
};

class TcpLinks : public ::testing::Test {
 protected:
  std::unique_ptr<Link> listen(const LinkOptions& options = {}) {
    return must_open(loop, "tcpin://127.0.0.1:0", witness, options);
  }

  Loop loop;
  Witness witness;
};

TEST_F(TcpLinks, CarryBytesBothWays) {
  const auto listener = listen();
  Caller caller{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  EXPECT_EQ(caller.link->state(), LinkState::connecting);
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_up() && !witness.joined.empty(); }));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::up));
  EXPECT_THAT(witness.reasons, ElementsAre(at_port_of("listening on 127.0.0.1", *listener)));
  EXPECT_EQ(witness.names[witness.joined[0]].rfind("127.0.0.1:", 0), 0U);
  EXPECT_EQ(listener->peer_name(witness.joined[0]), witness.names[witness.joined[0]]);
  EXPECT_EQ(caller.link->peer_name(caller.witness.joined.at(0)), at_port_of("127.0.0.1", *listener));

  caller.link->send(text("one "));
  caller.link->send(text("two"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.streams[witness.joined[0]] == "one two"; }));
  listener->send(text("answer"));
  listener->send_to(witness.joined[0], text(" to one"));
  listener->send_to(PeerId{99}, text("to nobody"));
  ASSERT_TRUE(wait_for(loop, [&] { return caller.heard() == "answer to one"; }));
  caller.link->send_to(caller.witness.joined[0], text("!"));
  caller.link->send_to(PeerId{99}, text("to nobody"));
  ASSERT_TRUE(wait_for(loop, [&] { return witness.streams[witness.joined[0]] == "one two!"; }));

  EXPECT_EQ(listener->counters().bytes_in, 8U);
  EXPECT_EQ(listener->counters().bytes_out, 13U);
  EXPECT_EQ(listener->counters().messages_out, 2U);
  EXPECT_EQ(listener->counters().dropped_by(DropReason::not_connected), 1U);
  EXPECT_EQ(caller.link->counters().messages_out, 3U);
  EXPECT_EQ(caller.link->counters().dropped_by(DropReason::not_connected), 1U);
}

TEST_F(TcpLinks, CarryMuchWithoutLossToAPeerThatReads) {
  const auto listener = listen({.queue = {.bytes = 1U << 20U, .messages = 4096}});
  Caller caller{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  ASSERT_TRUE(wait_for(loop, [&] { return !witness.joined.empty() && caller.witness.is_up(); }));
  std::string expected;
  for (auto i = 0; i < 1000; ++i) {
    const auto message = fmt::format("{:0>999} ", i);
    listener->send(text(message));
    expected += message;
  }
  ASSERT_TRUE(wait_for(loop, [&] { return caller.heard().size() == expected.size(); }));
  EXPECT_EQ(caller.heard(), expected);
  EXPECT_EQ(listener->counters().messages_out, 1000U);
}

TEST_F(TcpLinks, KeepNobodyWaitingForAStalledPeer) {
  const auto listener = listen({.queue = {.bytes = 8000, .messages = 100}});
  RawCaller stalled{*listener};
  Caller reading{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.joined.size() == 2 && reading.witness.is_up(); }));

  // A message is a line of 1000 bytes that begins with its number.
  std::string expected;
  constexpr auto count = 1000U;
  for (auto i = 0U; i < count; ++i) {
    const auto message = fmt::format("{:<999}\n", i);
    listener->send(text(message));
    expected += message;
    ASSERT_TRUE(wait_for(loop, [&] { return reading.heard().size() == expected.size(); })) << "at message " << i;
  }
  EXPECT_EQ(reading.heard(), expected);
  const auto& counters = listener->counters();
  const auto dropped = counters.dropped_by(DropReason::queue_full);
  EXPECT_GT(dropped, 100U);

  // What the stalled one reads at last are whole messages, oldest dropped, newest kept.
  std::string late;
  Timer read{loop, [&](Timestamp now) {
               late += stalled.read();
               read.set(now + 1ms);
             }};
  read.set(loop.now());
  ASSERT_TRUE(wait_for(loop, [&] {
    return counters.messages_out + dropped == 2 * count && late.ends_with(fmt::format("{:<999}\n", count - 1));
  }));
  ASSERT_EQ(late.size() % 1000, 0U);
  auto last = -1;
  for (std::size_t at = 0; at < late.size(); at += 1000) {
    const auto number = std::stoi(late.substr(at));
    EXPECT_EQ(late.substr(at, 1000), fmt::format("{:<999}\n", number));
    EXPECT_GT(number, last);
    last = number;
  }
  EXPECT_EQ(late.size() / 1000, count - dropped);
}

TEST_F(TcpLinks, SurviveClientsThatLeave) {
  const auto listener = listen();
  Caller staying{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  auto leaving = std::make_unique<Caller>(loop, at_port_of("tcpout://127.0.0.1", *listener));
  RawCaller dying{*listener};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.joined.size() == 3 && staying.witness.is_up(); }));
  leaving.reset();
  dying.die();
  ASSERT_TRUE(wait_for(loop, [&] { return witness.left.size() == 2; }));
  EXPECT_EQ(listener->counters().peers_left, 2U);
  EXPECT_EQ(listener->peer_name(witness.left[0]), "");
  listener->send(text("still here"));
  ASSERT_TRUE(wait_for(loop, [&] { return staying.heard() == "still here"; }));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::up));
  EXPECT_EQ(listener->counters().messages_out, 1U);
}

TEST_F(TcpLinks, CountWhatAPeerNeverGot) {
  const auto listener = listen({.queue = {.bytes = 8000, .messages = 100}});
  RawCaller stalled{*listener};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.joined.size() == 1; }));
  const auto& counters = listener->counters();
  const std::string message(1000, 'x');
  while (counters.dropped_by(DropReason::queue_full) == 0) listener->send(text(message));
  stalled.die();
  ASSERT_TRUE(wait_for(loop, [&] { return witness.left.size() == 1; }));
  EXPECT_EQ(counters.dropped_by(DropReason::disconnected), 8U) << "the queue's eight messages";
}

TEST_F(TcpLinks, RefuseWhatNoQueueCanHold) {
  const auto listener = listen({.queue = {.bytes = 10, .messages = 2}});
  Caller caller{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  ASSERT_TRUE(wait_for(loop, [&] { return !witness.joined.empty() && caller.witness.is_up(); }));
  listener->send(text("01234567890"));
  listener->send(text(""));
  listener->send(text("0123456789"));
  ASSERT_TRUE(wait_for(loop, [&] { return caller.heard() == "0123456789"; }));
  EXPECT_EQ(listener->counters().dropped_by(DropReason::oversize), 1U);
  EXPECT_EQ(listener->counters().messages_out, 1U);
}

TEST_F(TcpLinks, ConnectWhenThereIsSomebodyAtLast) {
  auto listener = listen();
  const auto place = at_port_of("127.0.0.1", *listener);
  listener.reset();
  Caller caller{loop, "tcpout://" + place};
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_down(); }));
  EXPECT_EQ(caller.witness.reasons.back(), place + ": Connection refused");
  loop.run_for(20ms);
  EXPECT_THAT(caller.witness.states, ElementsAre(LinkState::connecting, LinkState::down))
      << "told once, not per attempt";
  caller.link->send(text("lost"));
  EXPECT_EQ(caller.link->counters().dropped_by(DropReason::not_connected), 1U);

  listener = must_open(loop, "tcpin://" + place, witness);
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_up(); }));
  EXPECT_EQ(caller.link->counters().reconnects, 0U);
}

TEST_F(TcpLinks, ReconnectAsSomebodyElse) {
  auto listener = listen();
  const auto place = at_port_of("127.0.0.1", *listener);
  Caller caller{loop, "tcpout://" + place};
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_up() && !witness.joined.empty(); }));
  listener.reset();
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_down(); }));
  EXPECT_THAT(caller.witness.reasons.back(), HasSubstr(place));
  listener = must_open(loop, "tcpin://" + place, witness);
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_up(); }));
  EXPECT_THAT(caller.witness.states, ElementsAre(LinkState::connecting, LinkState::up, LinkState::down, LinkState::up));
  EXPECT_EQ(caller.link->counters().reconnects, 1U);
  ASSERT_THAT(caller.witness.joined, SizeIs(2));
  EXPECT_NE(caller.witness.joined[0], caller.witness.joined[1]);
  EXPECT_THAT(caller.witness.left, ElementsAre(caller.witness.joined[0]));
}

TEST_F(TcpLinks, TryOnceWithoutReconnect) {
  auto listener = listen();
  const auto place = at_port_of("127.0.0.1", *listener);
  listener.reset();
  const auto link = must_open(loop, "tcpout://" + place, witness, {.reconnect = false, .retry_first = 1ms});
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  Witness other;
  listener = must_open(loop, "tcpin://" + place, other);
  loop.run_for(20ms);
  EXPECT_THAT(witness.states, ElementsAre(LinkState::connecting, LinkState::down));
}

TEST_F(TcpLinks, GiveUpOnAHostThatDoesNotAnswer) {
  // Nobody accepts, and the row of those who wait is full: further calls are not answered.
  const FileDescriptor deaf{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(deaf.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  ASSERT_EQ(::listen(deaf.get(), 0), 0);
  socklen_t size = sizeof place;
  ASSERT_EQ(::getsockname(deaf.get(), reinterpret_cast<sockaddr*>(&place), &size), 0);
  const auto endpoint = fmt::format("tcpout://127.0.0.1:{}", ntohs(place.sin_port));

  Witness first_witness;
  const auto first = must_open(loop, endpoint, first_witness);
  ASSERT_TRUE(wait_for(loop, [&] { return first_witness.is_up(); }));
  const auto second = must_open(loop, endpoint, witness, {.connect_limit = 20ms});
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_THAT(witness.reasons.back(), HasSubstr("timed out"));
}

TEST_F(TcpLinks, RefuseConnectionsBeyondTheLimit) {
  const auto listener = listen({.peers = 1});
  Caller first{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  ASSERT_TRUE(wait_for(loop, [&] { return witness.joined.size() == 1; }));
  Caller second{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  ASSERT_TRUE(wait_for(loop, [&] { return second.witness.is_down(); }));
  EXPECT_GE(listener->counters().dropped_by(DropReason::too_many_peers), 1U);
  EXPECT_THAT(witness.joined, SizeIs(1));
  EXPECT_TRUE(first.witness.is_up());
}

TEST_F(TcpLinks, AreNotOpenedOnAPortInUse) {
  const auto listener = listen();
  const auto endpoint = at_port_of("tcpin://127.0.0.1", *listener);
  const auto second = open_link(loop, *parse_endpoint(endpoint), witness);
  ASSERT_FALSE(second);
  EXPECT_EQ(to_text(second.error()), endpoint + ": Address already in use");
}

TEST_F(TcpLinks, MayBeDestroyedByTheirHandler) {
  auto listener = listen();
  Caller caller{loop, at_port_of("tcpout://127.0.0.1", *listener)};
  ASSERT_TRUE(wait_for(loop, [&] { return caller.witness.is_up(); }));
  caller.witness.and_then = [&] { caller.link.reset(); };
  witness.and_then = [&] { listener.reset(); };
  caller.link->send(text("one"));
  ASSERT_TRUE(wait_for(loop, [&] { return listener == nullptr; }));
  loop.run_for(5ms);
  EXPECT_THAT(witness.left, IsEmpty());
  ASSERT_TRUE(caller.witness.is_down());
}

TEST_F(TcpLinks, LeaveNothingBehindOnALoopThatEnds) {
  auto owned = std::make_unique<Loop>();
  auto listener = must_open(*owned, "tcpin://127.0.0.1:0", witness);
  auto caller = must_open(*owned, at_port_of("tcpout://127.0.0.1", *listener), witness);
  ASSERT_TRUE(wait_for(*owned, [&] { return witness.joined.size() == 2; }));
  caller.reset();
  listener.reset();
  owned.reset();  // with the operations that have not noticed yet; sanitizers watch
  EXPECT_THAT(witness.left, IsEmpty());
}

}  // namespace
}  // namespace ponte::transport
