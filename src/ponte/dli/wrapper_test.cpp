#include "ponte/dli/wrapper.hpp"

#include "ponte/dli/worked_examples.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>

namespace ponte::dli {
namespace {

using namespace worked_examples;

struct Example {
  std::string_view hex;
  Checksum checksum;
};

constexpr std::array examples{
    Example{attitude_without_checksum, Checksum::none},
    Example{attitude_with_sum16, Checksum::sum16},
    Example{attitude_with_sum32, Checksum::sum32},
    Example{all_fields_with_sum16, Checksum::sum16},
};

std::vector<std::byte> written(const Envelope& to_write, Bytes data, const Profile& profile) {
  std::vector<std::byte> out(datagram_size_max);
  out.resize(write_message(out, to_write, number, data, profile).value());
  return out;
}

TEST(ParseMessage, ReadsTheWorkedExamples) {
  for (const auto& example : examples) {
    const auto input = bytes(example.hex);
    const auto message = parse_message(input, Profile{});
    ASSERT_TRUE(message) << example.hex;
    EXPECT_EQ(message->sequence, 0xFFFF);
    EXPECT_EQ(message->envelope(), envelope);
    EXPECT_EQ(message->number, number);
    EXPECT_EQ(message->properties, (Properties{false, 30, example.checksum}));
    EXPECT_EQ(message->data.size(), input.size() - wrapper_size - size_of(example.checksum));
    EXPECT_EQ(message->data.data(), &input[wrapper_size]);
    EXPECT_EQ(message->whole.size(), input.size());
  }
}

TEST(WriteMessage, WritesTheWorkedExamples) {
  for (const auto& example : examples) {
    const auto expected = bytes(example.hex);
    const auto data = parse_message(expected, Profile{})->data;
    EXPECT_EQ(written(envelope, data, profile_with(example.checksum)), expected) << example.hex;
  }
}

TEST(WriteMessage, FillsTheFirstFieldAndTheVersionAsTheEditionHasThem) {
  const std::array data{std::byte{1}};
  const Envelope wanted{vsm, cucs, true};
  const auto ed_a = written(wanted, data, profile_with(Checksum::sum32, Edition::ed_a));
  EXPECT_EQ(u16_be(ed_a, 0), 0x0000);
  EXPECT_EQ(u16_be(ed_a, 14), 0xA080);
  const auto ed3 = written(wanted, data, profile_with(Checksum::none));
  EXPECT_EQ(u16_be(ed3, 0), 0xFFFF);
  EXPECT_EQ(u16_be(ed3, 14), 0x9E00);
}

TEST(ParseMessage, FailsAtEveryShorterLength) {
  for (const auto& example : examples) {
    const auto input = bytes(example.hex);
    for (std::size_t size = 0; size < input.size(); ++size) {
      const auto expected = size < wrapper_size ? WrapperError::truncated : WrapperError::beyond_end;
      EXPECT_EQ(parse_message(Bytes{input}.first(size), Profile{}).error(), expected) << "at " << size;
    }
  }
}

TEST(ParseMessage, NoticesAnyChangedByteUnderAChecksum) {
  for (const auto& example : examples) {
    if (example.checksum == Checksum::none) continue;
    const auto good = bytes(example.hex);
    for (std::size_t at = 0; at < good.size(); ++at) {
      auto damaged = good;
      damaged[at] ^= std::byte{0x01};
      EXPECT_FALSE(parse_message(damaged, Profile{})) << "at " << at;
    }
  }
}

TEST(ParseMessage, NamesABadChecksum) {
  auto input = bytes(attitude_with_sum16);
  input.back() ^= std::byte{0xFF};
  EXPECT_EQ(parse_message(input, Profile{}).error(), WrapperError::bad_checksum);
  input = bytes(attitude_with_sum32);
  input[input.size() - 4] = std::byte{0x01};  // the upper half counts as well
  EXPECT_EQ(parse_message(input, Profile{}).error(), WrapperError::bad_checksum);
}

TEST(ParseMessage, RefusesALengthOutsideItsLimits) {
  std::vector<std::byte> input = bytes(attitude_without_checksum);
  input.resize(70000);
  for (const unsigned length : {0U, 529U, 0x8000U, 0xFFFFU}) {
    store_be(&input[2], static_cast<std::uint16_t>(length));
    EXPECT_EQ(parse_message(input, Profile{}).error(), WrapperError::bad_length) << length;
    EXPECT_EQ(claimed_size(input), 0U);
  }
  for (const unsigned length : {1U, 528U}) {
    store_be(&input[2], static_cast<std::uint16_t>(length));
    EXPECT_EQ(parse_message(input, Profile{})->data.size(), length);
    EXPECT_EQ(claimed_size(input), wrapper_size + length);
  }
}

TEST(ParseMessage, TakesTheUnassignedChecksumCodeOnlyWhenAskedTo) {
  auto input = bytes(attitude_with_sum32);
  input[15] = std::byte{0xC0};
  EXPECT_EQ(parse_message(input, Profile{}).error(), WrapperError::unassigned_checksum);
  Profile lenient;
  lenient.accept_unassigned_checksum = true;
  const auto message = parse_message(input, lenient);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->properties.checksum, Checksum::unassigned);
  EXPECT_EQ(message->data.size(), 20U);
  EXPECT_EQ(message->whole.size(), input.size());
}

TEST(ParseMessage, IgnoresSequenceVersionAndReservedBits) {
  auto input = bytes(attitude_without_checksum);
  input[0] = std::byte{0x12};
  input[14] = std::byte{0x14};
  input[15] |= std::byte{0x3F};
  const auto message = parse_message(input, Profile{});
  ASSERT_TRUE(message);
  EXPECT_EQ(message->sequence, 0x12FF);
  EXPECT_EQ(message->properties.idd_version, 20);
}

TEST(AdditiveSum, WrapsIntoItsSixteenBits) {
  // 528 bytes of FF and a wrapper add up to more than 0x20000.
  const std::vector<std::byte> data(data_size_max, std::byte{0xFF});
  const auto message = written(envelope, data, Profile{});
  const auto sum = additive_sum(Bytes{message}.first(wrapper_size + data_size_max));
  EXPECT_GT(sum, 0x20000U);
  EXPECT_EQ(u16_be(message, wrapper_size + data_size_max), sum & 0xFFFFU);
  EXPECT_TRUE(parse_message(message, Profile{}));
}

TEST(WriteMessage, RefusesWhatTheWrapperCannotCarry) {
  std::vector<std::byte> out(600);
  const std::vector<std::byte> data(529);
  EXPECT_EQ(write_message(out, envelope, number, {}, Profile{}).error(), WriteError::no_data);
  EXPECT_EQ(write_message(out, envelope, number, data, Profile{}).error(), WriteError::too_long);
  EXPECT_EQ(write_message(out, envelope, number, Bytes{data}.first(528), Profile{}).value(), 546U);
  EXPECT_EQ(wrap_in_place(out, envelope, number, 0, Profile{}).error(), WriteError::no_data);
  EXPECT_EQ(wrap_in_place(out, envelope, number, 529, Profile{}).error(), WriteError::too_long);
}

TEST(WriteMessage, RefusesEveryBufferThatIsTooSmall) {
  const auto expected = bytes(attitude_with_sum16);
  const auto data = Bytes{expected}.subspan(wrapper_size, 20);
  std::vector<std::byte> out(expected.size());
  for (std::size_t size = 0; size < expected.size(); ++size) {
    const auto room = MutableBytes{out}.first(size);
    EXPECT_EQ(write_message(room, envelope, number, data, Profile{}).error(), WriteError::no_room) << "at " << size;
  }
  EXPECT_EQ(write_message(out, envelope, number, data, Profile{}).value(), expected.size());
}

}  // namespace
}  // namespace ponte::dli
