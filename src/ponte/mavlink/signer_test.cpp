#include "ponte/mavlink/signer.hpp"

#include "ponte/core/random.hpp"
#include "ponte/mavlink/test_signing.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

namespace ponte::mavlink {
namespace {

using namespace std::chrono_literals;
using testing::beginning_of_2015;
using testing::Heartbeat;
using testing::key;
using testing::Sender;
using testing::signed_heartbeat;

constexpr auto now = beginning_of_2015 + 1h;

SignatureVerdict verdict(Signer& signer, const std::vector<std::byte>& frame, WallTime at = now) {
  return signer.verify(at, parse_frame(frame).value());
}

TEST(SigningTime, CountsTensOfMicrosecondsSince2015) {
  EXPECT_EQ(signing_time_from(beginning_of_2015), SigningTime{0});
  EXPECT_EQ(signing_time_from(beginning_of_2015 + 1s), SigningTime{100'000});
  EXPECT_EQ(signing_time_from(wall_time_from_unix_us(1'420'070'400'000'019)), SigningTime{1});
  EXPECT_EQ(signing_time_from(wall_time_from_unix_us(0)), SigningTime{0});
}

TEST(Signer, MakesTheGoldenFrameOfTheUnsignedOne) {
  Signer signer{key(), SigningTime{999}};
  auto frame = bytes(testing::heartbeat_frame);
  const auto size = frame.size();
  frame.resize(size + signature_size);
  EXPECT_EQ(signer.sign(beginning_of_2015, 7, frame, size), frame.size());
  EXPECT_EQ(to_hex(frame), to_hex(bytes(testing::heartbeat_signed_frame)));
}

// The flag changes the checksum by what depends on the length alone.
TEST(Signer, LeavesTheChecksumRightForEveryLengthOfPayload) {
  Signer signer{key(), SigningTime{}};
  Random random{1};
  for (std::size_t length = 1; length <= max_payload_size; ++length) {
    const MessageInfo info{
        MessageId{300}, "ANY", 123, static_cast<std::uint8_t>(length), static_cast<std::uint8_t>(length), {}};
    std::vector<std::byte> payload(length);
    random.fill(payload);
    payload.back() |= std::byte{1};
    std::array<std::byte, max_frame_size> out{};
    const auto size = signer.sign(now, 1, out, write_frame({}, info, payload, out).value());
    const auto frame = parse_frame(Bytes{out}.first(size));
    ASSERT_TRUE(frame && frame->is_signed());
    EXPECT_TRUE(checksum_matches(*frame, info.crc_extra)) << length;
  }
}

TEST(Signer, AcceptsTheGoldenFrameOnce) {
  Signer signer{key(), SigningTime{}};
  const auto frame = bytes(testing::heartbeat_signed_frame);
  EXPECT_EQ(verdict(signer, frame, beginning_of_2015), SignatureVerdict::accepted);
  EXPECT_EQ(verdict(signer, frame, beginning_of_2015), SignatureVerdict::replayed);
}

TEST(Signer, RefusesAnotherKeyAndEveryChangedByte) {
  Signer other{key(0), SigningTime{}};
  Signer signer{key(), SigningTime{}};
  EXPECT_EQ(verdict(signer, signed_heartbeat(other, now)), SignatureVerdict::wrong);
  const auto frame = signed_heartbeat(signer, now);
  for (std::size_t at = 3; at < frame.size(); ++at) {  // what is before says where the frame ends
    auto changed = frame;
    changed[at] ^= std::byte{0x10};
    EXPECT_EQ(verdict(signer, changed), SignatureVerdict::wrong) << "at " << at;
  }
}

TEST(Signer, NeverUsesATimeTwiceOrGoesBack) {
  Signer signer{key(), SigningTime{}};
  auto newest = signer.time();
  for (const auto time : {now, now, now + 1s, now - 1h, beginning_of_2015 - 1h, now + 1s}) {
    (void)signed_heartbeat(signer, time);
    EXPECT_GT(signer.time(), newest);
    newest = signer.time();
  }
  Signer restarted{key(), newest};
  (void)signed_heartbeat(restarted, now - 1h);
  EXPECT_EQ(restarted.time(), SigningTime{newest.value + 1});
}

TEST(Signer, LearnsTheTimeOnlyFromWhatItAccepts) {
  Signer ahead{key(), signing_time_from(now + 24h)};
  Signer forger{key(0), signing_time_from(now + 48h)};
  Signer signer{key(), SigningTime{}};
  EXPECT_EQ(verdict(signer, signed_heartbeat(forger, now)), SignatureVerdict::wrong);
  EXPECT_LE(signer.time(), signing_time_from(now));
  EXPECT_EQ(verdict(signer, signed_heartbeat(ahead, now)), SignatureVerdict::accepted);
  EXPECT_EQ(signer.time(), ahead.time());
}

TEST(Signer, RefusesWhatIsNotNewerThanTheLastOfItsStream) {
  Signer peer{key(), SigningTime{}};
  Signer signer{key(), SigningTime{}};
  const auto first = signed_heartbeat(peer, now);
  const auto second = signed_heartbeat(peer, now);
  const auto elsewhere = signed_heartbeat(peer, now - 1s, {.link_id = 8});
  EXPECT_EQ(verdict(signer, second), SignatureVerdict::accepted);
  EXPECT_EQ(verdict(signer, first), SignatureVerdict::replayed);
  EXPECT_EQ(verdict(signer, elsewhere), SignatureVerdict::accepted) << "another stream";
}

TEST(Signer, TakesTheFirstOfAStreamUpToAMinuteLate) {
  const auto at_age = [](std::chrono::microseconds age, Sender sender) {
    Signer peer{key(), SigningTime{}};
    return signed_heartbeat(peer, now - age, sender);
  };
  Signer signer{key(), SigningTime{}};
  // A frame is one unit later than the clock.
  EXPECT_EQ(verdict(signer, at_age(1min + 20us, {.link_id = 1})), SignatureVerdict::too_old);
  EXPECT_EQ(verdict(signer, at_age(1min + 10us, {.link_id = 2})), SignatureVerdict::accepted);
  const auto known = at_age(1min, {.link_id = 2});
  EXPECT_EQ(verdict(signer, known, now + 1h), SignatureVerdict::accepted) << "a known stream may be late";
}

TEST(Signer, RemembersSoManyStreamsAndForgetsThoseOfMoreThanAMinuteAgo) {
  const auto from = [](unsigned number, WallTime at) {
    Signer peer{key(), SigningTime{}};
    return signed_heartbeat(peer, at, {.system = SystemId{static_cast<std::uint8_t>(number)}});
  };
  Signer signer{key(), SigningTime{}};
  for (unsigned i = 0; i < Signer::stream_limit; ++i)
    ASSERT_EQ(verdict(signer, from(i, now + std::chrono::microseconds{10 * i})), SignatureVerdict::accepted);
  EXPECT_EQ(verdict(signer, from(200, now)), SignatureVerdict::too_many_streams);
  const auto later = now + 1min + 30us;
  EXPECT_EQ(verdict(signer, from(201, later), later), SignatureVerdict::accepted);
  EXPECT_EQ(verdict(signer, from(0, now), later), SignatureVerdict::too_old) << "forgotten, but not to be replayed";
}

}  // namespace
}  // namespace ponte::mavlink
