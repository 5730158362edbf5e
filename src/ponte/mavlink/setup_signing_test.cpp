#include "ponte/mavlink/setup_signing.hpp"

#include "ponte/mavlink/test_signing.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

namespace ponte::mavlink {
namespace {

// Of system 255, component 190, sequence 5, for system 1, component 1, as pymavlink 2.4.50 writes it.
constexpr auto setup_frame =
    "fd 2a 00 00 05 ff be 00 01 00  05 04 03 02 01 00 00 00 01 01 00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f 10 "
    "11 12 13 14 15 16 17 18 19 1a 1b 1c 1d 1e 1f  be a2";
constexpr auto off_frame = "fd 0a 00 00 05 ff be 00 01 00  00 00 00 00 00 00 00 00 01 01  eb c2";

std::string written(const SetupSigning& setup) {
  std::array<std::byte, max_frame_size> out{};
  const auto size = write_setup_signing(setup, SystemId{255}, ComponentId{190}, 5, out);
  return to_hex(Bytes{out}.first(size));
}

TEST(SetupSigning, IsWrittenAsPymavlinkWritesIt) {
  EXPECT_EQ(written({SystemId{1}, ComponentId{1}, testing::key(), SigningTime{0x0102030405}}),
            to_hex(bytes(setup_frame)));
  EXPECT_EQ(written({SystemId{1}, ComponentId{1}, std::nullopt, SigningTime{}}), to_hex(bytes(off_frame)));
}

TEST(SetupSigning, IsReadAsItWasWritten) {
  const auto input = bytes(setup_frame);
  const auto setup = read_setup_signing(parse_frame(input).value());
  ASSERT_TRUE(setup && setup->key);
  EXPECT_EQ(setup->system, SystemId{1});
  EXPECT_EQ(setup->component, ComponentId{1});
  EXPECT_EQ(setup->time, SigningTime{0x0102030405});
  EXPECT_EQ(to_hex(setup->key->secret()), to_hex(testing::key().secret()));
}

TEST(SetupSigning, SwitchesOffWithAKeyOfZeros) {
  const auto input = bytes(off_frame);
  const auto setup = read_setup_signing(parse_frame(input).value());
  ASSERT_TRUE(setup);
  EXPECT_FALSE(setup->key);
}

TEST(SetupSigning, IsNothingWhenItIsForEverybodyOrAnotherMessage) {
  auto broadcast = bytes(setup_frame);
  broadcast[header_size(Version::v2) + 8] = std::byte{0};
  EXPECT_FALSE(read_setup_signing(parse_frame(broadcast).value()));
  const auto heartbeat = bytes(testing::heartbeat_frame);
  EXPECT_FALSE(read_setup_signing(parse_frame(heartbeat).value()));
}

}  // namespace
}  // namespace ponte::mavlink
