#include "ponte/core/bytes.hpp"

#include <gtest/gtest.h>

#include <array>

namespace ponte {
namespace {

constexpr std::array ascending{std::byte{0x01}, std::byte{0x02}, std::byte{0x03}, std::byte{0x04},
                               std::byte{0x05}, std::byte{0x06}, std::byte{0x07}, std::byte{0x08}};

TEST(Bytes, AreReadInBothByteOrders) {
  EXPECT_EQ(u8(ascending, 3), 0x04);
  EXPECT_EQ(u16_le(ascending, 0), 0x0201);
  EXPECT_EQ(u16_be(ascending, 0), 0x0102);
  EXPECT_EQ(u32_be(ascending, 1), 0x02030405U);
  EXPECT_EQ(u64_be(ascending, 0), 0x0102030405060708U);
}

TEST(Bytes, AreWrittenAsTheyAreRead) {
  std::array<std::byte, 8> buffer{};
  store_be(buffer.data(), -1.5F);
  EXPECT_EQ(buffer[0], std::byte{0xBF});
  EXPECT_EQ(load_be<float>(buffer.data()), -1.5F);
  store_le(buffer.data(), std::int64_t{-2});
  EXPECT_EQ(buffer[0], std::byte{0xFE});
  EXPECT_EQ(load_le<std::int64_t>(buffer.data()), -2);
}

}  // namespace
}  // namespace ponte
