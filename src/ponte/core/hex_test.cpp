#include "ponte/core/hex.hpp"

#include <gtest/gtest.h>

namespace ponte {
namespace {

TEST(Hex, GoesBothWays) {
  const auto bytes = parse_hex("FD 09\n00ff");
  ASSERT_TRUE(bytes);
  EXPECT_EQ(to_hex(*bytes), "fd0900ff");
  EXPECT_EQ(to_hex(*bytes, " "), "fd 09 00 ff");
  EXPECT_EQ(to_hex({}), "");
}

TEST(Hex, SaysWhereATextIsNotHex) {
  EXPECT_EQ(parse_hex("00 0g").error(), (HexError{4, HexError::Reason::not_a_hex_digit}));
  EXPECT_EQ(parse_hex("x").error(), (HexError{0, HexError::Reason::not_a_hex_digit}));
  EXPECT_EQ(parse_hex("00 1").error(), (HexError{3, HexError::Reason::half_a_byte}));
  EXPECT_EQ(parse_hex("1 2").error(), (HexError{0, HexError::Reason::half_a_byte}));
}

}  // namespace
}  // namespace ponte
