#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/dli/message_info.hpp"

#include <cstdint>

/// Integers of 1 to 5 bytes, most significant byte first (Edition 3, data types). 3 and 5 bytes are normal.
namespace ponte::dli {

/// Any width from 1 to 8 bytes: presence vectors are wider than fields.
[[nodiscard]] constexpr std::uint64_t load_unsigned(Bytes bytes) {
  std::uint64_t value = 0;
  for (const auto byte : bytes) value = value << 8U | std::to_integer<std::uint64_t>(byte);
  return value;
}

/// Two's complement of the bytes' own width.
[[nodiscard]] constexpr std::int64_t load_signed(Bytes bytes) {
  const auto unused_bits = 64U - 8U * static_cast<unsigned>(bytes.size());
  return static_cast<std::int64_t>(load_unsigned(bytes) << unused_bits) >> unused_bits;
}

/// Writes the low bytes of `value`, as many as `bytes` has.
constexpr void store_integer(MutableBytes bytes, std::uint64_t value) {
  for (std::size_t i = bytes.size(); i-- > 0; value >>= 8U) bytes[i] = static_cast<std::byte>(value & 0xFFU);
}

/// What an integer of some width can hold.
struct IntegerRange {
  std::int64_t first;
  std::int64_t last;

  [[nodiscard]] constexpr bool holds(std::int64_t value) const { return value >= first && value <= last; }
  friend constexpr bool operator==(const IntegerRange&, const IntegerRange&) = default;
};

/// `width` is 1 to 5.
[[nodiscard]] constexpr IntegerRange unsigned_range(std::uint8_t width) {
  return {0, (std::int64_t{1} << (8U * width)) - 1};
}

[[nodiscard]] constexpr IntegerRange signed_range(std::uint8_t width) {
  const auto half = std::int64_t{1} << (8U * width - 1U);
  return {-half, half - 1};
}

[[nodiscard]] constexpr bool is_integer(FieldType type) {
  return type == FieldType::unsigned_integer || type == FieldType::signed_integer || type == FieldType::bam;
}

/// The range of an integer field. To be asked of integer fields only.
[[nodiscard]] constexpr IntegerRange range_of(const FieldInfo& field) {
  return field.type == FieldType::unsigned_integer ? unsigned_range(field.width) : signed_range(field.width);
}

/// The raw value of an integer field, from its bytes on the wire. To be asked of integer fields only.
[[nodiscard]] constexpr std::int64_t raw_integer(const FieldInfo& field, Bytes bytes) {
  if (field.type == FieldType::unsigned_integer) return static_cast<std::int64_t>(load_unsigned(bytes));
  return load_signed(bytes);
}

}  // namespace ponte::dli
