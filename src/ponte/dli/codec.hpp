#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/core/text.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/integers.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/presence.hpp"
#include "ponte/dli/profile.hpp"

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>

/// Generated message structs to message data and back.
namespace ponte::dli {

namespace detail {

template <std::integral T>
void read_value(Bytes bytes, T& value) {
  if constexpr (std::signed_integral<T>)
    value = static_cast<T>(load_signed(bytes));
  else
    value = static_cast<T>(load_unsigned(bytes));
}

inline void read_value(Bytes bytes, float& value) {
  value = std::bit_cast<float>(load_be<std::uint32_t>(bytes.data()));
}

template <std::size_t Capacity>
void read_value(Bytes bytes, Text<Capacity>& value) {
  const auto size = std::min(bytes.size(), Capacity);
  std::transform(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), value.chars().begin(),
                 [](std::byte byte) { return static_cast<char>(byte); });
}

template <std::integral T>
void write_value(FieldWriter& writer, const FieldInfo& field, T value) {
  writer.put_integer(field, static_cast<std::int64_t>(value));
}

inline void write_value(FieldWriter& writer, const FieldInfo& field, float value) { writer.put_float(field, value); }

template <std::size_t Capacity>
void write_value(FieldWriter& writer, const FieldInfo& field, const Text<Capacity>& value) {
  writer.put_text(field, value.view());
}

}  // namespace detail

/// Reads message data, presence vector first, as the edition of the profile has it. Absent fields stay empty.
template <Message M>
[[nodiscard]] Result<M, DecodeError> decode(Bytes data, const Profile& profile, DecodeFacts* facts = nullptr) {
  M message{};
  FieldReader reader{M::info, data, profile};
  M::visit(message, [&]<class T>(const FieldInfo& field, T&& member) {
    const auto bytes = reader.next(field);
    if constexpr (!std::same_as<std::remove_cvref_t<T>, ExcludedField>)
      if (bytes) detail::read_value(*bytes, member.emplace());
  });
  const auto noticed = reader.finish();
  if (!noticed) return fail(noticed.error());
  if (facts != nullptr) *facts = *noticed;
  return message;
}

/// Writes the message data to `out`, and returns how many bytes they are. `out` needs no more than `data_size_max`.
template <Message M>
[[nodiscard]] Result<std::size_t, EncodeError> encode(const M& message, const Profile& profile, MutableBytes out) {
  FieldWriter writer{M::info, out, profile};
  M::visit(message, [&]<class T>(const FieldInfo& field, const T& member) {
    if constexpr (!std::same_as<T, ExcludedField>)
      if (member) detail::write_value(writer, field, *member);
  });
  return writer.finish();
}

/// Encodes a message straight into a datagram, and returns its bytes, wrapper to checksum. Fails with `no_room` when
/// the message has to go into the next datagram, or into none if this one is empty. A failure leaves the datagram as it
/// was.
template <Message M>
[[nodiscard]] Result<Bytes, EncodeError> add_message(DatagramWriter& datagram, const Envelope& envelope,
                                                     const M& message) {
  const auto size = encode(message, datagram.profile(), datagram.room());
  if (!size) return fail(size.error());
  const auto added = datagram.add_in_place(envelope, M::info.number, *size);
  if (!added) return fail(EncodeError{EncodeError::Reason::no_room, 0});
  return *added;
}

}  // namespace ponte::dli
