#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>
#include <vector>

/// Captures of UDP datagrams in the classic pcap format, for Wireshark and from it. Works on bytes in memory.
namespace ponte::dli {

struct Ipv4Endpoint {
  std::uint32_t address{};  ///< 127.0.0.1 is 0x7F000001
  std::uint16_t port{};

  friend constexpr bool operator==(const Ipv4Endpoint&, const Ipv4Endpoint&) = default;
};

/// One UDP datagram and when it was sent or received. Owns no bytes.
struct CapturedDatagram {
  WallTime time{};
  Ipv4Endpoint source{};
  Ipv4Endpoint destination{};
  Bytes payload{};
};

enum class PcapWriteError : std::uint8_t {
  payload_too_long,   ///< more than the 65507 bytes of a UDP datagram over IPv4
  time_out_of_range,  ///< before 1970, or after 2106
};

/// Appends the file header: microseconds, raw IP packets.
void append_pcap_header(std::vector<std::byte>& file);

/// Appends one record: the datagram with an IPv4 header (RFC 791) and a UDP header (RFC 768), checksums included.
[[nodiscard]] Result<void, PcapWriteError> append_datagram(std::vector<std::byte>& file,
                                                           const CapturedDatagram& datagram);

struct PcapError {
  enum class Reason : std::uint8_t {
    not_pcap,           ///< no pcap file at all
    pcapng,             ///< the newer format: to be saved as pcap first
    unknown_link_type,  ///< neither raw IP, nor Ethernet, nor Linux "cooked" capture
    truncated,          ///< the file ends inside a record
  } reason;
  std::size_t offset;  ///< in the file

  friend constexpr bool operator==(const PcapError&, const PcapError&) = default;
};

/// Reads pcap files of either byte order, in microseconds or nanoseconds. Packets other than whole UDP datagrams over
/// IPv4 (other protocols, fragments, packets cut by the capture) are skipped and counted; checksums are not examined,
/// since a capture on the sending machine is often made before they are filled in.
class PcapReader {
 public:
  /// `file` must outlive the reader and what it returns.
  [[nodiscard]] static Result<PcapReader, PcapError> open(Bytes file);

  /// The next UDP datagram, or an error after which there is nothing more; nothing at the end of the file.
  [[nodiscard]] std::optional<Result<CapturedDatagram, PcapError>> next();

  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  PcapReader() = default;
  [[nodiscard]] std::uint32_t number(std::size_t at) const;

  Bytes file_;
  bool swapped_{};
  bool nanoseconds_{};
  std::uint32_t link_type_{};
  std::size_t offset_{};
  std::uint64_t skipped_{};
};

}  // namespace ponte::dli
