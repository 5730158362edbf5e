#include "ponte/dli/pcap.hpp"

#include "ponte/core/hex.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ponte::dli {
namespace {

using Reason = PcapError::Reason;

constexpr auto file_header = "d4c3b2a1 0200 0400 00000000 00000000 00000400 65000000";
/// "abc" from 10.0.0.1:4586 to 239.255.45.86:45860, 1.5 s after the beginning of 1970.
constexpr auto record_header = "01000000 20a10700 1f000000 1f000000";
constexpr auto packet = "4500001f 00004000 40111378 0a000001 efff2d56  11ea b324 000b 4f10 616263";

std::vector<std::byte> joined(std::initializer_list<std::string_view> hex) {
  std::string text;
  for (const auto part : hex) text.append(part).append(" ");
  return bytes(text);
}

CapturedDatagram datagram_with(Bytes payload) {
  return {.time = wall_time_from_unix_us(1'500'000),
          .source = {0x0A000001, 4586},
          .destination = {0xEFFF2D56, 45860},
          .payload = payload};
}

std::vector<std::byte> file_with(Bytes payload) {
  std::vector<std::byte> file;
  append_pcap_header(file);
  EXPECT_TRUE(append_datagram(file, datagram_with(payload)));
  return file;
}

void expect_abc(const CapturedDatagram& found) {
  EXPECT_EQ(unix_us(found.time), 1'500'000);
  EXPECT_EQ(found.source, (Ipv4Endpoint{0x0A000001, 4586}));
  EXPECT_EQ(found.destination, (Ipv4Endpoint{0xEFFF2D56, 45860}));
  EXPECT_EQ(to_hex(found.payload), "616263");
}

/// Reads a file that holds "abc" once, and as many packets to skip as `skipped`.
void expect_only_abc(const std::vector<std::byte>& file, std::uint64_t skipped) {
  auto reader = PcapReader::open(file);
  ASSERT_TRUE(reader);
  const auto found = reader->next();
  ASSERT_TRUE(found && *found);
  expect_abc(**found);
  EXPECT_FALSE(reader->next());
  EXPECT_EQ(reader->skipped(), skipped);
}

TEST(PcapWriter, WritesHeadersAndChecksums) {
  const auto payload = bytes("616263");
  EXPECT_EQ(to_hex(file_with(payload)), to_hex(joined({file_header, record_header, packet})));
}

TEST(PcapWriter, WritesAChecksumOfZeroAsAllOnes) {
  auto payload = bytes("0000");
  auto file = file_with(payload);
  const auto checksum = u16_be(file, 24 + 16 + 20 + 6);
  store_be(payload.data(), checksum);  // now the sum over everything is FFFF, and its complement 0
  file = file_with(payload);
  EXPECT_EQ(u16_be(file, 24 + 16 + 20 + 6), 0xFFFF);
}

TEST(PcapWriter, RefusesWhatThePcapFormatOrUdpCannotCarry) {
  std::vector<std::byte> file;
  const std::vector<std::byte> payload(65508);
  EXPECT_EQ(append_datagram(file, datagram_with(payload)).error(), PcapWriteError::payload_too_long);
  EXPECT_TRUE(append_datagram(file, datagram_with(Bytes{payload}.first(65507))));
  file.clear();
  auto early = datagram_with({});
  early.time = wall_time_from_unix_us(-1);
  EXPECT_EQ(append_datagram(file, early).error(), PcapWriteError::time_out_of_range);
  auto late = datagram_with({});
  late.time = wall_time_from_unix_us(4'294'967'296'000'000);
  EXPECT_EQ(append_datagram(file, late).error(), PcapWriteError::time_out_of_range);
  EXPECT_TRUE(file.empty());
  late.time -= std::chrono::microseconds{1};
  EXPECT_TRUE(append_datagram(file, late));
}

TEST(PcapReader, ReadsWhatWasWritten) {
  expect_only_abc(joined({file_header, record_header, packet}), 0);
  expect_only_abc(file_with(bytes("616263")), 0);

  std::vector<std::byte> file;
  append_pcap_header(file);
  std::vector<std::byte> payload;
  for (std::size_t size = 0; size < 100; ++size) {
    ASSERT_TRUE(append_datagram(file, datagram_with(payload)));
    payload.push_back(static_cast<std::byte>(size * 37));
  }
  auto reader = PcapReader::open(file);
  ASSERT_TRUE(reader);
  for (std::size_t size = 0; size < 100; ++size) {
    const auto found = reader->next();
    ASSERT_TRUE(found && *found);
    EXPECT_TRUE(std::ranges::equal((*found)->payload, Bytes{payload}.first(size)));
  }
  EXPECT_FALSE(reader->next());
}

TEST(PcapReader, ReadsTheOtherByteOrderAndNanoseconds) {
  expect_only_abc(
      joined({"a1b2c3d4 0002 0004 00000000 00000000 00040000 00000065", "00000001 0007a120 0000001f 0000001f", packet}),
      0);
  expect_only_abc(
      joined({"a1b23c4d 0002 0004 00000000 00000000 00040000 00000065", "00000001 1dcd6500 0000001f 0000001f", packet}),
      0);
  expect_only_abc(
      joined({"4d3cb2a1 0200 0400 00000000 00000000 00000400 65000000", "01000000 0065cd1d 1f000000 1f000000", packet}),
      0);
}

TEST(PcapReader, ReadsEthernetWithAndWithoutVlanAndPadding) {
  constexpr auto ethernet = "d4c3b2a1 0200 0400 00000000 00000000 00000400 01000000";
  expect_only_abc(joined({ethernet, "01000000 20a10700 2d000000 2d000000", "ffffffffffff 020000000001 0800", packet}),
                  0);
  expect_only_abc(
      joined({ethernet, "01000000 20a10700 31000000 31000000", "ffffffffffff 020000000001 8100 0005 0800", packet}), 0);
  expect_only_abc(
      joined({ethernet, "01000000 20a10700 31000000 31000000", "ffffffffffff 020000000001 0800", packet, "00000000"}),
      0);
  // IPv6, and a frame too short for anything.
  expect_only_abc(joined({ethernet, "01000000 00000000 12000000 12000000", "ffffffffffff 020000000001 86dd 60000000",
                          "01000000 00000000 03000000 03000000", "ffffff", "01000000 20a10700 2d000000 2d000000",
                          "ffffffffffff 020000000001 0800", packet}),
                  2);
}

TEST(PcapReader, ReadsLinuxCookedCaptures) {
  expect_only_abc(joined({"d4c3b2a1 0200 0400 00000000 00000000 00000400 71000000",
                          "01000000 20a10700 2f000000 2f000000", "0000 0304 0006 000000000000 0000 0800", packet}),
                  0);
}

TEST(PcapReader, SkipsPacketsThatAreNoWholeUdpDatagram) {
  struct Change {
    std::size_t at;
    std::uint8_t value;
  };
  const Change changes[] = {
      {0, 0x65},   // IPv6
      {0, 0x44},   // a header shorter than a header
      {0, 0x4F},   // a header longer than the packet
      {9, 6},      // TCP
      {6, 0x20},   // more fragments follow
      {7, 0x01},   // a later fragment
      {3, 0x20},   // an IP packet longer than what was captured
      {3, 0x1B},   // no room for a UDP header
      {25, 0x0C},  // UDP longer than IP
      {25, 0x07},  // UDP shorter than its header
  };
  for (const auto& change : changes) {
    auto file = joined({file_header, record_header, packet, record_header, packet});
    file[24 + 16 + change.at] = std::byte{change.value};
    expect_only_abc(file, 1);
  }
}

TEST(PcapReader, TellsWhereAFileEndsTooEarly) {
  const auto file = joined({file_header, record_header, packet});
  for (std::size_t size = 0; size < 24; ++size)
    EXPECT_EQ(PcapReader::open(Bytes{file}.first(size)).error(), (PcapError{Reason::not_pcap, 0})) << "at " << size;
  EXPECT_FALSE(PcapReader::open(Bytes{file}.first(24))->next());
  for (std::size_t size = 25; size < file.size(); ++size) {
    auto reader = PcapReader::open(Bytes{file}.first(size));
    ASSERT_TRUE(reader);
    const auto found = reader->next();
    ASSERT_TRUE(found) << "at " << size;
    EXPECT_EQ(found->error(), (PcapError{Reason::truncated, 24})) << "at " << size;
    EXPECT_FALSE(reader->next());
  }
}

TEST(PcapReader, RefusesOtherFiles) {
  EXPECT_EQ(PcapReader::open(bytes("0a0d0d0a")).error(), (PcapError{Reason::pcapng, 0}));
  const std::vector<std::byte> zeros(100);
  EXPECT_EQ(PcapReader::open(zeros).error(), (PcapError{Reason::not_pcap, 0}));
  EXPECT_EQ(PcapReader::open(bytes("d4c3b2a1 0200 0400 00000000 00000000 00000400 93000000")).error(),
            (PcapError{Reason::unknown_link_type, 20}));
}

}  // namespace
}  // namespace ponte::dli
