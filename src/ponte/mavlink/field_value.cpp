#include "ponte/mavlink/field_value.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace ponte::mavlink {
namespace {

/// Calls `function` with a zero of the C++ type that carries a `type`.
template <class Function>
auto with_type(FieldType type, Function&& function) {
  switch (type) {
    case FieldType::int8: return function(std::int8_t{});
    case FieldType::uint16: return function(std::uint16_t{});
    case FieldType::int16: return function(std::int16_t{});
    case FieldType::uint32: return function(std::uint32_t{});
    case FieldType::int32: return function(std::int32_t{});
    case FieldType::uint64: return function(std::uint64_t{});
    case FieldType::int64: return function(std::int64_t{});
    case FieldType::float32: return function(float{});
    case FieldType::float64: return function(double{});
    case FieldType::character:
    case FieldType::uint8: break;
  }
  return function(std::uint8_t{});
}

template <class T>
FieldValue widened(T value) {
  if constexpr (std::floating_point<T>)
    return value;
  else if constexpr (std::is_signed_v<T>)
    return std::int64_t{value};
  else
    return std::uint64_t{value};
}

template <std::floating_point To, class From>
Result<To, FieldWriteError> converted(From value) {
  const auto result = static_cast<To>(value);
  if constexpr (std::floating_point<From>)
    if (std::isfinite(value) && !std::isfinite(result)) return fail(FieldWriteError::out_of_range);
  return result;
}

template <std::integral To, std::integral From>
Result<To, FieldWriteError> converted(From value) {
  if (!std::in_range<To>(value)) return fail(FieldWriteError::out_of_range);
  return static_cast<To>(value);
}

template <std::integral To, std::floating_point From>
Result<To, FieldWriteError> converted(From value) {
  if (!(std::trunc(value) == value)) return fail(FieldWriteError::not_whole);
  // The limits are powers of two, which floats of any width represent exactly; the upper one is outside.
  const auto upper = std::ldexp(1.0, std::numeric_limits<To>::digits);
  const auto lower = std::is_signed_v<To> ? -upper : 0.0;
  if (!(value >= lower && value < upper)) return fail(FieldWriteError::out_of_range);
  return static_cast<To>(value);
}

std::optional<std::uint64_t> value_of_word(const EnumInfo& enumeration, std::string_view word) {
  const auto named = std::ranges::find(enumeration.entries, word, &EnumEntry::name);
  if (named != enumeration.entries.end()) return named->value;
  std::uint64_t number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  return enumeration.bitmask && is_number ? std::optional{number} : std::nullopt;
}

template <class T>
T load_number(const FieldInfo& field, const std::byte* at) {
  return field.big_endian ? load_be<T>(at) : load_le<T>(at);
}

}  // namespace

FieldValue read_element(const FieldInfo& field, Bytes payload, std::size_t index) {
  PONTE_ASSERT(index < element_count(field));
  const auto at = field.offset + index * size_of(field.type);
  std::array<std::byte, 8> bytes{};
  if (at < payload.size()) {
    const auto present = payload.subspan(at);
    std::copy_n(present.begin(), std::min<std::size_t>(present.size(), size_of(field.type)), bytes.begin());
  }
  return with_type(field.type, [&](auto zero) { return widened(load_number<decltype(zero)>(field, bytes.data())); });
}

std::string_view read_text(const FieldInfo& field, Bytes payload) {
  if (field.offset >= payload.size()) return {};
  const auto present = payload.subspan(field.offset);
  const auto bytes = present.first(std::min(present.size(), field.size()));
  const auto end = std::find(bytes.begin(), bytes.end(), std::byte{0});
  return {reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(end - bytes.begin())};
}

Result<void, FieldWriteError> write_element(const FieldInfo& field, MutableBytes payload, std::size_t index,
                                            const FieldValue& value) {
  PONTE_ASSERT(index < element_count(field) && field.offset + field.size() <= payload.size());
  std::byte* const at = &payload[field.offset + index * size_of(field.type)];
  return with_type(field.type, [&](auto zero) -> Result<void, FieldWriteError> {
    const auto number = std::visit([](auto any) { return converted<decltype(zero)>(any); }, value);
    if (!number) return fail(number.error());
    field.big_endian ? store_be(at, *number) : store_le(at, *number);
    return {};
  });
}

Result<void, FieldWriteError> write_text(const FieldInfo& field, MutableBytes payload, std::string_view text) {
  PONTE_ASSERT(field.offset + field.size() <= payload.size());
  if (text.size() > field.size()) return fail(FieldWriteError::too_long);
  const auto place = payload.subspan(field.offset, field.size());
  std::fill(place.begin(), place.end(), std::byte{0});
  const auto bytes = bytes_of(text);
  std::copy(bytes.begin(), bytes.end(), place.begin());
  return {};
}

std::string_view label_of(const EnumInfo& enumeration, std::uint64_t value) {
  const auto at = std::lower_bound(enumeration.entries.begin(), enumeration.entries.end(), value,
                                   [](const EnumEntry& entry, std::uint64_t wanted) { return entry.value < wanted; });
  return at != enumeration.entries.end() && at->value == value ? at->name : std::string_view{};
}

std::string words_of(const EnumInfo& enumeration, std::uint64_t value) {
  if (const auto name = label_of(enumeration, value); !name.empty()) return std::string{name};
  if (!enumeration.bitmask) return {};
  std::string words;
  for (const auto& entry : enumeration.entries) {
    if (!std::has_single_bit(entry.value) || (value & entry.value) == 0) continue;
    value &= ~entry.value;
    words.append(entry.name) += '|';
  }
  if (words.empty()) return {};
  if (value != 0) return words + std::to_string(value);
  words.pop_back();
  return words;
}

std::optional<std::uint64_t> value_of(const EnumInfo& enumeration, std::string_view words) {
  std::uint64_t value = 0;
  while (true) {
    const auto bar = enumeration.bitmask ? words.find('|') : words.npos;
    const auto bits = value_of_word(enumeration, words.substr(0, bar));
    if (!bits) return std::nullopt;
    value |= *bits;
    if (bar == words.npos) return value;
    words.remove_prefix(bar + 1);
  }
}

}  // namespace ponte::mavlink
