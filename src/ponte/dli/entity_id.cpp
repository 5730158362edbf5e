#include "ponte/dli/entity_id.hpp"

#include <array>
#include <optional>

namespace ponte::dli {
namespace {

constexpr std::size_t text_size = Text<11>::capacity;

std::optional<std::uint32_t> digit_value(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A' + 10);
  if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a' + 10);
  return std::nullopt;
}

constexpr bool is_colon(std::size_t position) { return position % 3 == 2; }

}  // namespace

std::string_view name_of(EntityType type) {
  constexpr auto names = std::to_array<std::string_view>({"unspecified", "CUCS", "vehicle", "VSM", "data link"});
  const auto index = static_cast<std::size_t>(type);
  return index < names.size() ? names[index] : "unassigned";
}

Text<11> to_text(EntityId id) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  Text<11> text;
  auto rest = id.value;
  for (std::size_t i = text_size; i-- > 0;) {
    if (is_colon(i)) {
      text.chars()[i] = ':';
      continue;
    }
    text.chars()[i] = digits[rest & 0xFU];
    rest >>= 4U;
  }
  return text;
}

Result<EntityId, EntityIdError> parse_entity_id(std::string_view text) {
  if (text.size() != text_size) return fail(EntityIdError::not_four_bytes);
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < text_size; ++i) {
    if (is_colon(i)) {
      if (text[i] != ':') return fail(EntityIdError::not_four_bytes);
      continue;
    }
    const auto digit = digit_value(text[i]);
    if (!digit) return fail(EntityIdError::not_a_hex_digit);
    value = value << 4U | *digit;
  }
  return EntityId{value};
}

}  // namespace ponte::dli
