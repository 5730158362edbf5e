#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <cstddef>
#include <cstdint>
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

/// The name of exactly this value, or nothing. For one value of a bitmask, ask for each of its bits.
[[nodiscard]] std::string_view label_of(const EnumInfo& enumeration, std::uint64_t value);

}  // namespace ponte::mavlink
