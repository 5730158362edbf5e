#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <fmt/format.h>

namespace ponte::definitions {
namespace {

std::string refusal(std::string_view text) {
  return refusal_of([&] { return read_mavlink_text(text, "test.xml"); });
}

/// Refusal of a message whose fields begin on line 4.
std::string refusal_of_fields(std::string_view fields) {
  return refusal(
      fmt::format("<mavlink>\n<messages>\n<message id='7' name='A'>\n{}</message>\n</messages></mavlink>", fields));
}

/// Refusal of enums that begin on line 2.
std::string refusal_of_enums(std::string_view enums) {
  return refusal(fmt::format("<mavlink>\n<enums>{}</enums></mavlink>", enums));
}

TEST(MavlinkRefusals, SayWhereTheXmlBreaks) {
  EXPECT_EQ(refusal("<mavlink>\n<messages>\n</mavlink>"), "test.xml:3: not well-formed XML: Start-end tags mismatch");
  EXPECT_EQ(refusal(""), "test.xml:1: not well-formed XML: No document element found");
  EXPECT_EQ(refusal("int main() {}"), "test.xml:1: not well-formed XML: No document element found");
}

TEST(MavlinkRefusals, NameTheRootThatIsExpected) {
  EXPECT_EQ(refusal("<mavlinks></mavlinks>"), "test.xml:1: the root element is not <mavlink>");
}

TEST(MavlinkRefusals, KeepTheRulesOfTheWireFormat) {
  EXPECT_EQ(refusal("<mavlink wire='0.8'/>"), "test.xml:1: wire is '0.8', expected 0.9 or none");
  const auto old = [](std::string_view messages) {
    return refusal(fmt::format("<mavlink wire='0.9'><messages>\n{}</messages></mavlink>", messages));
  };
  EXPECT_EQ(old("<message id='256' name='A'><field type='char' name='x'/></message>"),
            "test.xml:2: id of A must be 0 to 255");
  EXPECT_EQ(old("<message id='1' name='A'><field type='char' name='x'/><extensions/></message>"),
            "test.xml:2: MAVLink 0.9 has no extension fields");
  EXPECT_EQ(old("<message id='1' name='A'><field type='char' name='x'/></message>\n"
                "<message id='1' name='B'><field type='int8_t' name='y'/></message>"),
            "test.xml:3: message B has the id 1 of A, defined at test.xml:2");
}

TEST(MavlinkRefusals, NameTheTypeThatIsNotOne) {
  EXPECT_EQ(refusal_of_fields("<field type='uint24_t' name='x'/>"),
            "test.xml:4: type 'uint24_t' of x is not a MAVLink type");
  EXPECT_EQ(refusal_of_fields("<field type='bool' name='x'/>"), "test.xml:4: type 'bool' of x is not a MAVLink type");
  EXPECT_EQ(refusal_of_fields("\n<field type='[4]' name='x'/>"), "test.xml:5: type '[4]' of x is not a MAVLink type");
}

TEST(MavlinkRefusals, BoundTheLengthOfAnArray) {
  for (const auto* type : {"char[0]", "char[256]", "char[-1]", "char[", "char[]", "char[4", "char[4]x", "char[4 ]",
                           "char[2**]", "char[2**2**2]", "char[0x]"})
    EXPECT_EQ(refusal_of_fields(fmt::format("<field type='{}' name='x'/>", type)),
              fmt::format("test.xml:4: type '{}' of x: the array length must be 1 to 255", type));
}

TEST(MavlinkRefusals, NameTheFieldThatStandsTwice) {
  EXPECT_EQ(refusal_of_fields("<field type='int8_t' name='x'/>\n<field type='int8_t' name='x'/>"),
            "test.xml:5: A has two fields named x");
}

TEST(MavlinkRefusals, CountFieldsThatCppCannotTellApartAsTwice) {
  EXPECT_EQ(refusal_of_fields("<field type='int8_t' name='x'/>\n<field type='int8_t' name='X'/>"),
            "test.xml:5: A has two fields named X");
}

TEST(MavlinkRefusals, NameTheEnumThatIsMissing) {
  EXPECT_EQ(refusal_of_fields("<field type='int8_t' name='x' enum='MAV_NOWHERE'/>"),
            "test.xml:4: enum MAV_NOWHERE of x is not defined");
}

TEST(MavlinkRefusals, KeepAPayloadWithinAFrame) {
  EXPECT_EQ(refusal_of_fields("<field type='uint8_t[254]' name='x'/><field type='uint16_t' name='y'/>"),
            "test.xml:3: A needs 256 bytes, more than the 255 of a frame");
  EXPECT_EQ(refusal_of_fields("<field type='uint8_t[254]' name='x'/><field type='uint8_t' name='y'/>"),
            "(nothing was refused)");
}

TEST(MavlinkRefusals, CountExtensionsIntoThePayload) {
  EXPECT_EQ(refusal_of_fields("<field type='uint8_t[255]' name='x'/><extensions/><field type='uint8_t' name='y'/>"),
            "test.xml:3: A needs 256 bytes, more than the 255 of a frame");
}

TEST(MavlinkRefusals, WantAField) { EXPECT_EQ(refusal_of_fields(""), "test.xml:3: A has no fields"); }

TEST(MavlinkRefusals, NameTheAttributeThatIsMissing) {
  EXPECT_EQ(refusal_of_fields("<field type='int8_t'/>"), "test.xml:4: <field> needs a name");
  EXPECT_EQ(refusal_of_fields("<field name='x'/>"), "test.xml:4: <field> needs a type");
  EXPECT_EQ(refusal("<mavlink><messages>\n<message name='A'/></messages></mavlink>"),
            "test.xml:2: <message> needs a id");
  EXPECT_EQ(refusal("<mavlink><messages>\n<message id='1' name=''/></messages></mavlink>"),
            "test.xml:2: <message> needs a name");
  EXPECT_EQ(refusal_of_enums("<enum/>"), "test.xml:2: <enum> needs a name");
  EXPECT_EQ(refusal_of_enums("<enum name='E'><entry value='1'/></enum>"), "test.xml:2: <entry> needs a name");
}

TEST(MavlinkRefusals, BoundTheId) {
  for (const auto* id : {"16777216", "-1", "x", "18446744073709551616"})
    EXPECT_EQ(refusal(fmt::format("<mavlink><messages><message id='{}' name='A'/></messages></mavlink>", id)),
              "test.xml:1: id of A must be 0 to 16777215");
}

TEST(MavlinkRefusals, NameTheIdThatIsTaken) {
  EXPECT_EQ(refusal("<mavlink><messages>\n<message id='1' name='A'/>\n<message id='1' name='B'/></messages></mavlink>"),
            "test.xml:3: message B has the id 1 of A, defined at test.xml:2");
}

// One generated file would have been overwritten by the other without a word.
TEST(MavlinkRefusals, NameTheMessageNameThatIsTaken) {
  const auto pair = [](std::string_view second) {
    return refusal(
        fmt::format("<mavlink><messages>\n<message id='1' name='A1'><field type='int8_t' name='x'/></message>\n"
                    "<message id='2' name='{}'><field type='int8_t' name='x'/></message></messages></mavlink>",
                    second));
  };
  EXPECT_EQ(pair("A1"), "test.xml:3: the name A1 of message 2 is taken by message 1");
  EXPECT_EQ(pair("A_1"), "test.xml:3: the name A_1 of message 2 is taken by message 1");
  EXPECT_EQ(pair("A2"), "(nothing was refused)");
}

TEST(MavlinkRefusals, KeepMessagesFromReplacingTheOtherGeneratedFiles) {
  for (const auto* name : {"ALL", "Dialect", "ENUMS", "--", "A B"})
    EXPECT_EQ(refusal(fmt::format("<mavlink><messages>\n<message id='1' name='{}'/></messages></mavlink>", name)),
              fmt::format("test.xml:2: '{}' cannot be the name of a message", name));
}

TEST(MavlinkRefusals, WantNamesThatCanStandInCode) {
  EXPECT_EQ(refusal_of_fields("<field type='int8_t' name='--'/>"), "test.xml:4: '--' cannot be the name of a field");
  EXPECT_EQ(refusal_of_fields("<field type='int8_t' name='a b'/>"), "test.xml:4: 'a b' cannot be the name of a field");
  EXPECT_EQ(refusal_of_enums("<enum name='A B'/>"), "test.xml:2: enum name 'A B' is not an identifier");
  EXPECT_EQ(refusal_of_enums("<enum name='E'>\n<entry name='1ST'/></enum>"),
            "test.xml:3: entry name '1ST' is not an identifier");
  EXPECT_EQ(refusal_of_enums("<enum name='E'><entry name='int'/></enum>"),
            "test.xml:2: entry name 'int' is not an identifier");
  EXPECT_EQ(refusal_of([] { return read_mavlink_text("<mavlink/>", "--.xml"); }),
            "--.xml: the file name must have a letter or digit, to name the dialect");
}

TEST(MavlinkRefusals, NameTheEntryThatHasTwoMeanings) {
  EXPECT_EQ(refusal_of_enums("<enum name='E'><entry name='E_A' value='1'/>\n<entry name='E_A' value='2'/></enum>"),
            "test.xml:3: E_A is 2 of E here, and 1 of E elsewhere");
  EXPECT_EQ(refusal_of_enums(
                "<enum name='E'><entry name='X' value='1'/></enum>\n<enum name='F'><entry name='X' value='1'/></enum>"),
            "test.xml:3: X is 1 of F here, and 1 of E elsewhere");
}

TEST(MavlinkRefusals, WantANumberAsTheValueOfAnEntry) {
  for (const auto* value : {"-1", "x", "0x", "0xG", "0b2", "2**64", "2**", "1.5", "18446744073709551616"})
    EXPECT_EQ(refusal_of_enums(fmt::format("<enum name='E'><entry name='E_A' value='{}'/></enum>", value)),
              fmt::format("test.xml:2: value '{}' of E_A is not a number", value));
}

// The reader followed 2**2**2**... by recursion, so a long one exhausted the stack.
TEST(MavlinkRefusals, EndOnAnEndlessPower) {
  std::string value;
  for (int i = 0; i < 200'000; ++i) value += "2**";
  EXPECT_EQ(refusal_of_enums("<enum name='E'><entry name='E_A' value='" + value + "1'/></enum>"),
            "test.xml:2: value '" + value + "1' of E_A is not a number");
}

TEST(MavlinkRefusals, NameTheMessageThatAnExtensionMisses) {
  EXPECT_EQ(refusal("<mavlink><messages>\n<message id='1' name='A' extend='true'/></messages></mavlink>"),
            "test.xml:2: extends A (1), which is not defined");
  EXPECT_EQ(refusal("<mavlink><messages><message id='1' name='B'><field type='int8_t' name='x'/></message>\n"
                    "<message id='1' name='A' extend='true'/></messages></mavlink>"),
            "test.xml:2: extends A (1), which is not defined");
}

}  // namespace
}  // namespace ponte::definitions
