#include "ponte/dli/datagram.hpp"

#include "ponte/dli/worked_examples.hpp"
#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace ponte::dli {
namespace {

using namespace worked_examples;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// What a reader found: the offset of a good message, or an error.
using Finding = std::variant<std::size_t, DatagramError>;

std::vector<Finding> read_all(Bytes payload, const Profile& profile, DatagramCounters& counters) {
  std::vector<Finding> findings;
  DatagramReader reader{payload, profile, counters};
  while (const auto item = reader.next()) {
    if (*item)
      findings.emplace_back(static_cast<std::size_t>((*item)->whole.data() - payload.data()));
    else
      findings.emplace_back(item->error());
  }
  return findings;
}

Finding good(std::size_t offset) { return offset; }
Finding bad(WrapperError reason, std::size_t offset) { return DatagramError{reason, offset}; }

std::string together(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const auto part : parts) text.append(part).append(" ");
  return text;
}

struct DatagramReaderTest : testing::Test {
  std::vector<Finding> read(Bytes payload) { return read_all(payload, profile, counters); }

  Profile profile;
  DatagramCounters counters;
};

TEST_F(DatagramReaderTest, FindsEveryMessageOfADatagram) {
  const auto payload = bytes(together({attitude_with_sum16, all_fields_with_sum16, attitude_without_checksum}));
  EXPECT_THAT(read(payload), ElementsAre(good(0), good(38), good(102)));
  DatagramCounters expected;
  expected.datagrams = 1;
  expected.messages = 3;
  EXPECT_EQ(counters, expected);
}

TEST_F(DatagramReaderTest, TellsAtEveryShorterLengthWhatIsMissing) {
  const auto payload = bytes(together({attitude_with_sum16, attitude_with_sum32}));
  for (std::size_t size = 0; size < 16; ++size)
    EXPECT_THAT(read(Bytes{payload}.first(size)), ElementsAre(bad(WrapperError::truncated, 0))) << "at " << size;
  for (std::size_t size = 16; size < 38; ++size)
    EXPECT_THAT(read(Bytes{payload}.first(size)), ElementsAre(bad(WrapperError::beyond_end, 0))) << "at " << size;
  EXPECT_THAT(read(Bytes{payload}.first(38)), ElementsAre(good(0)));
  for (std::size_t size = 39; size < 54; ++size)
    EXPECT_THAT(read(Bytes{payload}.first(size)), ElementsAre(good(0), bad(WrapperError::stray_bytes, 38)))
        << "at " << size;
  for (std::size_t size = 54; size < 78; ++size)
    EXPECT_THAT(read(Bytes{payload}.first(size)), ElementsAre(good(0), bad(WrapperError::beyond_end, 38)))
        << "at " << size;
  EXPECT_THAT(read(payload), ElementsAre(good(0), good(38)));
  EXPECT_EQ(counters.count_of(WrapperError::truncated), 16U);
  EXPECT_EQ(counters.count_of(WrapperError::beyond_end), 22U + 24U);
  EXPECT_EQ(counters.count_of(WrapperError::stray_bytes), 15U);
  EXPECT_EQ(counters.datagrams, 79U);
  EXPECT_EQ(counters.messages, 1U + 15U + 24U + 2U);
}

TEST_F(DatagramReaderTest, KeepsTheGoodMessagesAroundABadChecksum) {
  auto payload = bytes(together({attitude_with_sum16, attitude_with_sum16, attitude_with_sum32}));
  payload[38 + 20] ^= std::byte{0x40};
  EXPECT_THAT(read(payload), ElementsAre(good(0), bad(WrapperError::bad_checksum, 38), good(76)));
  EXPECT_EQ(counters.count_of(WrapperError::bad_checksum), 1U);
  EXPECT_EQ(counters.messages, 2U);
}

TEST_F(DatagramReaderTest, StepsOverAMessageWithTheUnassignedChecksumCode) {
  auto payload = bytes(together({attitude_with_sum32, attitude_with_sum16}));
  payload[15] = std::byte{0xC0};
  EXPECT_THAT(read(payload), ElementsAre(bad(WrapperError::unassigned_checksum, 0), good(40)));
  EXPECT_EQ(counters.unexamined, 0U);
  profile.accept_unassigned_checksum = true;
  EXPECT_THAT(read(payload), ElementsAre(good(0), good(40)));
  EXPECT_EQ(counters.unexamined, 1U);
}

TEST_F(DatagramReaderTest, GivesUpWhereALengthIsNotCredible) {
  for (const unsigned length : {0U, 529U, 0xFFFFU}) {
    auto payload = bytes(together({attitude_with_sum16, attitude_with_sum16, attitude_with_sum16}));
    store_be(&payload[38 + 2], static_cast<std::uint16_t>(length));
    EXPECT_THAT(read(payload), ElementsAre(good(0), bad(WrapperError::bad_length, 38))) << length;
  }
  EXPECT_EQ(counters.count_of(WrapperError::bad_length), 3U);
}

TEST_F(DatagramReaderTest, CountsAnotherVersionAndTakesTheMessage) {
  auto payload = bytes(attitude_without_checksum);
  payload[14] = std::byte{32};
  EXPECT_THAT(read(payload), ElementsAre(good(0)));
  EXPECT_EQ(counters.other_version, 1U);
  profile = Profile{Edition::ed_a};
  EXPECT_THAT(read(payload), ElementsAre(good(0)));
  EXPECT_EQ(counters.other_version, 1U);
}

TEST_F(DatagramReaderTest, CountsAChecksumLengthThatTheSizeContradicts) {
  auto claims_none = bytes(attitude_with_sum16);
  claims_none[15] = std::byte{0x00};
  EXPECT_THAT(read(claims_none), ElementsAre(good(0), bad(WrapperError::stray_bytes, 36)));
  EXPECT_EQ(counters.checksum_length_mismatch, 1U);

  auto claims_four = bytes(attitude_with_sum16);
  claims_four[15] = std::byte{0x80};
  EXPECT_THAT(read(claims_four), ElementsAre(bad(WrapperError::beyond_end, 0)));
  EXPECT_EQ(counters.checksum_length_mismatch, 2U);

  for (const auto example : {attitude_without_checksum, attitude_with_sum16, attitude_with_sum32})
    EXPECT_THAT(read(bytes(example)), ElementsAre(good(0)));
  EXPECT_EQ(counters.checksum_length_mismatch, 2U);
}

TEST_F(DatagramReaderTest, ReadsADatagramThatIsTooLongAndCountsIt) {
  const auto one = bytes(all_fields_with_sum16);
  std::vector<std::byte> payload;
  for (int i = 0; i < 9; ++i) payload.insert(payload.end(), one.begin(), one.end());
  EXPECT_EQ(read(payload).size(), 9U);
  EXPECT_EQ(counters.too_long, 1U);
  EXPECT_EQ(counters.messages, 9U);
}

TEST(DatagramWriter, PacksMessagesUntilOneDoesNotFit) {
  const auto profile = profile_with(Checksum::sum16);
  const auto message = bytes(all_fields_with_sum16);
  const auto data = Bytes{message}.subspan(wrapper_size, 46);
  std::vector<std::byte> buffer(2000);
  DatagramWriter writer{buffer, profile};
  EXPECT_TRUE(writer.empty());
  for (int i = 0; i < 8; ++i) {
    const auto added = writer.add(envelope, number, data);
    ASSERT_TRUE(added);
    EXPECT_EQ(std::vector(added->begin(), added->end()), message);
  }
  EXPECT_EQ(writer.bytes().size(), 512U);
  EXPECT_EQ(writer.add(envelope, number, data).error(), WriteError::no_room);
  EXPECT_EQ(writer.bytes().size(), 512U);

  // 548 bytes exactly.
  EXPECT_EQ(writer.room().size(), 18U);
  EXPECT_EQ(writer.add(envelope, number, data.first(19)).error(), WriteError::no_room);
  ASSERT_TRUE(writer.add(envelope, number, data.first(18)));
  EXPECT_EQ(writer.bytes().size(), datagram_size_max);
  EXPECT_THAT(writer.room(), IsEmpty());

  DatagramCounters counters;
  EXPECT_EQ(read_all(writer.bytes(), profile, counters).size(), 9U);
  EXPECT_EQ(counters.messages, 9U);
  EXPECT_EQ(counters.too_long, 0U);

  writer.clear();
  EXPECT_TRUE(writer.empty());
  EXPECT_TRUE(writer.add(envelope, number, data));
}

TEST(DatagramWriter, TellsWhatFitsNowhere) {
  const std::vector<std::byte> data(529);
  std::vector<std::byte> buffer(datagram_size_max);
  const auto profile = profile_with(Checksum::sum32);
  DatagramWriter writer{buffer, profile};
  EXPECT_EQ(writer.add(envelope, number, data).error(), WriteError::too_long);
  EXPECT_EQ(writer.add(envelope, number, {}).error(), WriteError::no_data);
  EXPECT_EQ(writer.room().size(), data_size_max);
  ASSERT_TRUE(writer.add(envelope, number, Bytes{data}.first(528)));
  EXPECT_EQ(writer.bytes().size(), datagram_size_max);

  DatagramWriter small{MutableBytes{buffer}.first(30), profile};
  EXPECT_EQ(small.add(envelope, number, Bytes{data}.first(11)).error(), WriteError::too_long);
  EXPECT_TRUE(small.add(envelope, number, Bytes{data}.first(10)));
  EXPECT_EQ(small.add(envelope, number, Bytes{data}.first(1)).error(), WriteError::no_room);
}

TEST(DatagramWriter, TakesDataWrittenInPlace) {
  const auto profile = profile_with(Checksum::sum32);
  const auto expected = bytes(attitude_with_sum32);
  std::vector<std::byte> buffer(100);
  DatagramWriter writer{buffer, profile};
  std::copy_n(expected.begin() + wrapper_size, 20, writer.room().begin());
  ASSERT_TRUE(writer.add_in_place(envelope, number, 20));
  EXPECT_EQ(std::vector(writer.bytes().begin(), writer.bytes().end()), expected);
  EXPECT_EQ(writer.add_in_place(envelope, number, writer.room().size() + 1).error(), WriteError::no_room);
}

}  // namespace
}  // namespace ponte::dli
