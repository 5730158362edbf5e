#pragma once

#include "ponte/reflection/dialect_file.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ponte::app {

/// Adds `--dialect FILE`.
void add_dialect_option(CLI::App& command, std::string& file);

/// The messages that a command knows: those of `--dialect FILE`, then those that we are built with. It stays where it
/// is.
class ChosenDialect {
 public:
  /// An empty `file` means ours alone. Includes are looked for beside the file and among the definitions that are
  /// installed with the program. Throws `Failure` with file, line and reason.
  explicit ChosenDialect(const std::string& file);
  ChosenDialect(const ChosenDialect&) = delete;
  ChosenDialect& operator=(const ChosenDialect&) = delete;

  [[nodiscard]] const mavlink::Dialect& dialect() const { return dialect_; }

 private:
  std::optional<reflection::DialectFile> own_;
  std::vector<const mavlink::MessageInfo*> messages_;
  mavlink::Dialect v09_;
  mavlink::Dialect dialect_;
};

}  // namespace ponte::app
