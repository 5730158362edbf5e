#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/core/text.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

/// Generated message structs to payload bytes and back. Offsets are constants of the type, so that both directions
/// become plain loads and stores.
namespace ponte::mavlink {
namespace detail {

template <WireNumber T>
void load_field(const FieldInfo& field, const std::byte* at, T& value) {
  value = field.big_endian ? load_be<T>(at) : load_le<T>(at);
}

template <std::size_t Size>
void load_field(const FieldInfo& /*field*/, const std::byte* at, Text<Size>& value) {
  std::memcpy(value.chars().data(), at, Size);
}

template <WireNumber T, std::size_t Size>
void load_field(const FieldInfo& field, const std::byte* at, std::array<T, Size>& value) {
  for (std::size_t i = 0; i < Size; ++i) load_field(field, at + i * sizeof(T), value[i]);
}

template <WireNumber T>
void store_field(const FieldInfo& field, std::byte* at, T value) {
  field.big_endian ? store_be(at, value) : store_le(at, value);
}

template <std::size_t Size>
void store_field(const FieldInfo& /*field*/, std::byte* at, const Text<Size>& value) {
  std::memcpy(at, value.chars().data(), Size);
}

template <WireNumber T, std::size_t Size>
void store_field(const FieldInfo& field, std::byte* at, const std::array<T, Size>& value) {
  for (std::size_t i = 0; i < Size; ++i) store_field(field, at + i * sizeof(T), value[i]);
}

/// For payloads, which are shorter than what makes a library call worth its while.
inline void copy_short(Bytes from, std::byte* to) {
  constexpr std::size_t word = 8;
  if (from.size() < word) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
    return;
  }
  const auto copy_word = [&](std::size_t at) { std::memcpy(to + at, from.data() + at, word); };
  for (std::size_t at = 0; at + word < from.size(); at += word) copy_word(at);
  copy_word(from.size() - word);
}

template <Message M>
M load_fields(const std::byte* payload) {
  M message;
  M::visit(message,
           [payload](const FieldInfo& field, auto& value) { load_field(field, payload + field.offset, value); });
  return message;
}

}  // namespace detail

/// Whether the frame, whose checksum is right, carries an `M`. The same id means another message in MAVLink 0.9, where
/// besides only the length tells the messages of different dialects apart.
template <Message M>
[[nodiscard]] constexpr bool carries(const FrameView& frame) {
  if (frame.message != M::info.id || M::info.is_v09() != (frame.version == Version::v0_9)) return false;
  return !M::info.is_v09() || frame.payload.size() == M::info.full_length;
}

/// The message in a payload. Bytes that the sender left out are zeros; bytes beyond the fields that we know
/// are extensions of a newer definition and are not read.
template <Message M>
[[nodiscard]] M decode(Bytes payload) {
  constexpr std::size_t length = M::info.full_length;
  if (payload.size() >= length) return detail::load_fields<M>(payload.data());
  std::array<std::byte, length> extended{};
  detail::copy_short(payload, extended.data());
  return detail::load_fields<M>(extended.data());
}

/// The message in a frame, which the caller knows to be an `M`. Before MAVLink 2 the extension fields are zero.
template <Message M>
[[nodiscard]] M decode(const FrameView& frame) {
  return decode<M>(readable_payload(frame, M::info));
}

/// Writes `message` as an unsigned frame to the beginning of `out`, which has room for `max_frame_size` bytes, and
/// returns the size of the frame. MAVLink 1 does not carry the extension fields. The messages of MAVLink 0.9 are types
/// of their own, which go into its frames only.
template <Message M>
[[nodiscard]] Result<std::size_t, WriteError> encode(const M& message, const FrameHeader& header, MutableBytes out) {
  std::byte* const payload = out.subspan(header_size(header.version), M::info.full_length).data();
  M::visit(message, [payload](const FieldInfo& field, const auto& value) {
    detail::store_field(field, payload + field.offset, value);
  });
  return seal_frame(header, M::info, out);
}

}  // namespace ponte::mavlink
