#pragma once

#include <string>
#include <string_view>

namespace ponte::definitions {

/// "Roll Rate", "U_Speed", "ATTITUDE" and "Waypoint - Latitude" in snake_case. A C++ keyword, and a name that
/// generated structs use themselves, gets a trailing underscore; what would begin with a digit a leading one.
[[nodiscard]] std::string snake_case(std::string_view name);

/// The same in PascalCase.
[[nodiscard]] std::string pascal_case(std::string_view name);

/// True when `name` can stand in C++ as it is: ASCII letters, digits and underscores, no digit first, no keyword.
[[nodiscard]] bool is_identifier(std::string_view name);

/// `text` as a C++ string literal, quotes included. Control characters become spaces.
[[nodiscard]] std::string literal(std::string_view text);

/// `text` in one line, with white space folded and without a backslash at the end, for a comment.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace ponte::definitions
