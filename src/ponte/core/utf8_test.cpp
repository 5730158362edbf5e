#include "ponte/core/utf8.hpp"

#include <gtest/gtest.h>

namespace ponte {
namespace {

TEST(Utf8Length, OfWellFormedSequences) {
  EXPECT_EQ(utf8_length("a"), 1U);
  EXPECT_EQ(utf8_length("\u00fc..."), 2U);
  EXPECT_EQ(utf8_length("\u20ac"), 3U);
  EXPECT_EQ(utf8_length("\U0001F681"), 4U);
}

TEST(Utf8Length, IsZeroForWhatIsNone) {
  EXPECT_EQ(utf8_length("\xFC"), 0U);              // Latin-1
  EXPECT_EQ(utf8_length("\xC3"), 0U);              // cut off
  EXPECT_EQ(utf8_length("\xC0\xAF"), 0U);          // over-long
  EXPECT_EQ(utf8_length("\xED\xA0\x80"), 0U);      // surrogate
  EXPECT_EQ(utf8_length("\xF4\x90\x80\x80"), 0U);  // beyond U+10FFFF
}

}  // namespace
}  // namespace ponte
