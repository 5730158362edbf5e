#include "ponte/mavlink/message_index.hpp"

#include "ponte/mavlink/test_messages.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ponte::mavlink {
namespace {

TEST(MessageIndex, FindsWhatTheDialectFinds) {
  std::vector<MessageInfo> infos;
  for (std::uint32_t id = 0; id < 1000; id += 1 + id % 7) infos.push_back({MessageId{id}, "", 0, 0, 0, {}});
  infos.push_back({MessageId{0xFFFFFF}, "", 0, 0, 0, {}});
  std::vector<const MessageInfo*> pointers;
  for (const auto& info : infos) pointers.push_back(&info);
  const Dialect dialect{"many", pointers};

  const MessageIndex index{dialect};
  for (std::uint32_t id = 0; id < 1100; ++id)
    EXPECT_EQ(index.find(MessageId{id}), dialect.find(MessageId{id})) << "id " << id;
  EXPECT_EQ(index.find(MessageId{0xFFFFFF}), pointers.back());
}

TEST(MessageIndex, FindsNothingInAnEmptyDialect) {
  const Dialect empty{};
  const MessageIndex index{empty};
  EXPECT_EQ(index.find(MessageId{0}), nullptr);
  EXPECT_EQ(index.find(MessageId{500}), nullptr);
}

}  // namespace
}  // namespace ponte::mavlink
