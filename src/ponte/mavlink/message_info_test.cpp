#include "ponte/mavlink/message_info.hpp"

#include "ponte/mavlink/test_messages.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ponte::mavlink {
namespace {

TEST(Dialect, FindsTheSameWithTheTableOfLowIdsAndWithout) {
  std::vector<MessageInfo> infos;
  for (std::uint32_t id = 0; id < 1000; id += 1 + id % 7) infos.push_back({MessageId{id}, "", 0, 0, 0, {}});
  infos.push_back({MessageId{0xFFFFFF}, "", 0, 0, 0, {}});
  std::vector<const MessageInfo*> pointers;
  for (const auto& info : infos) pointers.push_back(&info);
  const auto low = low_messages(pointers);
  const Dialect fast{.name = "fast", .messages = pointers, .low = low};
  const Dialect slow{.name = "slow", .messages = pointers};
  std::size_t found = 0;
  for (std::uint32_t id = 0; id < 1100; ++id) {
    EXPECT_EQ(fast.find(MessageId{id}), slow.find(MessageId{id})) << "id " << id;
    if (const auto* message = slow.find(MessageId{id})) {
      EXPECT_EQ(message->id, MessageId{id});
      ++found;
    }
  }
  EXPECT_EQ(found + 1, infos.size());
  EXPECT_EQ(fast.find(MessageId{0xFFFFFF}), pointers.back());
}

TEST(Dialect, FindsNothingInAnEmptyOne) {
  const Dialect empty{};
  EXPECT_EQ(empty.find(MessageId{0}), nullptr);
  EXPECT_EQ(empty.find_v09(MessageId{0}, 3), nullptr);
}

TEST(Dialect, FindsMessagesOfMavlink09ByTheirLengthToo) {
  EXPECT_EQ(testing::dialect.find_v09(MessageId{30}, 32), &testing::AttitudeV09::info);
  EXPECT_EQ(testing::dialect.find_v09(MessageId{30}, 44), &testing::EverythingV09::info);
  EXPECT_EQ(testing::dialect.find_v09(MessageId{30}, 28), nullptr);
  EXPECT_EQ(testing::dialect.find_v09(MessageId{0}, 32), nullptr);
}

}  // namespace
}  // namespace ponte::mavlink
