#include "ponte/core/hex.hpp"

namespace ponte {
namespace {

constexpr int digit_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::string to_hex(Bytes bytes, std::string_view separator) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  text.reserve(bytes.size() * (2 + separator.size()));
  for (const auto byte : bytes) {
    if (!text.empty()) text += separator;
    const auto number = std::to_integer<std::size_t>(byte);
    text += digits[number >> 4];
    text += digits[number & 0xF];
  }
  return text;
}

Result<std::vector<std::byte>, HexError> parse_hex(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 2);
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      ++at;
      continue;
    }
    const int high = digit_value(text[at]);
    if (high < 0) return fail(HexError{at, HexError::Reason::not_a_hex_digit});
    if (at + 1 == text.size() || is_space(text[at + 1])) return fail(HexError{at, HexError::Reason::half_a_byte});
    const int low = digit_value(text[at + 1]);
    if (low < 0) return fail(HexError{at + 1, HexError::Reason::not_a_hex_digit});
    bytes.push_back(static_cast<std::byte>(high * 16 + low));
    at += 2;
  }
  return bytes;
}

}  // namespace ponte
