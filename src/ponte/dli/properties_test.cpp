#include "ponte/dli/properties.hpp"

#include <gtest/gtest.h>

namespace ponte::dli {
namespace {

TEST(Properties, HaveTheWordsOfTheStandard) {
  EXPECT_EQ(to_word({false, 30, Checksum::none}), 0x1E00);
  EXPECT_EQ(to_word({false, 30, Checksum::sum16}), 0x1E40);
  EXPECT_EQ(to_word({false, 30, Checksum::sum32}), 0x1E80);
  EXPECT_EQ(to_word({true, 30, Checksum::none}), 0x9E00);
  EXPECT_EQ(to_word({true, 30, Checksum::sum16}), 0x9E40);
  EXPECT_EQ(to_word({true, 30, Checksum::sum32}), 0x9E80);
  EXPECT_EQ(to_word({false, 32, Checksum::none}), 0x2000);
  EXPECT_EQ(to_word({false, 32, Checksum::sum16}), 0x2040);
  EXPECT_EQ(to_word({true, 32, Checksum::sum32}), 0xA080);
}

TEST(Properties, AreReadFromEveryWordWithoutItsReservedBits) {
  for (unsigned word = 0; word <= 0xFFFF; ++word) {
    const auto properties = properties_from_word(static_cast<std::uint16_t>(word));
    ASSERT_EQ(to_word(properties), word & 0xFFC0U);
  }
  EXPECT_EQ(properties_from_word(0xA0FF), (Properties{true, 32, Checksum::unassigned}));
}

TEST(Properties, TellHowManyBytesFollowTheData) {
  EXPECT_EQ(size_of(Checksum::none), 0U);
  EXPECT_EQ(size_of(Checksum::sum16), 2U);
  EXPECT_EQ(size_of(Checksum::sum32), 4U);
  EXPECT_EQ(size_of(Checksum::unassigned), 4U);
}

}  // namespace
}  // namespace ponte::dli
