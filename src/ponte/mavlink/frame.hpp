#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/crc.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// MAVLink 0.9, 1 and 2 frames: where they begin and end, and what is in their header.
namespace ponte::mavlink {

enum class Version : std::uint8_t { v0_9 = 0, v1 = 1, v2 = 2 };

/// "0.9", "1" or "2".
[[nodiscard]] constexpr std::string_view to_text(Version version) {
  switch (version) {
    case Version::v0_9: return "0.9";
    case Version::v1: return "1";
    case Version::v2: return "2";
  }
  return {};
}

inline constexpr std::byte start_v0_9{0x55};  ///< 'U'
inline constexpr std::byte start_v1{0xFE};
inline constexpr std::byte start_v2{0xFD};
inline constexpr std::size_t signature_size = 13;  ///< link id, 48-bit time stamp, 6 bytes of hash
inline constexpr std::size_t max_payload_size = 255;
inline constexpr std::size_t min_frame_size = 8;    ///< before MAVLink 2, without payload
inline constexpr std::size_t max_frame_size = 280;  ///< a signed MAVLink 2 frame with the longest payload

/// Bytes before the payload, start byte included.
[[nodiscard]] constexpr std::size_t header_size(Version version) { return version == Version::v2 ? 10 : 6; }

/// One frame, still inside the buffer it arrived in. The view owns nothing: it is valid only as long as that buffer is.
struct FrameView {
  Version version{};
  std::uint8_t incompatibility_flags{};  ///< 0 before MAVLink 2
  std::uint8_t compatibility_flags{};    ///< 0 before MAVLink 2
  std::uint8_t sequence{};
  SystemId system{};
  ComponentId component{};
  MessageId message{};
  Bytes payload{};  ///< as sent: in MAVLink 2 trailing zero bytes may be missing
  Bytes whole{};    ///< start byte to signature, for forwarding untouched

  [[nodiscard]] bool is_signed() const { return (incompatibility_flags & 0x01U) != 0; }
  /// The `signature_size` bytes behind the checksum; empty if the frame is not signed.
  [[nodiscard]] Bytes signature() const { return is_signed() ? whole.last(signature_size) : Bytes{}; }
  /// As sent, whether it is right or not.
  [[nodiscard]] std::uint16_t checksum() const { return u16_le(whole, header_size(version) + payload.size()); }
};

/// What the dialect says of the message in this frame, or nothing.
[[nodiscard]] const MessageInfo* find_message(const Dialect& dialect, const FrameView& frame);

enum class FrameError {
  incomplete,    ///< more bytes are needed to tell, or to have all of the frame
  not_a_frame,   ///< the first byte begins no frame
  unknown_flag,  ///< MAVLink 2 obliges us to discard frames with incompatibility flags that we do not understand
  checksum,      ///< wrong, in MAVLink 0.9
};

/// Reads the frame that begins at the first byte of `input`; what follows it does not matter. After any error but
/// `incomplete`: drop one byte and look again. The checksum of MAVLink 1 and 2 is not examined here, since it needs the
/// dialect; that of MAVLink 0.9 needs nothing, and is.
[[nodiscard]] Result<FrameView, FrameError> parse_frame(Bytes input);

/// How many more bytes, at least, make `input` a frame; at least 1. Of an empty input: the size of the smallest frame.
[[nodiscard]] std::size_t missing_bytes(Bytes input);

/// Whether the checksum is right for a message with this crc_extra, which MAVLink 0.9 does not use.
[[nodiscard]] bool checksum_matches(const FrameView& frame, std::uint8_t crc_extra);

/// The part of the payload that the fields of `message` may be read from. Before MAVLink 2 that ends with the base
/// fields, as extensions do not exist there. It may be shorter than the fields: missing bytes are zeros.
[[nodiscard]] Bytes readable_payload(const FrameView& frame, const MessageInfo& message);

/// Position of the first byte that can begin a frame, or the size of `bytes`.
[[nodiscard]] std::size_t find_start(Bytes bytes);

/// What the sender decides about a frame besides its payload.
struct FrameHeader {
  Version version{Version::v2};
  SystemId system{};
  ComponentId component{};
  std::uint8_t sequence{};
};

enum class WriteError {
  needs_version_2,  ///< the message id does not fit the 8 bits of MAVLink 1
  wrong_version,    ///< a message of MAVLink 0.9 in another version, or the other way round
};

/// Writes an unsigned frame to the beginning of `out` and returns its size in bytes. `payload` has the full length of
/// the message; MAVLink 2 leaves out its trailing zeros, but for one byte, and MAVLink 1 leaves out the extensions.
/// `out` has room for `max_frame_size` bytes.
[[nodiscard]] Result<std::size_t, WriteError> write_frame(const FrameHeader& header, const MessageInfo& message,
                                                          Bytes payload, MutableBytes out);

/// The second half of `write_frame`, for a payload of full length that is in its place already, `header_size` bytes
/// behind the beginning of `out`: adds what is around it.
[[nodiscard]] Result<std::size_t, WriteError> seal_frame(const FrameHeader& header, const MessageInfo& message,
                                                         MutableBytes out);

// What follows is inline because it is done for every frame.

namespace detail {

inline constexpr std::uint8_t flag_signed = 0x01;
inline constexpr std::size_t checksum_size = 2;

[[gnu::always_inline]] inline Result<FrameView, FrameError> parse_v2(Bytes input) {
  if (input.size() < 3) return fail(FrameError::incomplete);
  const auto flags = u8(input, 2);
  if ((flags & ~flag_signed) != 0) return fail(FrameError::unknown_flag);

  const auto begin = header_size(Version::v2);
  const std::size_t length = u8(input, 1);
  const auto size = begin + length + checksum_size + (flags != 0 ? signature_size : 0);
  if (input.size() < size) return fail(FrameError::incomplete);
  return FrameView{
      .version = Version::v2,
      .incompatibility_flags = flags,
      .compatibility_flags = u8(input, 3),
      .sequence = u8(input, 4),
      .system = SystemId{u8(input, 5)},
      .component = ComponentId{u8(input, 6)},
      .message = MessageId{u16_le(input, 7) + (std::uint32_t{u8(input, 9)} << 16U)},
      .payload = input.subspan(begin, length),
      .whole = input.first(size),
  };
}

/// The header of MAVLink 0.9 is that of MAVLink 1.
inline Result<FrameView, FrameError> parse_v1(Bytes input, Version version) {
  if (input.size() < 2) return fail(FrameError::incomplete);
  const auto begin = header_size(version);
  const std::size_t length = u8(input, 1);
  const auto size = begin + length + checksum_size;
  if (input.size() < size) return fail(FrameError::incomplete);
  return FrameView{
      .version = version,
      .sequence = u8(input, 2),
      .system = SystemId{u8(input, 3)},
      .component = ComponentId{u8(input, 4)},
      .message = MessageId{u8(input, 5)},
      .payload = input.subspan(begin, length),
      .whole = input.first(size),
  };
}

inline Result<FrameView, FrameError> parse_v0_9(Bytes input) {
  auto frame = parse_v1(input, Version::v0_9);
  if (frame && !checksum_matches(*frame, 0)) return fail(FrameError::checksum);
  return frame;
}

}  // namespace detail

[[gnu::always_inline]] inline Result<FrameView, FrameError> parse_frame(Bytes input) {
  if (input.empty()) return fail(FrameError::incomplete);
  if (input[0] == start_v2) return detail::parse_v2(input);
  if (input[0] == start_v1) return detail::parse_v1(input, Version::v1);
  if (input[0] == start_v0_9) return detail::parse_v0_9(input);
  return fail(FrameError::not_a_frame);
}

inline const MessageInfo* find_message(const Dialect& dialect, const FrameView& frame) {
  if (frame.version == Version::v0_9) return dialect.find_v09(frame.message, frame.payload.size());
  return dialect.find(frame.message);
}

inline bool checksum_matches(const FrameView& frame, std::uint8_t crc_extra) {
  const auto covered = frame.whole.subspan(1, header_size(frame.version) - 1 + frame.payload.size());
  const auto crc = crc_of(covered);
  return (frame.version == Version::v0_9 ? crc : crc_of(crc_extra, crc)) == frame.checksum();
}

}  // namespace ponte::mavlink
