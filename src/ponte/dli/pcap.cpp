#include "ponte/dli/pcap.hpp"

#include <array>
#include <limits>

namespace ponte::dli {
namespace {

constexpr std::uint32_t magic_microseconds = 0xA1B2C3D4;
constexpr std::uint32_t magic_nanoseconds = 0xA1B23C4D;
constexpr std::uint32_t magic_pcapng = 0x0A0D0D0A;
constexpr std::size_t file_header_size = 24;
constexpr std::size_t record_header_size = 16;
constexpr std::uint32_t longest_packet = 262144;

constexpr std::uint32_t link_ethernet = 1;
constexpr std::uint32_t link_raw_ip = 101;
constexpr std::uint32_t link_linux_cooked = 113;

constexpr std::size_t ip_header_size = 20;
constexpr std::size_t udp_header_size = 8;
constexpr std::size_t ip_packet_max = 65535;
constexpr std::uint8_t protocol_udp = 17;
constexpr std::uint16_t ether_type_ipv4 = 0x0800;
constexpr std::uint16_t ether_type_vlan = 0x8100;

constexpr std::int64_t us_per_second = 1'000'000;

/// Sum of 16-bit words for the Internet checksum (RFC 1071), an odd last byte padded with zero.
std::uint64_t word_sum(Bytes bytes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) sum += u16_be(bytes, i);
  if (bytes.size() % 2 != 0) sum += std::uint64_t{u8(bytes, bytes.size() - 1)} << 8U;
  return sum;
}

std::uint16_t internet_checksum(std::uint64_t sum) {
  while (sum > 0xFFFF) sum = (sum & 0xFFFFU) + (sum >> 16U);
  return static_cast<std::uint16_t>(~sum);
}

using IpHeader = std::array<std::byte, ip_header_size>;
using UdpHeader = std::array<std::byte, udp_header_size>;

IpHeader ip_header(const CapturedDatagram& datagram) {
  IpHeader header{};
  header[0] = std::byte{0x45};  // version 4, five words of header
  store_be(&header[2], static_cast<std::uint16_t>(ip_header_size + udp_header_size + datagram.payload.size()));
  header[6] = std::byte{0x40};  // not to be fragmented
  header[8] = std::byte{64};    // time to live
  header[9] = std::byte{protocol_udp};
  store_be(&header[12], datagram.source.address);
  store_be(&header[16], datagram.destination.address);
  store_be(&header[10], internet_checksum(word_sum(header)));
  return header;
}

UdpHeader udp_header(const CapturedDatagram& datagram, const IpHeader& ip) {
  const auto size = static_cast<std::uint16_t>(udp_header_size + datagram.payload.size());
  UdpHeader header{};
  store_be(&header[0], datagram.source.port);
  store_be(&header[2], datagram.destination.port);
  store_be(&header[4], size);
  const auto pseudo_header = word_sum(Bytes{ip}.subspan(12)) + protocol_udp + size;
  const auto checksum = internet_checksum(pseudo_header + word_sum(header) + word_sum(datagram.payload));
  // Zero would mean that there is no checksum.
  store_be(&header[6], checksum == 0 ? std::uint16_t{0xFFFF} : checksum);
  return header;
}

void append(std::vector<std::byte>& file, Bytes bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); }

/// The IP packet inside a packet of the link; empty when there is none.
Bytes ip_packet_in(Bytes packet, std::uint32_t link_type) {
  if (link_type == link_raw_ip) return packet;
  std::size_t type_at = link_type == link_ethernet ? 12 : 14;
  if (packet.size() < type_at + 6) return {};
  if (u16_be(packet, type_at) == ether_type_vlan) type_at += 4;
  if (u16_be(packet, type_at) != ether_type_ipv4) return {};
  return packet.subspan(type_at + 2);
}

/// Addresses, ports and payload of a whole UDP datagram; nothing for any other packet.
std::optional<CapturedDatagram> udp_datagram_in(Bytes ip) {
  if (ip.size() < ip_header_size || u8(ip, 0) >> 4U != 4 || u8(ip, 9) != protocol_udp) return std::nullopt;
  const auto header_size = std::size_t{4} * (u8(ip, 0) & 0xFU);
  const std::size_t total_size = u16_be(ip, 2);
  const auto is_fragment = (u16_be(ip, 6) & 0x3FFFU) != 0;
  if (is_fragment || header_size < ip_header_size || total_size < header_size + udp_header_size) return std::nullopt;
  if (total_size > ip.size()) return std::nullopt;

  const auto udp = ip.first(total_size).subspan(header_size);
  const std::size_t udp_size = u16_be(udp, 4);
  if (udp_size < udp_header_size || udp_size > udp.size()) return std::nullopt;
  return CapturedDatagram{
      .source = {u32_be(ip, 12), u16_be(udp, 0)},
      .destination = {u32_be(ip, 16), u16_be(udp, 2)},
      .payload = udp.first(udp_size).subspan(udp_header_size),
  };
}

}  // namespace

void append_pcap_header(std::vector<std::byte>& file) {
  std::array<std::byte, file_header_size> header{};
  store_le(&header[0], magic_microseconds);
  store_le(&header[4], std::uint16_t{2});  // version 2.4
  store_le(&header[6], std::uint16_t{4});
  store_le(&header[16], longest_packet);
  store_le(&header[20], link_raw_ip);
  append(file, header);
}

Result<void, PcapWriteError> append_datagram(std::vector<std::byte>& file, const CapturedDatagram& datagram) {
  const auto packet_size = ip_header_size + udp_header_size + datagram.payload.size();
  if (packet_size > ip_packet_max) return fail(PcapWriteError::payload_too_long);
  const auto time = unix_us(datagram.time);
  if (time < 0 || time / us_per_second > std::numeric_limits<std::uint32_t>::max())
    return fail(PcapWriteError::time_out_of_range);

  std::array<std::byte, record_header_size> record{};
  store_le(&record[0], static_cast<std::uint32_t>(time / us_per_second));
  store_le(&record[4], static_cast<std::uint32_t>(time % us_per_second));
  store_le(&record[8], static_cast<std::uint32_t>(packet_size));
  store_le(&record[12], static_cast<std::uint32_t>(packet_size));
  const auto ip = ip_header(datagram);
  append(file, record);
  append(file, ip);
  append(file, udp_header(datagram, ip));
  append(file, datagram.payload);
  return {};
}

Result<PcapReader, PcapError> PcapReader::open(Bytes file) {
  using enum PcapError::Reason;
  if (file.size() >= 4 && u32_be(file, 0) == magic_pcapng) return fail(PcapError{pcapng, 0});
  if (file.size() < file_header_size) return fail(PcapError{not_pcap, 0});
  PcapReader reader;
  reader.file_ = file;
  reader.swapped_ = u32_be(file, 0) == magic_microseconds || u32_be(file, 0) == magic_nanoseconds;
  const auto magic = reader.number(0);
  if (magic != magic_microseconds && magic != magic_nanoseconds) return fail(PcapError{not_pcap, 0});
  reader.nanoseconds_ = magic == magic_nanoseconds;
  // The upper bits of the link type may tell the length of an Ethernet trailer.
  reader.link_type_ = reader.number(20) & 0xFFFFU;
  if (reader.link_type_ != link_ethernet && reader.link_type_ != link_raw_ip && reader.link_type_ != link_linux_cooked)
    return fail(PcapError{unknown_link_type, 20});
  reader.offset_ = file_header_size;
  return reader;
}

std::uint32_t PcapReader::number(std::size_t at) const {
  return swapped_ ? u32_be(file_, at) : load_le<std::uint32_t>(&file_[at]);
}

std::optional<Result<CapturedDatagram, PcapError>> PcapReader::next() {
  while (offset_ < file_.size()) {
    const auto start = offset_;
    const auto left = file_.size() - start;
    const auto cut_short = left < record_header_size || number(start + 8) > left - record_header_size;
    if (cut_short) {
      offset_ = file_.size();
      return fail(PcapError{PcapError::Reason::truncated, start});
    }
    const auto packet = file_.subspan(start + record_header_size, number(start + 8));
    offset_ += record_header_size + packet.size();
    auto datagram = udp_datagram_in(ip_packet_in(packet, link_type_));
    if (!datagram) {
      ++skipped_;
      continue;
    }
    const std::int64_t fraction = number(start + 4);
    datagram->time = wall_time_from_unix_us(std::int64_t{number(start)} * us_per_second +
                                            (nanoseconds_ ? fraction / 1000 : fraction));
    return *datagram;
  }
  return std::nullopt;
}

}  // namespace ponte::dli
