#include "ponte/transport/send_queue.hpp"

#include "ponte/core/bytes.hpp"
#include "ponte/core/random.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace ponte::transport {
namespace {

Bytes text(std::string_view text) { return bytes_of(text); }

std::string front_of(const SendQueue& queue) {
  const auto front = queue.front();
  return {reinterpret_cast<const char*>(front.data()), front.size()};
}

/// Lets everything leave.
std::string rest_of(SendQueue& queue) {
  std::string rest;
  while (!queue.empty()) {
    rest += front_of(queue);
    EXPECT_TRUE(queue.advance(queue.front().size()));
  }
  return rest;
}

TEST(SendQueue, KeepsTheOrder) {
  SendQueue queue{{.bytes = 100, .messages = 10}};
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.front().empty());
  EXPECT_EQ(queue.push(text("one")), 0U);
  EXPECT_EQ(queue.push(text("two")), 0U);
  EXPECT_EQ(queue.size(), 2U);
  EXPECT_EQ(queue.bytes(), 6U);
  EXPECT_EQ(rest_of(queue), "onetwo");
  EXPECT_EQ(queue.bytes(), 0U);
}

TEST(SendQueue, TellsWhenAMessageHasLeft) {
  SendQueue queue{{.bytes = 100, .messages = 10}};
  EXPECT_EQ(queue.push(text("message"), 2), 0U);
  EXPECT_EQ(front_of(queue), "ssage");
  EXPECT_FALSE(queue.advance(4));
  EXPECT_EQ(front_of(queue), "e");
  EXPECT_TRUE(queue.advance(1));
  EXPECT_TRUE(queue.empty());
}

TEST(SendQueue, DropsTheOldestWhenThereAreTooManyMessages) {
  SendQueue queue{{.bytes = 100, .messages = 2}};
  EXPECT_EQ(queue.push(text("1")), 0U);
  EXPECT_EQ(queue.push(text("2")), 0U);
  EXPECT_EQ(queue.push(text("3")), 1U);
  EXPECT_EQ(rest_of(queue), "23");
}

TEST(SendQueue, DropsAsManyOfTheOldestAsALargeMessageNeeds) {
  SendQueue queue{{.bytes = 10, .messages = 100}};
  for (const auto* each : {"aaa", "bbb", "ccc"}) EXPECT_EQ(queue.push(text(each)), 0U);
  EXPECT_EQ(queue.push(text("dddd")), 1U);
  EXPECT_EQ(queue.push(text("0123456789")), 3U);
  EXPECT_EQ(rest_of(queue), "0123456789");
}

TEST(SendQueue, NeverDropsAMessageThatHasBegun) {
  SendQueue queue{{.bytes = 10, .messages = 3}};
  EXPECT_EQ(queue.push(text("begun"), 1), 0U);
  EXPECT_EQ(queue.push(text("2")), 0U);
  EXPECT_EQ(queue.push(text("3")), 0U);
  EXPECT_EQ(queue.push(text("4")), 1U);
  EXPECT_EQ(queue.push(text("56789")), 2U);
  EXPECT_EQ(queue.push(text("abcdef")), 1U) << "does not fit beside the one that has begun, and gives way itself";
  EXPECT_EQ(rest_of(queue), "egun56789");

  SendQueue single{{.bytes = 10, .messages = 1}};
  EXPECT_EQ(single.push(text("begun"), 1), 0U);
  EXPECT_EQ(single.push(text("2")), 1U);
  EXPECT_EQ(rest_of(single), "egun");
}

TEST(SendQueue, CountsWhatItForgets) {
  SendQueue queue{{.bytes = 10, .messages = 3}};
  EXPECT_EQ(queue.push(text("begun"), 1), 0U);
  EXPECT_EQ(queue.push(text("2")), 0U);
  EXPECT_EQ(queue.clear(), 2U);
  EXPECT_EQ(queue.clear(), 0U);
  EXPECT_EQ(queue.push(text("3")), 0U);
  EXPECT_EQ(rest_of(queue), "3");
}

// Whatever happens, what leaves is a row of whole messages in their order, and none is unaccounted for.
TEST(SendQueue, LosesNoByteOfWhatLeavesAndNoCount) {
  constexpr std::uint64_t seed = 45860;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random{seed};
  SendQueue queue{{.bytes = 64, .messages = 8}};
  std::size_t pushed = 0;
  std::size_t dropped = 0;
  std::size_t finished = 0;
  std::string stream;
  for (auto step = 0; step < 20'000; ++step) {
    if (random.chance(0.6)) {
      // A message is its own number, as often as the number says, and a full stop.
      const auto size = 1 + random.below(30);
      std::string message(size, static_cast<char>('a' + pushed % 26));
      message += '.';
      ++pushed;
      dropped += queue.push(bytes_of(message));
    } else if (!queue.empty()) {
      const auto front = front_of(queue);
      const auto sent = 1 + random.below(static_cast<std::uint32_t>(front.size()));
      stream += front.substr(0, sent);
      if (queue.advance(sent)) ++finished;
    }
    ASSERT_LE(queue.bytes(), 64U);
    ASSERT_LE(queue.size(), 8U);
    ASSERT_EQ(pushed, dropped + finished + queue.size());
  }
  EXPECT_GT(dropped, 1000U);
  EXPECT_GT(finished, 1000U);
  std::size_t begin = 0;
  for (auto end = stream.find('.'); end != std::string::npos; end = stream.find('.', begin)) {
    const auto message = stream.substr(begin, end - begin);
    ASSERT_EQ(message.find_first_not_of(message.front()), std::string::npos) << message;
    begin = end + 1;
  }
}

}  // namespace
}  // namespace ponte::transport
