#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

/// Fields of any message at run time, by their description instead of their type.
namespace ponte::mavlink {

/// One element of a field: the signed, unsigned and floating-point types of the wire; a character is its byte.
using FieldValue = std::variant<std::int64_t, std::uint64_t, float, double>;

/// Elements of the field: 1 if it is not an array.
[[nodiscard]] constexpr std::size_t element_count(const FieldInfo& field) {
  return field.array_length == 0 ? 1 : field.array_length;
}

/// Element `index` (below `element_count`) of a field. Bytes beyond the end of `payload` are zeros.
[[nodiscard]] FieldValue read_element(const FieldInfo& field, Bytes payload, std::size_t index = 0);

/// The text in an array of characters, up to its first NUL. Points into `payload`.
[[nodiscard]] std::string_view read_text(const FieldInfo& field, Bytes payload);

enum class FieldWriteError {
  out_of_range,  ///< the number does not fit the type of the field
  not_whole,     ///< a fraction, or no number, for a field of integers
  too_long,      ///< the text has more bytes than the field
};

/// Sets element `index` (below `element_count`) of a field in a payload of full length. Any kind of number is taken if
/// the field can hold it; in fields of floats it may lose precision, but a finite number never becomes infinite.
[[nodiscard]] Result<void, FieldWriteError> write_element(const FieldInfo& field, MutableBytes payload,
                                                          std::size_t index, const FieldValue& value);

/// Sets an array of characters in a payload of full length; what the text does not fill becomes NUL.
[[nodiscard]] Result<void, FieldWriteError> write_text(const FieldInfo& field, MutableBytes payload,
                                                       std::string_view text);

/// The name of exactly this value, or nothing.
[[nodiscard]] std::string_view label_of(const EnumInfo& enumeration, std::uint64_t value);

/// A value in words: its name; if it has none and belongs to a bitmask, the names of its bits, and those without one as
/// a number at the end: "A|B|64". Empty if nothing of it has a name.
[[nodiscard]] std::string words_of(const EnumInfo& enumeration, std::uint64_t value);

/// The value that such words stand for. Nothing if a word is no name of the enumeration; a bitmask may be given as
/// several words, and each of them may be a number.
[[nodiscard]] std::optional<std::uint64_t> value_of(const EnumInfo& enumeration, std::string_view words);

}  // namespace ponte::mavlink
