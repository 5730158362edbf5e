#include "ponte/dli/profile_file.hpp"

#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/messages/inertial_states.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace ponte::dli {
namespace {

Result<Profile, ProfileFileError> parse(std::string_view text) { return parse_profile(text, messages::catalogue); }

TEST(ProfileFile, HasADefaultForEverything) { EXPECT_EQ(parse(""), Profile{}); }

TEST(ProfileFile, SetsEveryKey) {
  const auto profile = parse(R"(
checksum = 4
idd_version = 33
accept_unassigned_checksum = true
edition = "A"
[[override]]
message = 4000
field = "roll_rate"
scale = 1
[[override]]
message = 4000
field = 16
scale = 0.25
presence_bytes = 4
)");
  Profile expected{Edition::ed_a};
  expected.checksum = Checksum::sum32;
  expected.idd_version = 33;
  expected.accept_unassigned_checksum = true;
  expected.override_scale(MessageNumber{4000}, 15, 1);
  expected.override_scale(MessageNumber{4000}, 16, 0.25);
  expected.override_presence_bytes(MessageNumber{4000}, 4);
  ASSERT_TRUE(profile) << profile.error().key;
  EXPECT_EQ(*profile, expected);
  EXPECT_EQ(parse("edition = \"A\"\nchecksum = 0")->checksum, Checksum::none);
  EXPECT_EQ(parse("edition = \"A\"")->idd_version, 32);
}

struct BadFile {
  std::string_view text;
  ProfileFileError error;
};

TEST(ProfileFile, TellsWhatIsWrongAndWhere) {
  const std::string keys = "one of edition, idd_version, checksum, accept_unassigned_checksum, override";
  const std::string override_keys = "one of message, field, scale, presence_bytes";
  const std::string message_number = "the number of a message whose fields are known";
  const std::string field_name = "the key or the number of a scaled integer field of message 4000";
  const BadFile files[] = {
      {"\nedition = 3", {2, "edition", "\"3\" or \"A\""}},
      {"edition = \"4\"", {1, "edition", "\"3\" or \"A\""}},
      {"checksum = 3", {1, "checksum", "0, 2 or 4"}},
      {"checksum = \"2\"", {1, "checksum", "0, 2 or 4"}},
      {"idd_version = 128", {1, "idd_version", "an integer from 0 to 127"}},
      {"idd_version = -1", {1, "idd_version", "an integer from 0 to 127"}},
      {"idd_version = 30.0", {1, "idd_version", "an integer from 0 to 127"}},
      {"accept_unassigned_checksum = 1", {1, "accept_unassigned_checksum", "true or false"}},
      {"edition = \"3\"\n\neditoin = \"A\"", {3, "editoin", keys}},
      {"override = 5", {1, "override", "tables that begin with [[override]]"}},
      {"override = [5]", {1, "override", "tables that begin with [[override]]"}},
      {"[override]\nmessage = 4000", {1, "override", "tables that begin with [[override]]"}},
      {"[[override]]\nmessage = 4000\nunit = 1", {3, "override.unit", override_keys}},
      {"[[override]]\nscale = 1\nfield = 15", {1, "override.message", "the number of a message"}},
      {"[[override]]\nmessage = 0", {2, "override.message", "an integer from 1 to 65535"}},
      {"[[override]]\nmessage = 65536", {2, "override.message", "an integer from 1 to 65535"}},
      {"[[override]]\nmessage = 4999", {2, "override.message", message_number}},
      {"[[override]]\nmessage = 5000", {2, "override.message", message_number}},
      {"[[override]]\nmessage = 4000", {1, "override", "field and scale, or presence_bytes"}},
      {"[[override]]\nmessage = 4000\nfield = 15", {1, "override", "field and scale together"}},
      {"[[override]]\nmessage = 4000\nscale = 15", {1, "override", "field and scale together"}},
      {"[[override]]\nmessage = 4000\nscale = 1\nfield = \"rollrate\"", {4, "override.field", field_name}},
      {"[[override]]\nmessage = 4000\nscale = 1\nfield = 19", {4, "override.field", field_name}},
      {"[[override]]\nmessage = 4000\nscale = 1\nfield = \"roll\"", {4, "override.field", field_name}},
      {"[[override]]\nmessage = 4000\nscale = 1\nfield = true", {4, "override.field", field_name}},
      {"[[override]]\nmessage = 4000\nfield = 15\nscale = 0", {4, "override.scale", "a number above 0"}},
      {"[[override]]\nmessage = 4000\nfield = 15\nscale = -1", {4, "override.scale", "a number above 0"}},
      {"[[override]]\nmessage = 4000\nfield = 15\nscale = inf", {4, "override.scale", "a number above 0"}},
      {"[[override]]\nmessage = 4000\nfield = 15\nscale = nan", {4, "override.scale", "a number above 0"}},
      {"[[override]]\nmessage = 4000\nfield = 15\nscale = \"1\"", {4, "override.scale", "a number above 0"}},
      {"[[override]]\nmessage = 4000\npresence_bytes = 0", {3, "override.presence_bytes", "an integer from 1 to 8"}},
      {"[[override]]\nmessage = 4000\npresence_bytes = 9", {3, "override.presence_bytes", "an integer from 1 to 8"}},
  };
  for (const auto& file : files) {
    const auto profile = parse(file.text);
    ASSERT_FALSE(profile) << file.text;
    EXPECT_EQ(profile.error().line, file.error.line) << file.text;
    EXPECT_EQ(profile.error().key, file.error.key) << file.text;
    EXPECT_EQ(profile.error().expectation, file.error.expectation) << file.text;
  }
}

// toml++ overflowed the stack on a key of a million dots.
TEST(ProfileFile, RefusesALineWithoutEnd) {
  std::string text = "checksum = 2\n";
  for (int i = 0; i < 1'000'000; ++i) text += "a.";
  EXPECT_EQ(parse(text).error(), (ProfileFileError{2, "", "lines of at most 4000 characters"}));
}

TEST(ProfileFile, TellsWhereATextIsNotToml) {
  const auto profile = parse("edition = \"3\"\nchecksum == 2\n");
  ASSERT_FALSE(profile);
  EXPECT_EQ(profile.error().line, 2U);
  EXPECT_EQ(profile.error().key, "");
  EXPECT_TRUE(profile.error().expectation.starts_with("TOML, but: ")) << profile.error().expectation;
}

TEST(ProfileFile, OfTheDissertationHasItsScales) {
  std::ifstream file{PONTE_SOURCE_DIR "/config/profiles/dissertation-2016.toml"};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  ASSERT_FALSE(text.empty());
  const auto profile = parse(text);
  ASSERT_TRUE(profile) << profile.error().line << ' ' << profile.error().key;
  const auto scale = [&](std::size_t number) {
    return profile->scale_of(messages::InertialStates::info, messages::InertialStates::fields[number - 1]);
  };
  for (const std::size_t acceleration : {9U, 10U, 11U}) EXPECT_EQ(scale(acceleration), 0.05);
  for (const std::size_t rate : {15U, 16U, 17U}) EXPECT_EQ(scale(rate), 0.0005);
  EXPECT_EQ(scale(6), 0.05) << "speeds are as in the standard";
}

}  // namespace
}  // namespace ponte::dli
