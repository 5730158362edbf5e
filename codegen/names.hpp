#pragma once

#include <string>
#include <string_view>

namespace ponte::codegen {

/// "Roll Rate", "U_Speed", "ATTITUDE" and "Waypoint - Latitude" in snake_case. A C++ keyword, and a name that
/// generated structs use themselves, gets a trailing underscore; what would begin with a digit a leading one.
[[nodiscard]] std::string snake_case(std::string_view name);

/// The same in PascalCase.
[[nodiscard]] std::string pascal_case(std::string_view name);

/// `text` as a C++ string literal, quotes included.
[[nodiscard]] std::string literal(std::string_view text);

/// `text` in one line, with white space folded, for a comment.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace ponte::codegen
