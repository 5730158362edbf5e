#include "support/world/channel.hpp"

#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace ponte::world {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int many = 20'000;

/// A piece with this number in it.
std::array<std::byte, 40> piece(std::uint32_t number) {
  std::array<std::byte, 40> bytes{};
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

struct Arrival {
  Timestamp time;
  std::uint32_t number;
};

std::vector<Arrival> arrivals(Channel& channel) {
  std::vector<Arrival> result;
  while (const auto time = channel.next_arrival()) {
    const auto bytes = channel.take_arrival();
    result.push_back({*time, load_le<std::uint32_t>(bytes.data())});
  }
  return result;
}

/// Sends `many` pieces, one each millisecond.
std::vector<Arrival> send_many(Channel& channel) {
  for (std::uint32_t i = 0; i < many; ++i) channel.send(Timestamp{milliseconds{i}}, piece(i));
  return arrivals(channel);
}

double part(std::uint64_t count) { return static_cast<double>(count) / many; }

TEST(Channel, LeavesEverythingAsItIsUnlessToldOtherwise) {
  Channel channel{{}, 1};
  const auto received = send_many(channel);
  ASSERT_EQ(received.size(), many);
  for (std::uint32_t i = 0; i < many; ++i) {
    EXPECT_EQ(received[i].number, i);
    EXPECT_EQ(received[i].time, Timestamp{milliseconds{i}});
  }
}

TEST(ChannelSeeded, LosesAsOftenAsTold) {
  Channel channel{{.loss = 0.2}, chosen_seed()};
  EXPECT_NEAR(part(send_many(channel).size()), 0.8, 0.02);
  EXPECT_EQ(channel.counters().lost + channel.counters().delivered, std::uint64_t{many});
}

TEST(ChannelSeeded, LosesInBursts) {
  Channel channel{{.burst_begins = 0.01, .burst_ends = 0.1}, chosen_seed()};
  const auto received = send_many(channel);
  // Ten pieces on average, once in a hundred and ten.
  EXPECT_NEAR(part(channel.counters().lost), 1.0 / 11, 0.03);
  std::uint32_t gaps = 0;
  for (std::size_t i = 1; i < received.size(); ++i) gaps += received[i].number != received[i - 1].number + 1 ? 1U : 0U;
  EXPECT_NEAR(static_cast<double>(channel.counters().lost) / gaps, 10, 3);
}

TEST(ChannelSeeded, DelaysWithJitterButKeepsTheOrder) {
  Channel channel{{.delay = milliseconds{20}, .jitter = milliseconds{10}}, chosen_seed()};
  const auto received = send_many(channel);
  ASSERT_EQ(received.size(), many);
  auto least = Duration::max();
  auto most = Duration::min();
  for (std::uint32_t i = 0; i < many; ++i) {
    ASSERT_EQ(received[i].number, i);
    const auto took = received[i].time - Timestamp{milliseconds{i}};
    least = std::min(least, took);
    most = std::max(most, took);
  }
  EXPECT_GE(least, milliseconds{20});
  EXPECT_LT(least, milliseconds{23});
  EXPECT_LT(most, milliseconds{30});
  EXPECT_GT(most, milliseconds{29});
}

TEST(ChannelSeeded, LetsSomeBeOvertaken) {
  Channel channel{{.reordering = 0.1, .held_back = milliseconds{5}}, chosen_seed()};
  const auto received = send_many(channel);
  ASSERT_EQ(received.size(), many);
  std::uint32_t late = 0;
  std::uint32_t newest = 0;
  for (const auto& each : received) {
    late += each.number < newest ? 1U : 0U;
    newest = std::max(newest, each.number);
  }
  EXPECT_NEAR(part(channel.counters().reordered), 0.1, 0.02);
  EXPECT_NEAR(part(late), 0.1, 0.02);
}

TEST(ChannelSeeded, DeliversSomeTwice) {
  Channel channel{{.duplication = 0.05}, chosen_seed()};
  EXPECT_NEAR(part(send_many(channel).size()), 1.05, 0.01);
}

TEST(ChannelSeeded, ChangesSingleBits) {
  Channel channel{{.bit_flips = 0.001}, chosen_seed()};
  for (std::uint32_t i = 0; i < many; ++i) channel.send({}, piece(0));
  std::uint64_t bits = 0;
  while (channel.next_arrival())
    for (const auto byte : channel.take_arrival())
      bits += static_cast<std::uint64_t>(std::popcount(std::to_integer<std::uint8_t>(byte)));
  EXPECT_NEAR(static_cast<double>(bits) / (40.0 * many), 0.001, 0.0002);
  EXPECT_GT(channel.counters().changed, 0U);
}

TEST(Channel, SendsNoFasterThanItsRate) {
  Channel channel{{.bytes_per_second = 5760}, 1};
  for (std::uint32_t i = 0; i < 100; ++i) channel.send({}, piece(i));
  const auto received = arrivals(channel);
  ASSERT_EQ(received.size(), 100U);
  const auto all = std::chrono::duration<double>{received.back().time.time_since_epoch()}.count();
  EXPECT_NEAR(all, 4000.0 / 5760, 1e-6);
}

TEST(Channel, LosesWhatFindsNoRoomInItsQueue) {
  Channel channel{{.bytes_per_second = 5760, .fifo_bytes = 400}, 1};
  for (std::uint32_t i = 0; i < 9; ++i) channel.send({}, piece(i));
  EXPECT_EQ(channel.send({}, piece(9)), Channel::Fate::on_its_way);
  EXPECT_EQ(channel.send({}, piece(10)), Channel::Fate::overflowed);
  EXPECT_EQ(channel.counters().overflowed, 1U);
  // A tenth of a second later there is room again, for 576 bytes.
  EXPECT_EQ(channel.send(Timestamp{milliseconds{100}}, piece(11)), Channel::Fate::on_its_way);
}

TEST(Channel, CarriesNothingWhileItIsCut) {
  Channel channel{{}, 1};
  channel.cut_until(Timestamp{seconds{2}});
  EXPECT_EQ(channel.send(Timestamp{seconds{1}}, piece(0)), Channel::Fate::cut_off);
  EXPECT_EQ(channel.send(Timestamp{seconds{2}}, piece(1)), Channel::Fate::on_its_way);
  EXPECT_EQ(arrivals(channel).size(), 1U);
}

TEST(ChannelSeeded, DoesTheSameWithTheSameSeed) {
  const ChannelConfig bad{.delay = milliseconds{30},
                          .jitter = milliseconds{20},
                          .loss = 0.1,
                          .burst_begins = 0.01,
                          .duplication = 0.1,
                          .reordering = 0.1,
                          .bit_flips = 0.001};
  Channel one{bad, chosen_seed()};
  Channel same{bad, chosen_seed()};
  const auto first = send_many(one);
  const auto second = send_many(same);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].time, second[i].time);
    EXPECT_EQ(first[i].number, second[i].number);
  }
  EXPECT_EQ(one.counters(), same.counters());
}

}  // namespace
}  // namespace ponte::world
