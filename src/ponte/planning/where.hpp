#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ponte::planning {

/// A spot in a file, for messages.
struct Where {
  enum class Unit : std::uint8_t { nowhere, line, byte };
  Unit unit{};
  std::size_t number{};  ///< lines from 1, bytes from 0
  friend bool operator==(const Where&, const Where&) = default;
};

[[nodiscard]] inline Where at_line(std::size_t line) { return {Where::Unit::line, line}; }
[[nodiscard]] inline Where at_byte(std::size_t offset) { return {Where::Unit::byte, offset}; }

/// "line 7", "byte 16", or "the file".
[[nodiscard]] inline std::string to_text(const Where& where) {
  switch (where.unit) {
    case Where::Unit::line: return "line " + std::to_string(where.number);
    case Where::Unit::byte: return "byte " + std::to_string(where.number);
    case Where::Unit::nowhere: break;
  }
  return "the file";
}

}  // namespace ponte::planning
