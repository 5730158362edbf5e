#include "ponte/mavlink/frame.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/crc.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ponte::mavlink {
namespace {

constexpr std::uint8_t flag_signed = 0x01;
constexpr std::size_t checksum_size = 2;

Result<FrameView, FrameError> parse_v2(Bytes input) {
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

/// Of the frame that begins at the first byte of `input`, as far as its bytes tell.
std::size_t size_at_least(Bytes input) {
  const bool is_v2 = !input.empty() && input[0] == start_v2;
  const auto begin = header_size(is_v2 ? Version::v2 : Version::v1);
  const std::size_t length = input.size() > 1 ? u8(input, 1) : 0;
  const bool is_signed = is_v2 && input.size() > 2 && (u8(input, 2) & flag_signed) != 0;
  return begin + length + checksum_size + (is_signed ? signature_size : 0);
}

/// The header of MAVLink 0.9 is that of MAVLink 1.
Result<FrameView, FrameError> parse_v1(Bytes input, Version version) {
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

Result<FrameView, FrameError> parse_v0_9(Bytes input) {
  auto frame = parse_v1(input, Version::v0_9);
  if (frame && !checksum_matches(*frame, 0)) return fail(FrameError::checksum);
  return frame;
}

/// Zero if no byte of `word` equals `wanted`; otherwise the lowest bit that is set lies in the first byte that does.
constexpr std::uint64_t marks_of(std::uint64_t word, std::byte wanted) {
  constexpr std::uint64_t ones = 0x0101'0101'0101'0101;
  const auto difference = word ^ (ones * std::to_integer<std::uint64_t>(wanted));
  return (difference - ones) & ~difference & (ones << 7U);
}

}  // namespace

const MessageInfo* find_message(const Dialect& dialect, const FrameView& frame) {
  if (frame.version == Version::v0_9) return dialect.find_v09(frame.message, frame.payload.size());
  return dialect.find(frame.message);
}

Result<FrameView, FrameError> parse_frame(Bytes input) {
  if (input.empty()) return fail(FrameError::incomplete);
  if (input[0] == start_v2) return parse_v2(input);
  if (input[0] == start_v1) return parse_v1(input, Version::v1);
  if (input[0] == start_v0_9) return parse_v0_9(input);
  return fail(FrameError::not_a_frame);
}

std::size_t missing_bytes(Bytes input) {
  const auto size = size_at_least(input);
  return size > input.size() ? size - input.size() : 1;
}

bool checksum_matches(const FrameView& frame, std::uint8_t crc_extra) {
  const auto covered = frame.whole.subspan(1, header_size(frame.version) - 1 + frame.payload.size());
  const auto crc = crc_of(covered);
  return (frame.version == Version::v0_9 ? crc : crc_of(crc_extra, crc)) == frame.checksum();
}

Bytes readable_payload(const FrameView& frame, const MessageInfo& message) {
  const std::size_t known = frame.version == Version::v2 ? message.full_length : message.base_length;
  return frame.payload.first(std::min(frame.payload.size(), known));
}

std::size_t find_start(Bytes bytes) {
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    const auto word = load_le<std::uint64_t>(&bytes[at]);
    const auto marks = marks_of(word, start_v0_9) | marks_of(word, start_v1) | marks_of(word, start_v2);
    if (marks != 0) return at + static_cast<std::size_t>(std::countr_zero(marks)) / 8;
  }
  while (at < bytes.size() && bytes[at] != start_v0_9 && bytes[at] != start_v1 && bytes[at] != start_v2) ++at;
  return at;
}

Result<std::size_t, WriteError> write_frame(const FrameHeader& header, const MessageInfo& message, Bytes payload,
                                            MutableBytes out) {
  PONTE_ASSERT(payload.size() == message.full_length);
  PONTE_ASSERT(out.size() >= max_frame_size);
  std::copy(payload.begin(), payload.end(), out.subspan(header_size(header.version)).begin());
  return seal_frame(header, message, out);
}

Result<std::size_t, WriteError> seal_frame(const FrameHeader& header, const MessageInfo& message, MutableBytes out) {
  PONTE_ASSERT(out.size() >= max_frame_size);
  const auto id = message.id.value;
  const auto begin = header_size(header.version);
  const Bytes payload = out.subspan(begin, message.full_length);
  std::size_t length = message.base_length;
  if (message.is_v09() != (header.version == Version::v0_9)) return fail(WriteError::wrong_version);
  if (header.version != Version::v2) {
    if (id > 0xFF) return fail(WriteError::needs_version_2);
    out[0] = header.version == Version::v1 ? start_v1 : start_v0_9;
    out[2] = std::byte{header.sequence};
    out[3] = std::byte{header.system.value};
    out[4] = std::byte{header.component.value};
    out[5] = static_cast<std::byte>(id);
  } else {
    length = payload.size();
    while (length > 1 && payload[length - 1] == std::byte{0}) --length;
    out[0] = start_v2;
    out[2] = std::byte{0};
    out[3] = std::byte{0};
    out[4] = std::byte{header.sequence};
    out[5] = std::byte{header.system.value};
    out[6] = std::byte{header.component.value};
    store_le(&out[7], static_cast<std::uint16_t>(id & 0xFFFFU));
    out[9] = static_cast<std::byte>(id >> 16U);
  }
  out[1] = static_cast<std::byte>(length);
  const auto crc = crc_of(out.subspan(1, begin - 1 + length));
  store_le(&out[begin + length], message.is_v09() ? crc : crc_of(message.crc_extra, crc));
  return begin + length + checksum_size;
}

}  // namespace ponte::mavlink
