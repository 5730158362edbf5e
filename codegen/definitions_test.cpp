#include "codegen/digest.hpp"
#include "codegen/dli_reader.hpp"
#include "codegen/emit.hpp"
#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <gmock/gmock.h>

/// The definitions that ponte is built from.
namespace ponte::codegen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

const Protocol& dli() {
  static const auto protocol = read_dli(PONTE_SOURCE_DIR "/definitions/dli");
  return protocol;
}

TEST(DliDefinitions, KnowNoMessageOfTheWeaponsGroups) {
  for (const auto& message : dli().messages)
    EXPECT_TRUE(message.number < 24000 || message.number > 27999) << message.number;
  for (const auto& group : dli().groups) EXPECT_TRUE(group.last < 24000 || group.first > 27999) << group.name;
}

TEST(DliDefinitions, TellSourceAndConfidenceOfEveryMessage) {
  for (const auto& message : dli().messages) {
    EXPECT_THAT(message.sources, Not(IsEmpty())) << message.number;
    EXPECT_NE(message.confidence, "unknown") << message.number;
  }
}

TEST(DliDefinitions, NameOnlySourcesThatTheReadmeExplains) {
  const auto readme = read_file(PONTE_SOURCE_DIR "/definitions/dli/README.md");
  for (const auto& message : dli().messages)
    for (const auto& source : message.sources) EXPECT_THAT(readme, HasSubstr("| `" + source + "` |")) << message.number;
}

TEST(DliDefinitions, HaveAGroupForEveryMessageSoThatTheReferenceShowsIt) {
  const auto page = emit_dli_reference(dli());
  for (const auto& message : dli().messages)
    EXPECT_THAT(page, HasSubstr("### #" + std::to_string(message.number) + " " + message.name + "\n"));
}

TEST(DliDefinitions, ClaimNoMoreMessagesOfEdition3ThanItsTablesHave) {
  for (const auto& group : dli().groups) {
    const auto claimed = std::ranges::count_if(dli().messages, [&](const Message& message) {
      return message.in_edition[0] && message.number >= group.first && message.number <= group.last;
    });
    EXPECT_LE(claimed, group.message_count) << group.name;
  }
}

TEST(DliDefinitions, ReadInertialStatesAsTheEdition3TableHasIt) {
  const auto& inertial = message_of(dli(), 4000);
  EXPECT_EQ(inertial.key, "inertial_states");
  EXPECT_EQ(inertial.confidence_ed3, "standard");
  EXPECT_THAT(inertial.presence_bytes, ElementsAre(3, 3));
  EXPECT_FALSE(inertial.partial);
  std::vector<std::string> keys;
  std::size_t size = 0;
  for (const auto& field : inertial.fields) {
    keys.push_back(field.key);
    size += field.size();
  }
  EXPECT_THAT(keys, ElementsAre("time_stamp", "latitude", "longitude", "altitude", "altitude_type", "u_speed",
                                "v_speed", "w_speed", "u_accel", "v_accel", "w_accel", "roll", "pitch", "heading",
                                "roll_rate", "pitch_rate", "turn_rate", "magnetic_variation"));
  EXPECT_EQ(size, 43U);
  EXPECT_EQ(field_of(inertial, "Latitude").kind, Kind::bam);
  EXPECT_EQ(field_of(inertial, "Latitude").width, 4U);
  EXPECT_EQ(field_of(inertial, "Altitude").kind, Kind::signed_integer);
  EXPECT_EQ(field_of(inertial, "Altitude").width, 3U);
  EXPECT_EQ(field_of(inertial, "Altitude").scale, 0.02);
  EXPECT_EQ(field_of(inertial, "U_Accel").scale, 0.005);
  EXPECT_EQ(field_of(inertial, "Turn Rate").unique_id, "0101.19");
  EXPECT_EQ(field_of(inertial, "Turn Rate").scale, 0.005);
}

TEST(DliDefinitions, LeaveOutLaserAndDesignatorFieldsOfThePayload) {
  const auto excluded_of = [](const Message& message) {
    std::vector<std::size_t> numbers;
    for (const auto& field : message.fields)
      if (field.excluded) numbers.push_back(field.number);
    return numbers;
  };
  EXPECT_THAT(excluded_of(message_of(dli(), 19001)), ElementsAre(11, 12, 13, 14));
  EXPECT_THAT(excluded_of(message_of(dli(), 21002)), ElementsAre(22, 23, 24, 25));
}

TEST(DliDefinitions, CallPartialWhatCannotBeDecodedToTheEnd) {
  std::vector<std::uint32_t> without_fields;
  for (const auto& message : dli().messages)
    if (message.fields.empty()) {
      without_fields.push_back(message.number);
      EXPECT_TRUE(message.partial) << message.number;
    }
  EXPECT_THAT(without_fields, UnorderedElementsAre(5000, 5001, 6000, 13004, 13005, 13006, 34000, 35000));
  EXPECT_TRUE(message_of(dli(), 3000).partial) << "the scale of the load factor is not known";
  EXPECT_FALSE(message_of(dli(), 16000).partial);
}

TEST(MavlinkDefinitions, AgreeWithTheDigest) {
  const auto protocol = read_mavlink(PONTE_SOURCE_DIR "/definitions/mavlink/autopilots.xml",
                                     {PONTE_SOURCE_DIR "/definitions/mavlink", PONTE_MAVLINK_XML_DIR});
  EXPECT_EQ(digest_of(protocol), read_file(PONTE_SOURCE_DIR "/definitions/mavlink/digest.txt"));
}

}  // namespace
}  // namespace ponte::codegen
