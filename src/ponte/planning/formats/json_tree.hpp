#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::planning {

/// A value of a JSON text that knows where it stands, so that a reader can say which one is wrong.
struct JsonValue {
  enum class Kind : std::uint8_t { null, boolean, number, text, array, object };

  Kind kind{};
  bool truth{};
  double number{};
  std::string text{};
  std::string name{};                 ///< of a member of an object
  std::vector<JsonValue> elements{};  ///< or members, in the order of the text, each name once
  std::size_t line{};                 ///< from 1; of an array or object, where it begins
  std::size_t begin{};                ///< of an array or object: its first byte in the text
  std::size_t end{};                  ///< and the one after its last

  /// The member of the wanted name; null pointer: there is none, or this is no object.
  [[nodiscard]] const JsonValue* find(std::string_view wanted) const;
};

/// Reads a JSON text. Throws `FormatError`, also for what is nested deeper than 64 levels or names a member twice.
[[nodiscard]] JsonValue parse_json(std::string_view text);

/// The value as it would stand in a message: `47.3`, `"text"`, `an array`, ...
[[nodiscard]] std::string shown(const JsonValue& value);

// What a reader expects of a value. These throw `FormatError`; `name` is the value's own, for the message.

[[nodiscard]] double number_of(const JsonValue& value, std::string_view name);
[[nodiscard]] const std::vector<JsonValue>& elements_of(const JsonValue& value, std::string_view name);
[[nodiscard]] std::string_view text_of(const JsonValue& value, std::string_view name);
/// The member of an object; refused when it is missing.
[[nodiscard]] const JsonValue& member_of(const JsonValue& object, std::string_view name);

}  // namespace ponte::planning
