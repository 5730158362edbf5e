#include "codegen/dli_reader.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace ponte::codegen {
namespace {

using testing::StartsWith;

constexpr std::string_view definition = R"([[message]]
number = 100
name = "Small"
editions = ["3", "A"]
presence_bytes = { "3" = 1, "A" = 1 }
confidence = "standard"
fields = [
  { n = 1, name = "Length", type = "u1" },
  { n = 2, name = "Mode", type = "u1", enum = "mode" },
]

[enum.mode]
confidence = "inferred"
values = [
  { value = 0, label = "Off" },
  { value = 1, label = "On" },
]

[[group]]
name = "Group"
first = 0
last = 1999
messages_in_ed3 = 3
ed3_table = "B1-6"
)";

std::string refusal(std::string_view text) {
  return refusal_of([&] { return read_dli_text(text, "test.toml"); });
}

/// Refusal of the definition in which `by` stands instead of `old`.
std::string refusal_with(std::string_view old, std::string_view by) { return refusal(replaced(definition, old, by)); }

/// Refusal of another second field.
std::string refusal_of_field(std::string_view keys) {
  return refusal_with(R"(name = "Mode", type = "u1", enum = "mode")", keys);
}

TEST(DliRefusals, SpareTheDefinitionThatTheOthersChange) { EXPECT_EQ(refusal(definition), "(nothing was refused)"); }

TEST(DliRefusals, SayWhereTheTomlBreaks) {
  EXPECT_THAT(refusal_with("number = 100", "number = = 100"), StartsWith("test.toml:2: Error while parsing"));
  EXPECT_THAT(refusal_with("number = 100", "number = 100\nnumber = 1"), StartsWith("test.toml:3: Error while parsing"));
  EXPECT_THAT(refusal_with("[enum.mode]", "[enum.mode"), StartsWith("test.toml:12: Error while parsing"));
  EXPECT_EQ(refusal_with("Small", "\xFF"), "test.toml:3: Encountered invalid utf-8 sequence");
}

// toml++ 3.3 follows the dots of a key by recursion: a line of a million overflowed the stack.
TEST(DliRefusals, BoundALineBeforeItIsParsed) {
  std::string dots = "a";
  for (int i = 0; i < 1'000'000; ++i) dots += ".a";
  EXPECT_EQ(refusal("\n[" + dots + "]\n"), "test.toml:2: the line is longer than 4000 characters");
  EXPECT_EQ(refusal(dots + " = 1"), "test.toml:1: the line is longer than 4000 characters");
}

TEST(DliRefusals, NameTheKeyThatIsNotKnown) {
  EXPECT_EQ(refusal_with("number = 100", "number = 100\nnumbre = 1"),
            "test.toml:3: numbre: is not a key that is known here");
  EXPECT_EQ(refusal_of_field(R"(name = "Mode", type = "u1", enmu = "mode")"),
            "test.toml:9: enmu: is not a key that is known here");
  EXPECT_EQ(refusal_with(R"("A" = 1)", R"("A" = 1, "B" = 1)"), "test.toml:5: B: is not a key that is known here");
  EXPECT_EQ(refusal_with("confidence = \"inferred\"", "bitmask = true"),
            "test.toml:13: bitmask: is not a key that is known here");
  EXPECT_EQ(refusal_with(R"(label = "On")", R"(label = "On", text = "On")"),
            "test.toml:16: text: is not a key that is known here");
  EXPECT_EQ(refusal_with("first = 0", "first = 0\nfrom = 1"), "test.toml:22: from: is not a key that is known here");
  EXPECT_EQ(refusal_with("[[message]]", "[[mesage]]"), "test.toml:1: mesage: is not a key that is known here");
}

TEST(DliRefusals, WantANumberInItsRange) {
  for (const auto* number : {"0", "65001", "-1", "100.0", "\"100\"", "true"})
    EXPECT_EQ(refusal_with("number = 100", fmt::format("number = {}", number)),
              "test.toml:2: number: must be a whole number from 1 to 65000");
  EXPECT_EQ(refusal_with("number = 100\n", ""), "test.toml:1: number: must be a whole number from 1 to 65000");
  EXPECT_EQ(refusal_with("confidence", "number_ed2 = 0\nconfidence"),
            "test.toml:6: number_ed2: must be a whole number from 1 to 65000");
  EXPECT_EQ(refusal_with("confidence", "latency_ms = 60001\nconfidence"),
            "test.toml:6: latency_ms: must be a whole number from 1 to 60000");
}

TEST(DliRefusals, WantAText) {
  EXPECT_EQ(refusal_with("name = \"Small\"\n", ""), "test.toml:1: name: a text is needed here");
  EXPECT_EQ(refusal_with("\"Small\"", "\"\""), "test.toml:3: name: a text is needed here");
  EXPECT_EQ(refusal_with("\"Small\"", "7"), "test.toml:3: name: must be a text");
  EXPECT_EQ(refusal_with("confidence", "note = [\"a\"]\nconfidence"), "test.toml:6: note: must be a text");
  EXPECT_EQ(refusal_with("label = \"On\"", "label = 1"), "test.toml:16: label: must be a text");
}

TEST(DliRefusals, WantANameThatCppCanHave) {
  EXPECT_EQ(refusal_with("\"Small\"", "\"--\""), "test.toml:3: name: must have a letter or digit");
  EXPECT_EQ(refusal_of_field(R"(name = "--", type = "u1")"), "test.toml:9: name: must have a letter or digit");
  EXPECT_EQ(refusal_with("\"On\"", "\"%\""), "test.toml:16: label: must have a letter or digit");
  EXPECT_EQ(refusal_with("confidence", "key = \"Small\"\nconfidence"), "test.toml:6: key: must be snake_case");
  EXPECT_EQ(refusal_with("[enum.mode]", "[enum.Mode]"), "test.toml:12: Mode: must be snake_case");
  EXPECT_EQ(refusal_with("[enum.mode]", "[enum.\"a b\"]"), "test.toml:12: a b: must be snake_case");
  EXPECT_EQ(refusal_with("[enum.mode]", "[enum.\"\"]"), "test.toml:12: : must be snake_case");
}

TEST(DliRefusals, KeepMessagesFromReplacingTheOtherGeneratedFiles) {
  EXPECT_EQ(refusal_with("\"Small\"", "\"All\""), "test.toml:3: name: 'all' is the name of another generated file");
  EXPECT_EQ(refusal_with("confidence", "key = \"catalogue\"\nconfidence"),
            "test.toml:6: key: 'catalogue' is the name of another generated file");
}

TEST(DliRefusals, WantAnEditionThatWeKnow) {
  EXPECT_EQ(refusal_with(R"(["3", "A"])", R"(["3", "2"])"), "test.toml:4: editions: '2' is not one of 3, A");
  EXPECT_EQ(refusal_with(R"(["3", "A"])", "[]"), "test.toml:4: editions: name at least one of 3, A");
  EXPECT_EQ(refusal_with("editions = [\"3\", \"A\"]\n", ""), "test.toml:1: editions: name at least one of 3, A");
  EXPECT_EQ(refusal_with(R"(["3", "A"])", "\"3\""), "test.toml:4: editions: must be a list of texts");
  EXPECT_EQ(refusal_with(R"(["3", "A"])", "[3]"), "test.toml:4: editions: must be a list of texts");
}

TEST(DliRefusals, WantAWordOfTheList) {
  EXPECT_EQ(refusal_with("\"standard\"", "\"certain\""),
            "test.toml:6: confidence: is 'certain', expected one of standard, single-source, inferred, unknown");
  EXPECT_EQ(refusal_with("confidence = ", "confidence_ed3 = \"sure\"\nconfidence = "),
            "test.toml:6: confidence_ed3: is 'sure', expected one of standard, single-source, inferred, unknown");
  EXPECT_EQ(refusal_with("\"inferred\"", "\"guessed\""),
            "test.toml:13: confidence: is 'guessed', expected one of standard, single-source, inferred, unknown");
  EXPECT_EQ(refusal_with("confidence", "direction = \"up\"\nconfidence"),
            "test.toml:6: direction: is 'up', expected one of CUCS->VSM, VSM->CUCS, both");
  EXPECT_EQ(refusal_with("confidence", "exchange = \"poll\"\nconfidence"),
            "test.toml:6: exchange: is 'poll', expected one of push, pull, push/pull");
  EXPECT_EQ(refusal_of_field(R"(name = "Mode", type = "u1", role = "flag")"),
            "test.toml:9: role: is 'flag', expected one of enum, bitmap, id, table, country");
  EXPECT_EQ(refusal_of_field(R"(name = "Mode", type = "u1", since = "4")"),
            "test.toml:9: since: is '4', expected one of A");
  EXPECT_EQ(refusal_of_field(R"(name = "Mode", type = "u1", guess = ["unit"])"),
            "test.toml:9: guess: may name \"type\" and \"scale\"");
}

TEST(DliRefusals, WantLevelsOfInteroperability) {
  for (const auto* levels : {"[0]", "[6]", "[\"2\"]", "2"})
    EXPECT_EQ(refusal_with("confidence", fmt::format("loi = {}\nconfidence", levels)),
              "test.toml:6: loi: must be a list of whole numbers from 1 to 5");
}

TEST(DliRefusals, WantTablesWhereTablesStand) {
  EXPECT_EQ(refusal("message = 1"), "test.toml:1: message: must be a list of tables");
  EXPECT_EQ(refusal("message = [1]"), "test.toml:1: message: must be a list of tables");
  EXPECT_EQ(refusal("enum = 1"), "test.toml:1: enum: must be a table");
  EXPECT_EQ(refusal("[enum]\nmode = 1"), "test.toml:2: mode: must be a table");
  EXPECT_EQ(refusal_with(R"({ "3" = 1, "A" = 1 })", "1"), "test.toml:5: presence_bytes: must be a table");
}

TEST(DliRefusals, NameTheTypeThatIsNotOne) {
  for (const auto* type :
       {"u0", "u6", "i0", "i6", "b0", "b5", "f8", "f", "c0", "c256", "u", "u1x", "x", "u-1", "u99999999999999999999"})
    EXPECT_EQ(
        refusal_of_field(fmt::format(R"(name = "Mode", type = "{}")", type)),
        fmt::format("test.toml:9: type: is '{}', expected u1 to u5, i1 to i5, b1 to b4, f4, c1 to c255 or c", type));
  EXPECT_EQ(refusal_of_field(R"(name = "Mode")"), "test.toml:9: type: a text is needed here");
}

TEST(DliRefusals, NumberFieldsWithoutGaps) {
  EXPECT_EQ(refusal_with("n = 2", "n = 3"), "test.toml:9: n: is 3, expected 2: fields are numbered without gaps");
  EXPECT_EQ(refusal_with("n = 2", "n = 1"), "test.toml:9: n: is 1, expected 2: fields are numbered without gaps");
  EXPECT_EQ(refusal_with("n = 2", "n = 65"), "test.toml:9: n: must be a whole number from 1 to 64");
  EXPECT_EQ(refusal_with("n = 2, ", ""), "test.toml:9: n: must be a whole number from 1 to 64");
}

TEST(DliRefusals, NameTheFieldThatStandsTwice) {
  EXPECT_EQ(refusal_with("\"Mode\"", "\"length\""), "test.toml:9: name: 'length' stands twice in #100");
}

TEST(DliRefusals, WantAPresenceVectorThatIsWideEnough) {
  std::string fields;
  for (int n = 2; n <= 9; ++n) fields += fmt::format("{{ n = {}, name = \"F{}\", type = \"u1\" }},", n, n);
  EXPECT_EQ(refusal_with(R"({ n = 2, name = "Mode", type = "u1", enum = "mode" },)", fields),
            "test.toml:5: presence_bytes: 1 bytes cannot mark field 9 of Edition 3");
  EXPECT_EQ(refusal_with("\"A\" = 1", "\"A\" = 9"), "test.toml:5: A: must be a whole number from 1 to 8");
  EXPECT_EQ(refusal_with("\"3\" = 1", "\"3\" = 0"), "test.toml:5: 3: must be a whole number from 1 to 8");
}

TEST(DliRefusals, WantAPresenceVectorForEachEditionThatHasFields) {
  EXPECT_EQ(refusal_with(R"("3" = 1, )", ""), "test.toml:5: presence_bytes: Edition 3 is missing");
  EXPECT_EQ(refusal_with("presence_bytes = { \"3\" = 1, \"A\" = 1 }\n", ""),
            "test.toml:1: presence_bytes: Edition 3 is missing");
}

TEST(DliRefusals, NameTheEnumerationThatIsMissing) {
  EXPECT_EQ(refusal_with("enum = \"mode\"", "enum = \"modes\""), "test.toml:9: enum: 'modes' is not defined");
}

TEST(DliRefusals, GiveNoScaleOrRoleToWhatIsNoInteger) {
  for (const auto* type : {"c8", "b2", "f4"}) {
    EXPECT_EQ(refusal_of_field(fmt::format(R"(name = "Mode", type = "{}", scale = 0.5)", type)),
              "test.toml:9: scale: only an integer has a scale");
    EXPECT_EQ(refusal_of_field(fmt::format(R"(name = "Mode", type = "{}", role = "id")", type)),
              "test.toml:9: role: only an integer can be an enum, bitmap or id");
  }
}

TEST(DliRefusals, WantAScaleAboveZero) {
  for (const auto* scale : {"0", "0.0", "-1", "nan", "inf", "1000001", "\"1\"", "true"})
    EXPECT_EQ(refusal_of_field(fmt::format(R"(name = "Mode", type = "u1", scale = {})", scale)),
              "test.toml:9: scale: must be a number above 0, at most 1000000");
}

TEST(DliRefusals, WantAFlag) {
  EXPECT_EQ(refusal_of_field(R"(type = "u1", excluded = 1)"), "test.toml:9: excluded: must be true or false");
  EXPECT_EQ(refusal_with("values", "bitmap = \"yes\"\nvalues"), "test.toml:14: bitmap: must be true or false");
}

TEST(DliRefusals, LeaveNoMeaningOnAnExcludedField) {
  EXPECT_EQ(refusal_of_field(R"(type = "u1", excluded = true, name = "Mode")"),
            "test.toml:9: name: is not a key that is known here");
}

TEST(DliRefusals, WantTheLengthOfATextInAnEarlierUnsignedField) {
  constexpr auto expected = "test.toml:9: length_from: must name an earlier field that is an unsigned integer";
  EXPECT_EQ(refusal_of_field(R"(name = "Text", type = "c")"),
            "test.toml:9: length_from: must be a whole number from 1 to 64");
  EXPECT_EQ(refusal_of_field(R"(name = "Text", type = "c", length_from = 2)"), expected);
  EXPECT_EQ(refusal_of_field(R"(name = "Text", type = "c", length_from = 64)"), expected);
  EXPECT_EQ(refusal_of_field(R"(name = "Text", type = "c8", length_from = 1)"),
            "test.toml:9: length_from: is not a key that is known here");
  for (const auto* first :
       {R"(name = "Length", type = "f4")", R"(name = "Length", type = "i1")", R"(type = "u1", excluded = true)"})
    EXPECT_EQ(refusal(replaced(replaced(definition, R"(name = "Length", type = "u1")", first),
                               R"(name = "Mode", type = "u1", enum = "mode")",
                               R"(name = "Text", type = "c", length_from = 1)")),
              expected)
        << first;
}

TEST(DliRefusals, WantValuesThatAscend) {
  EXPECT_EQ(refusal_with("value = 1,", "value = 0,"), "test.toml:16: value: values must ascend");
  EXPECT_EQ(refusal_with("value = 1,", "first = 0, last = 3,"), "test.toml:16: first: values must ascend");
  EXPECT_EQ(refusal_with("value = 1,", "first = 3, last = 2,"), "test.toml:16: last: is below first");
  EXPECT_EQ(refusal_with("value = 1,", "value = -1,"),
            "test.toml:16: value: must be a whole number from 0 to 4294967295");
  EXPECT_EQ(refusal_with("value = 1,", "value = 4294967296,"),
            "test.toml:16: value: must be a whole number from 0 to 4294967295");
  EXPECT_EQ(refusal_with("value = 1,", "first = 1,"),
            "test.toml:16: last: must be a whole number from 0 to 4294967295");
}

TEST(DliRefusals, WantAGroupThatEndsAfterItBegins) {
  EXPECT_EQ(refusal_with("first = 0", "first = 2000"), "test.toml:22: last: is below first");
}

constexpr std::string_view second = R"([[message]]
number = 200
name = "Second"
editions = ["A"]
)";

TEST(DliRefusals, NameTheNumberThatIsTaken) {
  EXPECT_EQ(refusal(std::string{definition} + replaced(second, "200", "100")),
            "test.toml:25: number: 100 is defined twice");
}

// "small" and "Small" are one file; "a_1" and "a1" are one struct.
TEST(DliRefusals, NameTheKeyThatIsTaken) {
  EXPECT_EQ(refusal(std::string{definition} + replaced(second, "Second", "SMALL")),
            "test.toml:25: key: 'small' is taken by another message");
  EXPECT_EQ(refusal(replaced(definition, "Small", "A 1") + replaced(second, "Second", "A1")),
            "test.toml:25: key: 'a1' is taken by another message");
}

TEST(DliRefusals, NameTheEnumerationThatTwoFilesDefine) {
  const TemporaryFolder folder;
  folder.write("a.toml", definition);
  const auto twin = folder.write("b.toml", "\n[enum.mode]\n");
  EXPECT_EQ(refusal_of([&] { return read_dli(folder.path()); }), twin.string() + ":2: enum: 'mode' is defined twice");
}

}  // namespace
}  // namespace ponte::codegen
