#include "ponte/mavlink/frame.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/crc.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace ponte::mavlink {
namespace {

/// Of the frame that begins at the first byte of `input`, as far as its bytes tell.
std::size_t size_at_least(Bytes input) {
  const bool is_v2 = !input.empty() && input[0] == start_v2;
  const auto begin = header_size(is_v2 ? Version::v2 : Version::v1);
  const std::size_t length = input.size() > 1 ? u8(input, 1) : 0;
  const bool is_signed = is_v2 && input.size() > 2 && (u8(input, 2) & detail::flag_signed) != 0;
  return begin + length + detail::checksum_size + (is_signed ? signature_size : 0);
}

bool begins_frame(std::byte byte) { return byte == start_v0_9 || byte == start_v1 || byte == start_v2; }

using Block [[gnu::vector_size(16)]] = std::uint8_t;
using Half [[gnu::vector_size(8)]] = std::uint8_t;

/// All bits of each byte of the block that can begin a frame; as words of 8 bytes.
template <class Words, class AnyBlock>
Words starts_in(const std::byte* at) {
  AnyBlock block;
  std::memcpy(&block, at, sizeof block);
  const auto is = [&](std::byte start) { return block == std::to_integer<std::uint8_t>(start); };
  return std::bit_cast<Words>(is(start_v0_9) | is(start_v1) | is(start_v2));
}

std::size_t first_marked(std::uint64_t word) { return static_cast<std::size_t>(std::countr_zero(word)) / 8; }

}  // namespace

std::size_t missing_bytes(Bytes input) {
  const auto size = size_at_least(input);
  return size > input.size() ? size - input.size() : 1;
}

Bytes readable_payload(const FrameView& frame, const MessageInfo& message) {
  const std::size_t known = frame.version == Version::v2 ? message.full_length : message.base_length;
  return frame.payload.first(std::min(frame.payload.size(), known));
}

std::size_t find_start(Bytes bytes) {
  const auto size = bytes.size();
  std::size_t at = 0;
  for (; at + sizeof(Block) <= size; at += sizeof(Block)) {
    const auto halves = starts_in<std::array<std::uint64_t, 2>, Block>(&bytes[at]);
    if (halves[0] != 0) return at + first_marked(halves[0]);
    if (halves[1] != 0) return at + sizeof(Half) + first_marked(halves[1]);
  }
  if (size < sizeof(Half)) {
    while (at < size && !begins_frame(bytes[at])) ++at;
    return at;
  }
  // The last half may begin among bytes that have been looked at: no start is there.
  for (; at < size; at += sizeof(Half)) {
    at = std::min(at, size - sizeof(Half));
    const auto starts = starts_in<std::uint64_t, Half>(&bytes[at]);
    if (starts != 0) return at + first_marked(starts);
  }
  return size;
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
  return begin + length + detail::checksum_size;
}

}  // namespace ponte::mavlink
