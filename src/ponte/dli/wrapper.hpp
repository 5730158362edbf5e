#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/dli/entity_id.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/dli/properties.hpp"

#include <cstdint>

/// The message wrapper of Edition 3 and Edition A: 16 bytes, the message data, and a checksum of 0, 2 or 4 bytes.
/// Every number is sent most significant byte first.
namespace ponte::dli {

inline constexpr std::size_t wrapper_size = 16;
/// A guaranteed IPv4 datagram of 576 bytes, less IP header (20), UDP header (8), wrapper (16) and longest checksum (4).
inline constexpr std::size_t data_size_max = 528;
/// All messages of one UDP payload together.
inline constexpr std::size_t datagram_size_max = 548;

/// Who writes to whom, and whether an answer is wanted.
struct Envelope {
  EntityId source;
  EntityId destination;
  bool acknowledgement_wanted{};

  friend constexpr bool operator==(const Envelope&, const Envelope&) = default;
};

/// One wrapped message, still inside the buffer it arrived in. The view owns nothing: it is valid only as long as that
/// buffer is.
struct WrapperView {
  std::uint16_t sequence{};  ///< FFFF in Edition 3, 0 or 1 in Edition A where it is reserved; of no meaning
  EntityId source{};
  EntityId destination{};
  MessageNumber number{};
  Properties properties{};
  Bytes data{};   ///< from the presence vector to the last field
  Bytes whole{};  ///< wrapper to checksum, for forwarding untouched

  [[nodiscard]] constexpr Envelope envelope() const { return {source, destination, properties.acknowledgement_wanted}; }
};

/// Why bytes are not a message, or not a good one.
enum class WrapperError : std::uint8_t {
  truncated,            ///< the bytes end inside the wrapper
  bad_length,           ///< Message Length is 0 or above 528
  beyond_end,           ///< data or checksum would end behind the last byte
  unassigned_checksum,  ///< checksum code 11, which the profile does not accept
  bad_checksum,         ///< to be dropped without acknowledgement
  stray_bytes,          ///< too few bytes for a wrapper follow the last message of a datagram
};
inline constexpr std::size_t wrapper_error_count = 6;

/// Reads the message that begins at the first byte of `input`, and examines its checksum. More bytes may follow it.
/// A wrong IDD version is no error: compare `properties.idd_version`. Never fails with `stray_bytes`.
[[nodiscard]] Result<WrapperView, WrapperError> parse_message(Bytes input, const Profile& profile);

/// Bytes from the wrapper's first to the checksum's last, as the wrapper at the first byte of `input` claims them; 0
/// when the claim is not credible: no room for a wrapper, a length outside of the limits, or an end behind that of
/// `input`.
[[nodiscard]] std::size_t claimed_size(Bytes input);

/// The sum of all bytes. Its low 16 or all 32 bits are the checksum.
[[nodiscard]] std::uint32_t additive_sum(Bytes bytes);

enum class WriteError : std::uint8_t {
  no_data,   ///< no message data at all; there is at least a presence vector
  too_long,  ///< more message data than 528 bytes
  no_room,   ///< the message does not fit into the buffer, or not any more into the datagram
};

/// Writes wrapper, `data` and checksum as the profile has them. Returns the number of bytes written.
[[nodiscard]] Result<std::size_t, WriteError> write_message(MutableBytes out, const Envelope& envelope,
                                                            MessageNumber number, Bytes data, const Profile& profile);

/// The same for `data_size` bytes of data which already stand in `out`, from offset 16 on.
[[nodiscard]] Result<std::size_t, WriteError> wrap_in_place(MutableBytes out, const Envelope& envelope,
                                                            MessageNumber number, std::size_t data_size,
                                                            const Profile& profile);

}  // namespace ponte::dli
