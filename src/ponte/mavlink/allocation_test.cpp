// What is done for every frame allocates no memory once it has started. (That a parser is small, its header asserts.)

#include "ponte/mavlink/dispatcher.hpp"
#include "ponte/mavlink/link_guard.hpp"
#include "ponte/mavlink/router.hpp"
#include "ponte/mavlink/test_signing.hpp"
#include "support/allocations.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

namespace ponte::mavlink {
namespace {

using namespace std::chrono_literals;

/// Every version, signed, unknown and damaged frames, and noise.
std::vector<std::byte> every_kind_of_frame() {
  std::vector<std::byte> all;
  for (const auto* part : {testing::heartbeat_frame, testing::attitude_v09_frame, "fd 55 fe 00 fd",
                           testing::heartbeat_v1_frame, testing::radio_status_frame, testing::attitude_frame,
                           testing::heartbeat_signed_frame, "fd 09 00 00 2a 01 01", testing::statustext_frame}) {
    const auto more = bytes(part);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

struct Allocations : ::testing::Test {
  void SetUp() override {
    if (!count_allocations()) GTEST_SKIP() << "only a sanitizer's allocator is counted";
  }

  /// What `step(number)` allocates in many steps. The first one may still make what it keeps.
  template <class Step>
  static std::uint64_t in_steps(Step&& step) {
    step(0);
    const auto before = allocation_count.load();
    for (int number = 1; number < 1000; ++number) step(number);
    return allocation_count - before;
  }
};

/// The pointers are volatile, so that no optimiser leaves the allocation out.
TEST_F(Allocations, AreCounted) {
  EXPECT_EQ(in_steps([](int) {
              const int* volatile kept = new int{};
              delete kept;
            }),
            999U);
  EXPECT_EQ(in_steps([](int) {
              void* volatile kept = std::malloc(1);
              std::free(kept);
            }),
            999U);
}

TEST_F(Allocations, OfParserAndDispatcherAreNone) {
  std::uint64_t heard = 0;
  Dispatcher dispatcher;
  dispatcher.on<testing::Attitude>([&](const testing::Attitude&, const FrameView&) { ++heard; });
  dispatcher.on<testing::Statustext>([&](const testing::Statustext&, const FrameView&) { ++heard; });
  dispatcher.on<testing::AttitudeV09>([&](const testing::AttitudeV09&, const FrameView&) { ++heard; });
  dispatcher.on_every_frame([&](const FrameView&, const MessageInfo*) { ++heard; });
  Parser parser{testing::dialect};
  const auto stream = every_kind_of_frame();
  EXPECT_EQ(in_steps([&](int number) {
              const Timestamp now{number * 1s};
              for (const auto& byte : stream) parser.on_bytes(now, Bytes{&byte, 1}, dispatcher);
              parser.on_tick(now + Parser::silence_limit, dispatcher);
              parser.on_bytes(now + 500ms, stream, dispatcher);
              parser.on_datagram(stream, dispatcher);
            }),
            0U);
  EXPECT_GT(heard, 10'000U);
}

TEST_F(Allocations, OfEncodingSigningAndJudgingAreNone) {
  Signer sender{testing::key(), {}};
  Signer receiver{testing::key(), {}};
  LinkGuard guard{{.unsigned_frames = UnsignedPolicy::listed}};
  std::array<std::byte, max_frame_size> buffer{};
  std::uint64_t refused = 0;
  const auto judge = [&](WallTime now, std::size_t size) {
    const auto frame = parse_frame(Bytes{buffer}.first(size));
    refused += !frame || guard.examine(now, *frame, &receiver) ? 1U : 0U;
  };
  EXPECT_EQ(in_steps([&](int number) {
              const auto now = testing::beginning_of_2015 + number * 1s;
              const FrameHeader header{.component = ComponentId{static_cast<std::uint8_t>(number)}};
              const auto size = encode(testing::Attitude{.roll = 0.5F}, header, buffer).value();
              judge(now, size);
              const auto whole = sender.sign(now, static_cast<std::uint8_t>(number), buffer, size);
              judge(now, whole);
              judge(now, whole);  // a replay
              buffer[whole - 1] ^= std::byte{1};
              judge(now, whole);
            }),
            0U);
  EXPECT_EQ(refused, 3 * 1000U);
}

TEST_F(Allocations, OfARouterAreNone) {
  Router router{1};
  for (std::uint16_t link = 1; link <= 8; ++link)
    ASSERT_TRUE(router.add_link(RouteLinkId{link},
                                {.untrusted = link == 8, .limits = {{testing::Heartbeat::info.id, Duration{100ms}}}}));
  std::array<std::byte, max_frame_size> buffer{};
  std::uint64_t sent = 0;
  EXPECT_EQ(
      in_steps([&](int number) {
        const FrameHeader header{.system = SystemId{static_cast<std::uint8_t>(1 + number % 255)},
                                 .sequence = static_cast<std::uint8_t>(number)};
        const auto size = encode(testing::Heartbeat{}, header, buffer).value();
        const auto frame = parse_frame(Bytes{buffer}.first(size)).value();
        for (std::uint16_t link = 1; link <= 8; ++link)  // the first of them, then its duplicates
          sent += router.on_frame(Timestamp{number * 10ms}, RouteLinkId{link}, frame, &testing::Heartbeat::info).size();
      }),
      0U);
  EXPECT_GT(sent, 1000U);
}

}  // namespace
}  // namespace ponte::mavlink
