#pragma once

#include "ponte/core/bytes.hpp"

#include <cstdint>

/// The checksum by carry-less multiplication, which some processors have. Only crc.cpp includes this.
namespace ponte::mavlink::detail {

/// Fewer bytes are left to the tables.
inline constexpr std::size_t least_multiplied = 16;

/// Whether this processor can do it.
[[nodiscard]] bool can_multiply();

/// `crc_of` for at least `least_multiplied` bytes, if the processor can do it.
[[nodiscard]] std::uint16_t crc_by_multiplication(Bytes bytes, std::uint16_t before);

}  // namespace ponte::mavlink::detail
