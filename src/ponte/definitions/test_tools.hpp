#pragma once

#include "ponte/definitions/model.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

/// What tests of definitions need.
namespace ponte::definitions {

/// The text with which `read` refuses its definition.
template <class Read>
[[nodiscard]] std::string refusal_of(Read&& read) {
  try {
    static_cast<void>(read());
  } catch (const DefinitionError& error) {
    return error.what();
  }
  return "(nothing was refused)";
}

/// `text` with the first `old` replaced; that `old` is not there fails the test.
[[nodiscard]] inline std::string replaced(std::string_view text, std::string_view old, std::string_view by) {
  const auto at = text.find(old);
  if (at == std::string_view::npos) {
    ADD_FAILURE() << "'" << old << "' is not in the text";
    return {};
  }
  return std::string{text}.replace(at, old.size(), by);
}

/// The message with this number, which must exist.
[[nodiscard]] inline const Message& message_of(const Protocol& protocol, std::uint32_t number) {
  const auto found = std::ranges::find(protocol.messages, number, &Message::number);
  if (found == protocol.messages.end()) throw std::out_of_range{"no message " + std::to_string(number)};
  return *found;
}

/// The field with this name, which must exist.
[[nodiscard]] inline const Field& field_of(const Message& message, std::string_view name) {
  const auto found = std::ranges::find(message.fields, name, &Field::name);
  if (found == message.fields.end()) throw std::out_of_range{"no field " + std::string{name}};
  return *found;
}

/// An empty folder that goes away with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    auto name = (std::filesystem::temp_directory_path() / "ponte-definitions-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::system_error{errno, std::generic_category(), name};
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file, with the folders above it, and returns its path.
  std::filesystem::path write(const std::filesystem::path& name, std::string_view text) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream{file, std::ios::binary} << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace ponte::definitions
