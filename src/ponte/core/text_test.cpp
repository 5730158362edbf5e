#include "ponte/core/text.hpp"

#include <gtest/gtest.h>

namespace ponte {
namespace {

TEST(Text, EndsAtTheFirstNulOrAtItsCapacity) {
  EXPECT_EQ(Text<4>{"ab"}.view(), "ab");
  EXPECT_EQ(Text<4>{"abcd"}.view(), "abcd");
  EXPECT_EQ(Text<4>{"abcdef"}.view(), "abcd");
  EXPECT_TRUE(Text<4>{}.empty());
}

}  // namespace
}  // namespace ponte
