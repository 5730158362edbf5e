#include "ponte/mavlink/crc.hpp"

#include "ponte/core/random.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace ponte::mavlink {
namespace {

/// The definition, bit by bit.
std::uint16_t crc_by_definition(Bytes bytes) {
  unsigned crc = 0xFFFF;
  for (const auto byte : bytes) {
    crc ^= std::to_integer<unsigned>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0x8408U : crc >> 1U;
  }
  return static_cast<std::uint16_t>(crc);
}

TEST(Crc, HasTheCheckValueOfMcrf4xx) {
  constexpr std::string_view digits = "123456789";
  EXPECT_EQ(crc_of(bytes_of(digits)), 0x6F91);
  EXPECT_EQ(crc_of(Bytes{}), crc_initial);
}

TEST(Crc, FollowsTheDefinitionAtEveryLength) {
  Random random{1};
  std::vector<std::byte> data(300);
  random.fill(data);
  for (std::size_t size = 0; size <= data.size(); ++size) {
    const auto part = Bytes{data}.first(size);
    EXPECT_EQ(crc_of(part), crc_by_definition(part)) << "at " << size;
  }
}

TEST(Crc, WithTheTablesAloneItIsTheSame) {
  Random random{3};
  std::vector<std::byte> data(600);
  random.fill(data);
  for (std::size_t size = 0; size <= data.size(); ++size) {
    const auto before = static_cast<std::uint16_t>(random.below(0x10000));
    const auto part = Bytes{data}.first(size);
    EXPECT_EQ(crc_of(part, before), detail::crc_by_tables(part, before)) << "at " << size;
  }
}

TEST(Crc, GoesOnWhereItStopped) {
  Random random{2};
  std::vector<std::byte> data(50);
  random.fill(data);
  const auto expected = crc_of(data);
  for (std::size_t size = 0; size <= data.size(); ++size)
    EXPECT_EQ(crc_of(Bytes{data}.subspan(size), crc_of(Bytes{data}.first(size))), expected) << "cut at " << size;
  const auto last = std::to_integer<std::uint8_t>(data.back());
  EXPECT_EQ(crc_of(last, crc_of(Bytes{data}.first(data.size() - 1))), expected);
}

}  // namespace
}  // namespace ponte::mavlink
