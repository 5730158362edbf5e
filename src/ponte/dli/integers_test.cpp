#include "ponte/dli/integers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace ponte::dli {
namespace {

TEST(Integers, AreReadWithTheirSign) {
  constexpr std::array high{std::byte{0x80}, std::byte{0x00}, std::byte{0x01}, std::byte{0x00}, std::byte{0x02}};
  const Bytes bytes{high};
  EXPECT_EQ(load_unsigned(bytes.first(1)), 0x80U);
  EXPECT_EQ(load_unsigned(bytes.first(3)), 0x800001U);
  EXPECT_EQ(load_unsigned(bytes), 0x8000010002U);
  EXPECT_EQ(load_signed(bytes.first(1)), -128);
  EXPECT_EQ(load_signed(bytes.first(3)), -0x7FFFFF);
  EXPECT_EQ(load_signed(bytes), 0x8000010002 - (std::int64_t{1} << 40U));
}

TEST(Integers, SurviveAtBothEndsOfEveryWidth) {
  std::array<std::byte, 5> buffer{};
  for (std::uint8_t width = 1; width <= 5; ++width) {
    const auto bytes = MutableBytes{buffer}.first(width);
    for (const auto range : {unsigned_range(width), signed_range(width)}) {
      for (const auto value : {range.first, range.first + 1, std::int64_t{0}, range.last - 1, range.last}) {
        store_integer(bytes, static_cast<std::uint64_t>(value));
        const auto read = range.first < 0 ? load_signed(bytes) : static_cast<std::int64_t>(load_unsigned(bytes));
        EXPECT_EQ(read, value) << "in " << int{width} << " bytes";
      }
      EXPECT_FALSE(range.holds(range.first - 1));
      EXPECT_FALSE(range.holds(range.last + 1));
    }
  }
}

TEST(Integers, HaveTheRangeOfTheirWidth) {
  EXPECT_EQ(unsigned_range(5), (IntegerRange{0, 1099511627775}));
  EXPECT_EQ(signed_range(3), (IntegerRange{-8388608, 8388607}));
  EXPECT_EQ(signed_range(4).first, std::numeric_limits<std::int32_t>::min());
}

TEST(Integers, AreWrittenMostSignificantByteFirst) {
  std::array<std::byte, 3> buffer{};
  store_integer(buffer, 0x001789);
  EXPECT_EQ(buffer, (std::array{std::byte{0x00}, std::byte{0x17}, std::byte{0x89}}));
}

}  // namespace
}  // namespace ponte::dli
