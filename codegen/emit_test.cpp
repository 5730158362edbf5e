#include "codegen/emit.hpp"

#include "codegen/dli_reader.hpp"
#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <gmock/gmock.h>

namespace ponte::codegen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view dialect =
    "<mavlink><enums><enum name='E'><entry name='E_A' value='2**63'/></enum>"
    "<enum name='F'><entry name='F_A' value='256'/></enum></enums><messages>"
    "<message id='1' name='MSG_A'><description>What the package says</description>"
    "<field type='uint8_t' name='x' units='m' invalid='0'>What the package says</field></message></messages></mavlink>";

constexpr std::string_view definition = R"([[message]]
number = 100
name = "First"
editions = ["A"]
presence_bytes = { "A" = 1 }
note = '''
ends in a backslash \
'''
fields = [
  { n = 1, name = "Value", type = "u1", enum = "mode", note = "a\nb = 7;" },
]

[[message]]
number = 200
name = "Known By Number Only"
editions = ["A"]

[enum.mode]
values = [
  { value = 1, label = "Low", note = "a\nb" },
  { value = 256, label = "High" },
  { value = 70000, label = "Higher" },
  { first = 80000, last = 90000, label = "Range" },
]
)";

Files dli_files() { return emit_dli(read_dli_text(definition, "test.toml")); }

std::vector<std::string> names_of(const Files& files) {
  std::vector<std::string> names;
  for (const auto& [path, text] : files) names.push_back(path.string());
  return names;
}

TEST(Emit, GivesEveryMavlinkMessageItsOwnHeader) {
  const auto files = emit_mavlink(read_mavlink_text(dialect, "small.xml"), false);
  EXPECT_THAT(names_of(files), ElementsAre("ponte/mavlink/small/all.hpp", "ponte/mavlink/small/dialect.cpp",
                                           "ponte/mavlink/small/dialect.hpp", "ponte/mavlink/small/enums.cpp",
                                           "ponte/mavlink/small/enums.hpp", "ponte/mavlink/small/msg_a.hpp"));
  for (const auto& [path, text] : files) EXPECT_THAT(text, StartsWith(std::string{generated_notice})) << path;
}

// clang-16 refuses a switch with the same case twice; g++ did not look before it was called.
TEST(Emit, GivesMessagesThatShareANumberOneCase) {
  constexpr std::string_view shared =
      "<mavlink wire='0.9'><messages><message id='7' name='SHORT'><field type='uint8_t' name='x'/></message>"
      "<message id='7' name='LONGER'><field type='uint16_t' name='x'/></message></messages></mavlink>";
  const auto all = emit_mavlink(read_mavlink_text(shared, "old.xml"), false).at("ponte/mavlink/old/all.hpp");
  EXPECT_THAT(all,
              HasSubstr("    case 7: f.template operator()<Short>(); f.template operator()<Longer>(); return true;\n"));
}

TEST(Emit, GivesADliMessageWithoutFieldsNoHeaderButAPlaceInTheCatalogue) {
  const auto files = dli_files();
  EXPECT_THAT(names_of(files), ElementsAre("ponte/dli/messages/all.hpp", "ponte/dli/messages/catalogue.cpp",
                                           "ponte/dli/messages/catalogue.hpp", "ponte/dli/messages/enumerations.cpp",
                                           "ponte/dli/messages/enumerations.hpp", "ponte/dli/messages/first.hpp"));
  EXPECT_THAT(files.at("ponte/dli/messages/catalogue.cpp"), HasSubstr("&First::info,\n    &known_by_number_only,\n"));
  for (const auto& [path, text] : files) EXPECT_THAT(text, StartsWith(std::string{generated_notice})) << path;
}

TEST(Emit, KeepsThePackagesWordsOutUnlessAsked) {
  const auto protocol = read_mavlink_text(dialect, "small.xml");
  for (const auto& [path, text] : emit_mavlink(protocol, false))
    EXPECT_THAT(text, Not(HasSubstr("What the package says"))) << path;
  EXPECT_THAT(emit_mavlink(protocol, true).at("ponte/mavlink/small/msg_a.hpp"),
              HasSubstr("/// What the package says\nstruct MsgA {"));
}

// Bit 63 does not fit into a signed literal; 256 not into the uint8_t that most enumerations need.
TEST(Emit, GivesEnumerationsATypeThatHoldsEveryValue) {
  const auto enums = emit_mavlink(read_mavlink_text(dialect, "small.xml"), false).at("ponte/mavlink/small/enums.hpp");
  EXPECT_THAT(enums, HasSubstr("enum E : std::uint64_t {\n  E_A = 9223372036854775808U,\n}"));
  EXPECT_THAT(enums, HasSubstr("enum F : std::uint16_t {\n  F_A = 256U,\n}"));
  const auto constants = dli_files().at("ponte/dli/messages/enumerations.hpp");
  EXPECT_THAT(constants, HasSubstr("inline constexpr std::uint8_t low = 1;"));
  EXPECT_THAT(constants, HasSubstr("inline constexpr std::uint16_t high = 256;"));
  EXPECT_THAT(constants, HasSubstr("inline constexpr std::uint32_t higher = 70000;"));
  EXPECT_THAT(constants, Not(HasSubstr("80000"))) << "a range is no constant";
}

// The second line of such a note would have been compiled.
TEST(Emit, KeepsANoteOfSeveralLinesInsideItsComment) {
  const auto files = dli_files();
  EXPECT_THAT(files.at("ponte/dli/messages/first.hpp"), HasSubstr("///< mode; a b = 7;\n"));
  EXPECT_THAT(files.at("ponte/dli/messages/first.hpp"), HasSubstr("ends in a backslash The values"));
  EXPECT_THAT(files.at("ponte/dli/messages/enumerations.hpp"), HasSubstr("low = 1;  ///< a b\n"));
}

TEST(Emit, KeepsARowOfTheReferenceInOneLine) {
  auto text = replaced(definition, R"("a\nb = 7;")", R"("either|or\nmore")");
  text += "[[group]]\nname = \"G\"\nfirst = 1\nlast = 199\nmessages_in_ed3 = 2\ned3_table = \"B1-1\"\n";
  const auto page = emit_dli_reference(read_dli_text(text, "test.toml"));
  EXPECT_THAT(page, HasSubstr("| 1 |  | Value | Unsigned 1 | [mode](#mode), either\\|or more |\n"));
}

TEST(Emit, CountsInTheReferenceWhatIsKnownOfEachEdition) {
  auto text = replaced(definition, "editions = [\"A\"]\n\n[enum", "editions = [\"3\", \"A\"]\n\n[enum");
  text += "[[group]]\nname = \"G\"\nfirst = 1\nlast = 999\nmessages_in_ed3 = 7\ned3_table = \"B1-1\"\n";
  EXPECT_THAT(
      emit_dli_reference(read_dli_text(text, "test.toml")),
      HasSubstr("Edition 3 has 7 messages here (table B1-1); 1 of them are known to us, and 1 of Edition A alone.\n"));
}

TEST(Emit, WritesAReferenceOfMavlinkMessages) {
  const auto protocol = read_mavlink_text(replaced(dialect, "units='m'", "units='m|s' enum='E'"), "small.xml");
  const auto page = emit_mavlink_reference(protocol, false);
  EXPECT_THAT(page, HasSubstr("# MAVLink messages: small\n\n1 messages, 2 enumerations.\n"));
  EXPECT_THAT(page, HasSubstr("### MSG_A (1)\n\n1 bytes, with extensions 1.\n"));
  EXPECT_THAT(page, HasSubstr("| x | uint8_t | m\\|s | [E](#E); 0 means unknown |\n"));
  EXPECT_THAT(page, HasSubstr("### F\n\n- 256: F_A\n"));
  EXPECT_THAT(page, Not(HasSubstr("What the package says")));
  EXPECT_THAT(emit_mavlink_reference(protocol, true), HasSubstr("\n\nWhat the package says\n\n1 bytes"));
}

TEST(UnsignedTypeFor, TakesTheSmallestThatFits) {
  EXPECT_EQ(unsigned_type_for(0), "std::uint8_t");
  EXPECT_EQ(unsigned_type_for(0xFF), "std::uint8_t");
  EXPECT_EQ(unsigned_type_for(0x100), "std::uint16_t");
  EXPECT_EQ(unsigned_type_for(0x1'0000), "std::uint32_t");
  EXPECT_EQ(unsigned_type_for(0x1'0000'0000), "std::uint64_t");
}

}  // namespace
}  // namespace ponte::codegen
