#pragma once

#include "ponte/core/bytes.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the text formats share.
namespace ponte::planning {

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The bytes as text, without a byte order mark. Throws `FormatError` where they are not UTF-8.
[[nodiscard]] std::string_view text_in(Bytes bytes);
[[nodiscard]] std::vector<std::byte> bytes_from(std::string_view text);

/// Without the white space around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// ASCII letters only.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The whole text as a finite decimal number: a sign, digits, a dot, an exponent.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

/// The shortest text without an exponent that `number_in` reads as this very number, which is finite.
[[nodiscard]] std::string decimal_text(double number);

}  // namespace ponte::planning
