#include "codegen/dli_reader.hpp"

#include "ponte/definitions/test_tools.hpp"

#include <gmock/gmock.h>

namespace ponte::codegen {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view complete = R"([[message]]
number = 4000
name = "Inertial States"
name_a = "Inertial State"
key = "inertial"
editions = ["3", "A"]
presence_bytes = { "3" = 1, "A" = 2 }
number_ed2 = 101
direction = "VSM->CUCS"
exchange = "push/pull"
loi = [2, 5]
latency_ms = 1000
confidence = "standard"
confidence_ed3 = "single-source"
source = ["synapsecommand", "ed2.5"]
note = "U north"
fields = [
  { n = 1, id = "0101.01", name = "Time Stamp", type = "u5", unit = "s", scale = 0.001 },
  { n = 2, id = "0101.04", name = "Latitude", type = "b4", unit = "rad" },
  { n = 3, name = "Altitude Type", type = "u1", enum = "altitude_type", since = "A", guess = ["type"], note = "why" },
]

[enum.altitude_type]
confidence = "inferred"
bitmap = true
values = [
  { value = 0, label = "Pressure Altitude", note = "QNE" },
  { first = 32, last = 255, label = "Vehicle specific" },
]

[[group]]
name = "Relevant Status"
first = 4000
last = 4999
messages_in_ed3 = 2
ed3_table = "B1-9"
)";

constexpr std::string_view small = R"([[message]]
number = 100
name = "Small"
editions = ["A"]
presence_bytes = { "A" = 1 }
fields = [
  { n = 1, name = "Value", type = "u2" },
]
)";

Protocol read(std::string_view text) { return read_dli_text(text, "test.toml"); }
Message read_small(std::string_view field) {
  return read(replaced(small, R"(name = "Value", type = "u2")", field)).messages.at(0);
}

TEST(DliReader, ReadsEveryKeyOfAMessage) {
  const auto message = read(complete).messages.at(0);
  EXPECT_EQ(message.number, 4000U);
  EXPECT_EQ(message.name, "Inertial States");
  EXPECT_EQ(message.name_a, "Inertial State");
  EXPECT_EQ(message.key, "inertial");
  EXPECT_THAT(message.in_edition, ElementsAre(true, true));
  EXPECT_THAT(message.presence_bytes, ElementsAre(1, 2));
  EXPECT_EQ(message.number_ed2, 101U);
  EXPECT_EQ(message.direction, "VSM->CUCS");
  EXPECT_EQ(message.exchange, "push/pull");
  EXPECT_THAT(message.levels, ElementsAre(2, 5));
  EXPECT_EQ(message.latency_ms, 1000U);
  EXPECT_EQ(message.confidence, "standard");
  EXPECT_EQ(message.confidence_ed3, "single-source");
  EXPECT_THAT(message.sources, ElementsAre("synapsecommand", "ed2.5"));
  EXPECT_EQ(message.note, "U north");
  EXPECT_EQ(message.source.line, 1U);
}

TEST(DliReader, ReadsEveryKeyOfAField) {
  const auto fields = read(complete).messages.at(0).fields;
  ASSERT_EQ(fields.size(), 3U);
  EXPECT_EQ(fields[0].unique_id, "0101.01");
  EXPECT_EQ(fields[0].key, "time_stamp");
  EXPECT_EQ(fields[0].kind, Kind::unsigned_integer);
  EXPECT_EQ(fields[0].width, 5U);
  EXPECT_EQ(fields[0].unit, "s");
  EXPECT_EQ(fields[0].scale, 0.001);
  EXPECT_EQ(fields[0].role, "");
  EXPECT_EQ(fields[1].kind, Kind::bam);
  EXPECT_EQ(fields[2].enumeration, "altitude_type");
  EXPECT_EQ(fields[2].role, "enum");
  EXPECT_TRUE(fields[2].since_edition_a);
  EXPECT_TRUE(fields[2].guessed);
  EXPECT_EQ(fields[2].note, "why");
  EXPECT_EQ(fields[2].source.line, 20U);
}

TEST(DliReader, ReadsEnumerationsAndGroups) {
  const auto protocol = read(complete);
  const auto& enumeration = protocol.enumerations.at(0);
  EXPECT_EQ(enumeration.name, "altitude_type");
  EXPECT_EQ(enumeration.confidence, "inferred");
  EXPECT_TRUE(enumeration.bitmap);
  ASSERT_EQ(enumeration.entries.size(), 2U);
  EXPECT_EQ(enumeration.entries[0].name, "Pressure Altitude");
  EXPECT_EQ(enumeration.entries[0].note, "QNE");
  EXPECT_EQ(enumeration.entries[0].last, 0U);
  EXPECT_EQ(enumeration.entries[1].first, 32U);
  EXPECT_EQ(enumeration.entries[1].last, 255U);
  const auto& group = protocol.groups.at(0);
  EXPECT_EQ(group.name, "Relevant Status");
  EXPECT_EQ(group.first, 4000U);
  EXPECT_EQ(group.last, 4999U);
  EXPECT_EQ(group.message_count, 2U);
  EXPECT_EQ(group.table, "B1-9");
}

TEST(DliReader, TakesWhatIsNotSaidAsUnknown) {
  const auto message = read(small).messages.at(0);
  EXPECT_EQ(message.name_a, "Small");
  EXPECT_EQ(message.key, "small");
  EXPECT_EQ(message.direction, "both");
  EXPECT_EQ(message.exchange, "push");
  EXPECT_EQ(message.confidence, "unknown");
  EXPECT_EQ(message.confidence_ed3, "unknown");
  EXPECT_THAT(message.sources, IsEmpty());
  EXPECT_THAT(message.in_edition, ElementsAre(false, true));
}

TEST(DliReader, ReadsEveryType) {
  struct Case {
    const char* field;
    Kind kind;
    std::size_t width;
    std::size_t count;
  };
  for (const auto& [type, kind, width, count] :
       {Case{"u1", Kind::unsigned_integer, 1, 0}, Case{"u5", Kind::unsigned_integer, 5, 0},
        Case{"i1", Kind::signed_integer, 1, 0}, Case{"i5", Kind::signed_integer, 5, 0}, Case{"b1", Kind::bam, 1, 0},
        Case{"b4", Kind::bam, 4, 0}, Case{"f4", Kind::real, 4, 0}, Case{"c1", Kind::character, 1, 1},
        Case{"c255", Kind::character, 1, 255}}) {
    const auto field = read_small(std::string{R"(name = "Value", type = ")"} + type + '"').fields.at(0);
    EXPECT_EQ(field.kind, kind) << type;
    EXPECT_EQ(field.width, width) << type;
    EXPECT_EQ(field.count, count) << type;
  }
}

TEST(DliReader, ReadsATextWhoseLengthAnEarlierFieldGives) {
  const auto fields = read(replaced(small, "\n]", "\n  { n = 2, name = \"Text\", type = \"c\", length_from = 1 },\n]"))
                          .messages.at(0)
                          .fields;
  EXPECT_EQ(fields.at(1).kind, Kind::character);
  EXPECT_EQ(fields.at(1).size(), 0U);
  EXPECT_EQ(fields.at(1).length_from, 1U);
}

TEST(DliReader, ReadsAnExcludedFieldWithItsWidthAlone) {
  const auto field = read_small(R"(type = "u2", excluded = true)").fields.at(0);
  EXPECT_TRUE(field.excluded);
  EXPECT_EQ(field.key, "excluded_1");
  EXPECT_EQ(field.name, "out of scope");
  EXPECT_EQ(field.size(), 2U);
}

TEST(DliReader, CallsAMessageWithoutFieldTablePartial) {
  const auto text = replaced(replaced(small, "fields = [\n  { n = 1, name = \"Value\", type = \"u2\" },\n]\n", ""),
                             "presence_bytes = { \"A\" = 1 }\n", "");
  EXPECT_TRUE(read(text).messages.at(0).partial);
}

TEST(DliReader, CallsANumberWithUnitAndNoScalePartial) {
  EXPECT_TRUE(read_small(R"(name = "Value", type = "u2", unit = "m/s")").partial);
  EXPECT_TRUE(read_small(R"(name = "Value", type = "i2", unit = "m/s")").partial);
  EXPECT_FALSE(read_small(R"(name = "Value", type = "u2", unit = "m/s", scale = 0.5)").partial);
}

TEST(DliReader, NeedsNoScaleWhereTheRawValueIsTheMeaning) {
  EXPECT_FALSE(read_small(R"(name = "Count", type = "u2")").partial);
  EXPECT_FALSE(read_small(R"(name = "Angle", type = "b2", unit = "rad")").partial);
  EXPECT_FALSE(read_small(R"(name = "Mass", type = "f4", unit = "kg")").partial);
  EXPECT_FALSE(read_small(R"(name = "Text", type = "c8", unit = "ASCII")").partial);
  EXPECT_FALSE(read_small(R"(name = "Stations", type = "u2", role = "bitmap", unit = "1")").partial);
  EXPECT_FALSE(read_small(R"(name = "Mode", type = "u1", role = "enum", unit = "1")").partial);
  EXPECT_FALSE(read_small(R"(type = "u2", excluded = true)").partial);
}

// Bit 8 does not fit into one byte, although Edition 3 has only eight of the nine fields.
TEST(DliReader, MeasuresThePresenceVectorByTheLastFieldOfTheEdition) {
  std::string fields = "{ n = 1, name = \"F1\", type = \"u1\", since = \"A\" },\n";
  for (int n = 2; n <= 9; ++n)
    fields += "{ n = " + std::to_string(n) + ", name = \"F" + std::to_string(n) + "\", type = \"u1\" },\n";
  auto text = replaced(small, R"({ n = 1, name = "Value", type = "u2" },)", fields);
  text = replaced(replaced(text, R"(["A"])", R"(["3", "A"])"), R"("A" = 1)", R"("3" = 1, "A" = 2)");
  EXPECT_EQ(refusal_of([&] { return read(text); }),
            "test.toml:5: presence_bytes: 1 bytes cannot mark field 9 of Edition 3");
}

TEST(DliReader, IgnoresFieldsOfEditionAInThePresenceVectorOfEdition3) {
  std::string fields;
  for (int n = 1; n <= 9; ++n)
    fields += "{ n = " + std::to_string(n) + ", name = \"F" + std::to_string(n) + "\", type = \"u1\"" +
              (n == 9 ? ", since = \"A\" },\n" : " },\n");
  auto text = replaced(small, R"({ n = 1, name = "Value", type = "u2" },)", fields);
  text = replaced(replaced(text, R"(["A"])", R"(["3", "A"])"), R"("A" = 1)", R"("3" = 1, "A" = 2)");
  EXPECT_EQ(read(text).messages.at(0).fields.size(), 9U);
}

TEST(DliReader, SortsWhatStandsInAnyOrderAndFile) {
  const TemporaryFolder folder;
  folder.write("a.toml", replaced(replaced(small, "100", "300"), "Small", "Late"));
  folder.write("b.toml", small);
  folder.write("notes.txt", "not a definition");
  const auto protocol = read_dli(folder.path());
  ASSERT_EQ(protocol.messages.size(), 2U);
  EXPECT_EQ(protocol.messages[0].number, 100U);
  EXPECT_EQ(protocol.messages[1].number, 300U);
  EXPECT_EQ(protocol.messages[0].source.file, folder.path() / "b.toml");
}

TEST(DliReader, RefusesAFolderWithoutDefinitions) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_of([&] { return read_dli(folder.path()); }),
            folder.path().string() + ": no *.toml definition files are here");
  EXPECT_EQ(refusal_of([&] { return read_dli(folder.path() / "missing"); }),
            (folder.path() / "missing").string() + ": no *.toml definition files are here");
}

}  // namespace
}  // namespace ponte::codegen
