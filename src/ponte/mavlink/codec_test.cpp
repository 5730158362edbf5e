#include "ponte/mavlink/codec.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <vector>

namespace ponte::mavlink {
namespace {

using testing::Attitude;
using testing::Everything;
using testing::Heartbeat;
using testing::Statustext;

template <class M>
std::vector<std::byte> encoded(const M& message, const FrameHeader& header) {
  std::array<std::byte, max_frame_size> out;
  out.fill(std::byte{0xAA});  // what was in the buffer before must not matter
  const auto size = encode(message, header, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size.value())};
}

constexpr FrameHeader header_of(std::uint8_t sequence, Version version = Version::v2) {
  return {.version = version, .system = SystemId{1}, .component = ComponentId{1}, .sequence = sequence};
}

constexpr Heartbeat heartbeat{.type = 2, .autopilot = 3, .base_mode = 0x51, .custom_mode = 4, .system_status = 4};
constexpr Attitude attitude{.time_boot_ms = 123456,
                            .roll = 0.1F,
                            .pitch = -0.2F,
                            .yaw = 3.0F,
                            .rollspeed = 0.01F,
                            .pitchspeed = 0.02F,
                            .yawspeed = -0.03F};

TEST(Encode, WritesTheGoldenFrames) {
  EXPECT_EQ(encoded(heartbeat, header_of(42)), bytes(testing::heartbeat_frame));
  EXPECT_EQ(encoded(heartbeat, header_of(42, Version::v1)), bytes(testing::heartbeat_v1_frame));
  EXPECT_EQ(encoded(attitude, header_of(7)), bytes(testing::attitude_frame));
  EXPECT_EQ(encoded(Statustext{.severity = 6, .text = {"Init Gyro**"}}, header_of(8)),
            bytes(testing::statustext_frame));
}

TEST(Encode, RefusesIdsThatVersion1CannotCarry) {
  std::array<std::byte, max_frame_size> out{};
  EXPECT_EQ(encode(Everything{}, header_of(0, Version::v1), out), fail(WriteError::needs_version_2));
}

TEST(Decode, ReadsTheGoldenFrames) {
  const auto heartbeat_bytes = bytes(testing::heartbeat_frame);
  EXPECT_EQ(decode<Heartbeat>(*parse_frame(heartbeat_bytes)), heartbeat);
  const auto attitude_bytes = bytes(testing::attitude_frame);
  EXPECT_EQ(decode<Attitude>(*parse_frame(attitude_bytes)), attitude);
}

TEST(Decode, TakesMissingBytesForZeros) {
  const auto frame_bytes = bytes(testing::statustext_frame);
  const auto message = decode<Statustext>(*parse_frame(frame_bytes));
  EXPECT_EQ(message, (Statustext{.severity = 6, .text = {"Init Gyro**"}}));
  EXPECT_EQ(decode<Attitude>(bytes("40 e2 01 00 cd cc")),
            (Attitude{.time_boot_ms = 123456, .roll = std::bit_cast<float>(0x0000'CCCDU)}));
  EXPECT_EQ(decode<Attitude>(Bytes{}), Attitude{});
}

TEST(Decode, IgnoresExtensionsThatAreNewerThanTheDefinition) {
  auto payload = bytes("04 00 00 00 02 03 51 04 03");
  payload.resize(payload.size() + 7, std::byte{0xEE});
  EXPECT_EQ(decode<Heartbeat>(payload), heartbeat);
}

TEST(Decode, FindsNoExtensionsInVersion1EvenIfTheirBytesAreThere) {
  const Statustext sent{.severity = 6, .text = {"x"}, .id = 513, .chunk_seq = 2};
  const auto frame_bytes = encoded(sent, header_of(1));
  EXPECT_EQ(decode<Statustext>(*parse_frame(frame_bytes)), sent);

  auto frame = *parse_frame(frame_bytes);
  frame.version = Version::v1;
  EXPECT_EQ(decode<Statustext>(frame), (Statustext{.severity = 6, .text = {"x"}}));
}

TEST(Codec, CarriesEveryType) {
  const Everything sent{.whole = -5'000'000'000, .fine = -0.1, .triple = {1, 65535, 3}, .tiny = -128, .letter = 'z'};
  const auto frame_bytes = encoded(sent, header_of(1));
  EXPECT_EQ(decode<Everything>(*parse_frame(frame_bytes)), sent);
}

TEST(CodecV09, WritesWhatTheHeadersOf2011Write) {
  const testing::AttitudeV09 message{.usec = 1'000'000,
                                     .roll = 0.1F,
                                     .pitch = 0.2F,
                                     .yaw = 0.3F,
                                     .rollspeed = 0.01F,
                                     .pitchspeed = 0.02F,
                                     .yawspeed = 0.03F};
  std::array<std::byte, max_frame_size> out{};
  const auto size = encode(message, {Version::v0_9, SystemId{1}, ComponentId{1}, 1}, out);
  ASSERT_TRUE(size.has_value());
  const auto golden = bytes(testing::attitude_v09_frame);
  EXPECT_EQ(to_hex(Bytes{out}.first(*size)), to_hex(golden));
  const auto frame = parse_frame(golden);
  ASSERT_TRUE(frame.has_value());
  EXPECT_TRUE(carries<testing::AttitudeV09>(*frame));
  EXPECT_FALSE(carries<testing::Attitude>(*frame));
  EXPECT_FALSE(carries<testing::EverythingV09>(*frame));
  EXPECT_EQ(decode<testing::AttitudeV09>(*frame), message);
}

TEST(CodecV09, ArraysAndTextsKeepTheirOrder) {
  const testing::EverythingV09 message{.triple = {1, -2, 0x1234}, .text = std::string_view{"ponte"}, .fine = -0.5};
  std::array<std::byte, max_frame_size> out{};
  const auto size = encode(message, {Version::v0_9, SystemId{1}, ComponentId{1}, 1}, out);
  ASSERT_TRUE(size.has_value());
  EXPECT_EQ(to_hex(Bytes{out}.subspan(6, 11)), "0001fffe1234706f6e7465");
  EXPECT_EQ(decode<testing::EverythingV09>(*parse_frame(Bytes{out}.first(*size))), message);
}

TEST(CodecV09, NoMessageTravelsInFramesOfAnotherVersion) {
  std::array<std::byte, max_frame_size> out{};
  for (const auto version : {Version::v1, Version::v2})
    EXPECT_EQ(encode(testing::AttitudeV09{}, {.version = version}, out), fail(WriteError::wrong_version));
  EXPECT_EQ(encode(testing::Attitude{}, {.version = Version::v0_9}, out), fail(WriteError::wrong_version));
}

}  // namespace
}  // namespace ponte::mavlink
