#pragma once

#include "ponte/core/bytes.hpp"

#include <cstddef>
#include <cstdint>

namespace ponte::mavlink {

/// What a MAVLink checksum is before its first byte.
inline constexpr std::uint16_t crc_initial = 0xFFFF;

namespace detail {

/// Whether this processor can multiply without carries. Until that is known, at the start of a program, it is not done.
extern const bool multiplies;
/// Fewer bytes are left to the tables.
inline constexpr std::size_t least_multiplied = 16;

/// Only where `multiplies`.
[[nodiscard]] std::uint16_t crc_by_multiplication(Bytes bytes, std::uint16_t before);
[[nodiscard]] std::uint16_t crc_by_tables(Bytes bytes, std::uint16_t before);

}  // namespace detail

/// CRC-16/MCRF4XX (reflected polynomial 0x8408, no final inversion), which MAVLink calls X.25. To go on where an
/// earlier call stopped, pass its result as `before`.
[[nodiscard]] inline std::uint16_t crc_of(Bytes bytes, std::uint16_t before = crc_initial) {
  if (detail::multiplies && bytes.size() >= detail::least_multiplied)
    return detail::crc_by_multiplication(bytes, before);
  return detail::crc_by_tables(bytes, before);
}

/// The same for one more byte, such as the crc_extra of a message.
[[nodiscard]] constexpr std::uint16_t crc_of(std::uint8_t byte, std::uint16_t before) {
  const unsigned low = (before ^ byte) & 0xFFU;
  const unsigned mixed = (low ^ low << 4U) & 0xFFU;
  return static_cast<std::uint16_t>(unsigned{before} >> 8U ^ mixed << 8U ^ mixed << 3U ^ mixed >> 4U);
}

}  // namespace ponte::mavlink
