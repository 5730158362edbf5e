#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ponte {

/// `bytes` as lower-case hex digits, with `separator` between any two bytes.
[[nodiscard]] std::string to_hex(Bytes bytes, std::string_view separator = "");

/// Where and why a text is not hex.
struct HexError {
  std::size_t position;
  enum class Reason { not_a_hex_digit, half_a_byte } reason;
  friend bool operator==(const HexError&, const HexError&) = default;
};

/// Reads pairs of hex digits; white space may stand between bytes, not inside one.
[[nodiscard]] Result<std::vector<std::byte>, HexError> parse_hex(std::string_view text);

}  // namespace ponte
