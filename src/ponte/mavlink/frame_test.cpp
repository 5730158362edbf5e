#include "ponte/mavlink/frame.hpp"

#include "ponte/core/random.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace ponte::mavlink {
namespace {

using testing::Attitude;
using testing::Everything;
using testing::Heartbeat;
using testing::Statustext;

class EachFrame : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(ParseFrame, EachFrame,
                         ::testing::Values(testing::heartbeat_frame, testing::heartbeat_v1_frame,
                                           testing::heartbeat_signed_frame, testing::attitude_frame));

TEST_P(EachFrame, AsksForMoreAtEveryShorterLength) {
  const auto input = bytes(GetParam());
  for (std::size_t size = 0; size < input.size(); ++size)
    EXPECT_EQ(parse_frame(Bytes{input}.first(size)), fail(FrameError::incomplete)) << "at " << size;
}

TEST_P(EachFrame, EndsWhereItsOwnBytesEnd) {
  const auto input = bytes(GetParam());
  auto longer = input;
  longer.resize(input.size() + 20, start_v2);
  const auto frame = parse_frame(longer);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->whole.size(), input.size());
}

TEST_P(EachFrame, HasAChecksumThatEveryChangedByteBreaks) {
  const auto input = bytes(GetParam());
  const auto crc_extra = u8(input, 1) == 9 ? Heartbeat::info.crc_extra : Attitude::info.crc_extra;
  const auto whole = parse_frame(input);
  ASSERT_TRUE(whole);
  EXPECT_TRUE(checksum_matches(*whole, crc_extra));
  for (std::size_t at = 0; at < input.size() - whole->signature().size(); ++at) {
    auto changed = input;
    changed[at] ^= std::byte{0x10};
    const auto frame = parse_frame(changed);
    EXPECT_FALSE(frame && checksum_matches(*frame, crc_extra)) << "at " << at;
  }
}

TEST(ParseFrame, ReadsTheHeaderOfBothVersions) {
  for (const auto* text : {testing::heartbeat_frame, testing::heartbeat_v1_frame}) {
    const auto input = bytes(text);
    const auto frame = parse_frame(input);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->version, text == testing::heartbeat_frame ? Version::v2 : Version::v1);
    EXPECT_EQ(frame->sequence, 42);
    EXPECT_EQ(frame->system, SystemId{1});
    EXPECT_EQ(frame->component, ComponentId{1});
    EXPECT_EQ(frame->message, MessageId{0});
    EXPECT_EQ(to_hex(frame->payload), "040000000203510403");
    EXPECT_TRUE(frame->signature().empty());
  }
}

TEST(ParseFrame, ReadsAllThreeBytesOfTheMessageId) {
  const auto input = bytes("fd 00 00 00 00 01 01 56 34 12 00 00");
  EXPECT_EQ(parse_frame(input)->message, MessageId{0x123456});
}

TEST(ParseFrame, KeepsTheSignatureWithTheFrame) {
  const auto input = bytes(testing::heartbeat_signed_frame);
  const auto frame = parse_frame(input);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->is_signed());
  EXPECT_EQ(to_hex(frame->signature()), "07e803000000008bd6386f45f6");
  EXPECT_EQ(frame->checksum(), 0x5968);
  EXPECT_EQ(frame->whole.size(), input.size());
}

TEST(ParseFrame, RefusesFlagsThatItDoesNotKnowAsSoonAsItSeesThem) {
  EXPECT_EQ(parse_frame(bytes("fd 09 02")), fail(FrameError::unknown_flag));
  EXPECT_EQ(parse_frame(bytes("fd 09 81")), fail(FrameError::unknown_flag));
}

TEST(ParseFrame, RefusesOtherStartBytes) {
  EXPECT_EQ(parse_frame(bytes("54 03")), fail(FrameError::not_a_frame));
  EXPECT_EQ(parse_frame(bytes("ff")), fail(FrameError::not_a_frame));
}

TEST(FindStart, FindsTheFirstStartByteAnywhere) {
  Random random{3};
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::byte> data(random.below(40));
    for (auto& byte : data) byte = static_cast<std::byte>(0xF8U + random.below(8));
    for (auto& byte : data)
      if (random.chance(0.8)) byte = random.byte();
    const auto expected = std::find_if(
        data.begin(), data.end(), [](auto byte) { return byte == start_v0_9 || byte == start_v1 || byte == start_v2; });
    ASSERT_EQ(find_start(data), static_cast<std::size_t>(expected - data.begin())) << to_hex(data, " ");
  }
}

std::vector<std::byte> written(const FrameHeader& header, const MessageInfo& message, Bytes payload) {
  std::array<std::byte, max_frame_size> out{};
  const auto size = write_frame(header, message, payload, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size.value())};
}

TEST(WriteFrame, WritesTheGoldenFrames) {
  const auto payload = bytes("04 00 00 00 02 03 51 04 03");
  FrameHeader header{.system = SystemId{1}, .component = ComponentId{1}, .sequence = 42};
  EXPECT_EQ(written(header, Heartbeat::info, payload), bytes(testing::heartbeat_frame));
  header.version = Version::v1;
  EXPECT_EQ(written(header, Heartbeat::info, payload), bytes(testing::heartbeat_v1_frame));
}

TEST(WriteFrame, LeavesOutTrailingZerosButKeepsOneByte) {
  const auto frame = written({}, Heartbeat::info, bytes("00 00 00 00 00 00 00 00 00"));
  EXPECT_EQ(parse_frame(frame)->payload.size(), 1U);
  EXPECT_TRUE(checksum_matches(*parse_frame(frame), Heartbeat::info.crc_extra));
}

TEST(WriteFrame, LeavesExtensionsOutOfVersion1) {
  std::vector<std::byte> payload(Statustext::info.full_length, std::byte{0x41});
  const auto frame = written({.version = Version::v1}, Statustext::info, payload);
  EXPECT_EQ(parse_frame(frame)->payload.size(), Statustext::info.base_length);
  EXPECT_TRUE(checksum_matches(*parse_frame(frame), Statustext::info.crc_extra));
}

TEST(WriteFrame, RefusesIdsThatVersion1CannotCarry) {
  const std::vector<std::byte> payload(Everything::info.full_length);
  std::array<std::byte, max_frame_size> out{};
  EXPECT_EQ(write_frame({.version = Version::v1}, Everything::info, payload, out), fail(WriteError::needs_version_2));
  EXPECT_EQ(parse_frame(written({}, Everything::info, payload))->message, Everything::info.id);
}

}  // namespace
}  // namespace ponte::mavlink
