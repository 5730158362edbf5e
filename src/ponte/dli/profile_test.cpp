#include "ponte/dli/profile.hpp"

#include "ponte/dli/messages/inertial_states.hpp"

#include <gtest/gtest.h>

namespace ponte::dli {
namespace {

using messages::InertialStates;

const FieldInfo& field(std::uint8_t number) { return InertialStates::fields[number - 1U]; }

TEST(Profile, SpeaksTheVersionOfItsEdition) {
  EXPECT_EQ(Profile{}.idd_version, 30);
  EXPECT_EQ(Profile{Edition::ed3}.idd_version, 30);
  EXPECT_EQ(Profile{Edition::ed_a}.idd_version, 32);
  EXPECT_EQ(Profile{}, Profile{Edition::ed3});
}

TEST(Profile, HasTheScalesOfTheTableUnlessOverridden) {
  Profile profile;
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(15)), 0.005);
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(5)), 0);
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(12)), bam_scale(2));
  profile.override_scale(MessageNumber{4000}, 17, 0.25);
  profile.override_scale(MessageNumber{4000}, 15, 0.5);
  profile.override_scale(MessageNumber{3999}, 16, 7);
  profile.override_scale(MessageNumber{4001}, 16, 8);
  profile.override_scale(MessageNumber{4000}, 15, 0.125);
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(15)), 0.125);
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(16)), 0.005);
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(17)), 0.25);
  EXPECT_EQ(profile.scale_of(InertialStates::info, field(18)), bam_scale(2));
}

TEST(Profile, HasTheVectorWidthsOfTheTableUnlessOverridden) {
  Profile profile;
  EXPECT_EQ(profile.presence_bytes_of(InertialStates::info), 3);
  profile.override_presence_bytes(MessageNumber{4001}, 5);
  EXPECT_EQ(profile.presence_bytes_of(InertialStates::info), 3);
  profile.override_presence_bytes(MessageNumber{4000}, 4);
  profile.override_presence_bytes(MessageNumber{4000}, 2);
  EXPECT_EQ(profile.presence_bytes_of(InertialStates::info), 2);
}

TEST(Profile, KnowsAMessageWithoutWidthOnceItIsOverridden) {
  auto info = InertialStates::info;
  info.presence_bytes = {0, 3};
  Profile profile;
  EXPECT_FALSE(profile.has_fields(info));
  profile.override_presence_bytes(info.number, 3);
  EXPECT_TRUE(profile.has_fields(info));
  info.in_edition = {false, true};
  EXPECT_FALSE(profile.has_fields(info));
}

}  // namespace
}  // namespace ponte::dli
