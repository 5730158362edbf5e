#include "ponte/dli/entity_id.hpp"

#include <gtest/gtest.h>

namespace ponte::dli {
namespace {

TEST(EntityId, IsMadeOfOwningCodeTypeAndNationalNumber) {
  constexpr EntityId id{20, EntityType::vsm, 2};
  EXPECT_EQ(id.value, 0x14600002U);
  EXPECT_EQ(id.owning_code(), 20);
  EXPECT_EQ(id.type(), EntityType::vsm);
  EXPECT_EQ(id.national(), 2U);
  EXPECT_EQ((EntityId{20, EntityType::cucs, 2}.value), 0x14200002U);
}

TEST(EntityId, KeepsTheNationalNumberOutOfTheTypeBits) {
  constexpr EntityId id{255, EntityType::data_link, 0xFFFFFFFF};
  EXPECT_EQ(id.value, 0xFF9FFFFFU);
  EXPECT_EQ(id.type(), EntityType::data_link);
  EXPECT_EQ(id.national(), 0x1FFFFFU);
}

TEST(EntityId, NamesItsTypeAndLivesWithUnknownOnes) {
  EXPECT_EQ(name_of(EntityId{0x14400001}.type()), "vehicle");
  EXPECT_EQ(name_of(EntityId{0x14200001}.type()), "CUCS");
  EXPECT_EQ(name_of(broadcast_id.type()), "unassigned");
}

TEST(EntityId, GoesThroughItsTextUnchanged) {
  EXPECT_EQ(to_text(EntityId{0x14600002}).view(), "14:60:00:02");
  EXPECT_EQ(to_text(broadcast_id).view(), "FF:FF:FF:FF");
  EXPECT_EQ(to_text(null_id).view(), "FF:00:00:00");
  EXPECT_EQ(to_text(not_applicable_id).view(), "00:00:00:00");
  for (const auto id : {EntityId{0x01234567}, EntityId{0x89ABCDEF}, broadcast_id, null_id, not_applicable_id})
    EXPECT_EQ(parse_entity_id(to_text(id).view()), id);
  EXPECT_EQ(parse_entity_id("ff:aB:Cd:0e"), EntityId{0xFFABCD0E});
}

TEST(ParseEntityId, RefusesWhatIsNotFourPairsOfDigits) {
  for (const auto* text : {"", "14:60:00", "14:60:00:2", "14600002", "14:60:00:02:", "14-60-00-02", "014:60:00:2"})
    EXPECT_EQ(parse_entity_id(text), fail(EntityIdError::not_four_bytes)) << text;
  for (const auto* text : {"14:60:00:0g", "x4:60:00:02", "14:60: 0:02", "14:6::00:02"})
    EXPECT_EQ(parse_entity_id(text), fail(EntityIdError::not_a_hex_digit)) << text;
}

}  // namespace
}  // namespace ponte::dli
