#include "ponte/mavlink/field_value.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace ponte::mavlink {
namespace {

using testing::Attitude;
using testing::Everything;
using testing::Statustext;

constexpr const FieldInfo& whole = Everything::fields[0];
constexpr const FieldInfo& fine = Everything::fields[1];
constexpr const FieldInfo& triple = Everything::fields[2];
constexpr const FieldInfo& tiny = Everything::fields[3];

std::vector<std::byte> full_payload(const Everything& message) {
  std::array<std::byte, max_frame_size> out{};
  (void)encode(message, {}, out);
  const auto begin = out.begin() + header_size(Version::v2);
  return {begin, begin + Everything::info.full_length};
}

TEST(ReadElement, ReadsWhatTheTypedStructHolds) {
  const auto payload = full_payload({.whole = -5, .fine = 0.1, .triple = {1, 65535, 3}, .tiny = -128, .letter = 'z'});
  EXPECT_EQ(read_element(whole, payload), FieldValue{std::int64_t{-5}});
  EXPECT_EQ(read_element(fine, payload), FieldValue{0.1});
  EXPECT_EQ(read_element(triple, payload, 1), FieldValue{std::uint64_t{65535}});
  EXPECT_EQ(read_element(tiny, payload), FieldValue{std::int64_t{-128}});
  EXPECT_EQ(read_text(Everything::fields[4], payload), "z");
}

TEST(ReadElement, TakesMissingBytesForZeros) {
  const auto payload = bytes("40 e2");
  EXPECT_EQ(read_element(Attitude::fields[0], payload), FieldValue{std::uint64_t{0xE240}});
  EXPECT_EQ(read_element(Attitude::fields[6], payload), FieldValue{0.0F});
}

TEST(ReadText, EndsAtTheFirstNulOrWithThePayload) {
  EXPECT_EQ(read_text(Statustext::fields[1], bytes("06 41 42 00 43")), "AB");
  EXPECT_EQ(read_text(Statustext::fields[1], bytes("06 41 42")), "AB");
  EXPECT_EQ(read_text(Statustext::fields[1], bytes("06")), "");
  const std::vector<std::byte> all(Statustext::info.full_length, std::byte{0x41});
  EXPECT_EQ(read_text(Statustext::fields[1], all).size(), 50U);
}

TEST(WriteElement, WritesWhatReadElementReads) {
  auto payload = full_payload({});
  EXPECT_TRUE(write_element(whole, payload, 0, std::numeric_limits<std::int64_t>::min()));
  EXPECT_TRUE(write_element(triple, payload, 2, std::uint64_t{500}));
  EXPECT_TRUE(write_element(fine, payload, 0, 0.1));
  EXPECT_TRUE(write_element(tiny, payload, 0, -128.0));
  EXPECT_EQ(decode<Everything>(payload),
            (Everything{
                .whole = std::numeric_limits<std::int64_t>::min(), .fine = 0.1, .triple = {0, 0, 500}, .tiny = -128}));
}

TEST(WriteElement, RefusesWhatTheFieldCannotHoldAndLeavesItAlone) {
  auto payload = full_payload({.tiny = 5});
  const auto before = payload;
  EXPECT_EQ(write_element(tiny, payload, 0, std::int64_t{128}), fail(FieldWriteError::out_of_range));
  EXPECT_EQ(write_element(tiny, payload, 0, 128.0), fail(FieldWriteError::out_of_range));
  EXPECT_EQ(write_element(triple, payload, 0, std::int64_t{-1}), fail(FieldWriteError::out_of_range));
  EXPECT_EQ(write_element(whole, payload, 0, std::uint64_t{1} << 63U), fail(FieldWriteError::out_of_range));
  EXPECT_EQ(write_element(whole, payload, 0, 0x1p63), fail(FieldWriteError::out_of_range));
  EXPECT_EQ(write_element(whole, payload, 0, std::nan("")), fail(FieldWriteError::not_whole));
  EXPECT_EQ(write_element(tiny, payload, 0, 1.5F), fail(FieldWriteError::not_whole));
  EXPECT_EQ(payload, before);
}

TEST(WriteElement, NeverMakesAFiniteNumberInfinite) {
  std::vector<std::byte> payload(Attitude::info.full_length);
  EXPECT_EQ(write_element(Attitude::fields[1], payload, 0, 1e300), fail(FieldWriteError::out_of_range));
  EXPECT_TRUE(write_element(Attitude::fields[1], payload, 0, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(read_element(Attitude::fields[1], payload), FieldValue{std::numeric_limits<float>::infinity()});
}

TEST(WriteText, FillsTheRestWithNulAndRefusesWhatDoesNotFit) {
  std::vector<std::byte> payload(Statustext::info.full_length, std::byte{0xFF});
  EXPECT_TRUE(write_text(Statustext::fields[1], payload, "hello"));
  EXPECT_EQ(decode<Statustext>(payload).text, Text<50>{"hello"});
  EXPECT_EQ(write_text(Statustext::fields[1], payload, std::string(51, 'x')), fail(FieldWriteError::too_long));
  EXPECT_EQ(read_text(Statustext::fields[1], payload), "hello");
}

TEST(LabelOf, NamesListedValuesOnly) {
  constexpr std::array<EnumEntry, 2> entries{{{3, "THREE"}, {0x8000'0000'0000'0000, "HIGH"}}};
  const EnumInfo enumeration{"NUMBERS", false, entries};
  EXPECT_EQ(label_of(enumeration, 3), "THREE");
  EXPECT_EQ(label_of(enumeration, 0x8000'0000'0000'0000), "HIGH");
  EXPECT_EQ(label_of(enumeration, 0), "");
  EXPECT_EQ(label_of(enumeration, 4), "");
}

constexpr std::array<EnumEntry, 3> flag_entries{{{1, "ONE"}, {4, "FOUR"}, {5, "ONE_AND_FOUR"}}};
constexpr EnumInfo flags{"FLAGS", true, flag_entries};
constexpr EnumInfo choices{"CHOICES", false, flag_entries};

TEST(WordsOf, NamesTheBitsOfABitmaskAndKeepsTheOthersAsANumber) {
  EXPECT_EQ(words_of(flags, 4), "FOUR");
  EXPECT_EQ(words_of(flags, 5), "ONE_AND_FOUR");
  EXPECT_EQ(words_of(flags, 13), "ONE|FOUR|8");
  EXPECT_EQ(words_of(flags, 8), "");
  EXPECT_EQ(words_of(flags, 0), "");
}

TEST(WordsOf, NamesWholeValuesOnlyWhereBitsMeanNothing) {
  EXPECT_EQ(words_of(choices, 5), "ONE_AND_FOUR");
  EXPECT_EQ(words_of(choices, 13), "");
}

TEST(ValueOf, ReadsWhatWordsOfWrites) {
  for (const std::uint64_t value : {1U, 4U, 5U, 7U, 13U}) EXPECT_EQ(value_of(flags, words_of(flags, value)), value);
  EXPECT_EQ(value_of(choices, "FOUR"), 4U);
}

TEST(ValueOf, RefusesWordsThatMeanNothing) {
  for (const auto* words : {"", "TWO", "ONE|", "|", "ONE|TWO", "ONE|-1", "1x", "18446744073709551616"})
    EXPECT_EQ(value_of(flags, words), std::nullopt) << words;
  EXPECT_EQ(value_of(choices, "ONE|FOUR"), std::nullopt);
  EXPECT_EQ(value_of(choices, "4"), std::nullopt);
}

TEST(Find, GivesFieldsAndMessagesByName) {
  EXPECT_EQ(Everything::info.find("triple"), &triple);
  EXPECT_EQ(Everything::info.find("quadruple"), nullptr);
  EXPECT_EQ(testing::dialect.find("ATTITUDE"), &Attitude::info);
  EXPECT_EQ(testing::dialect.find("attitude"), nullptr);
}

}  // namespace
}  // namespace ponte::mavlink
