#pragma once

#include "ponte/mavlink/message_info.hpp"

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

/// Messages that are known only while the program runs.
namespace ponte::reflection {

/// A MAVLink dialect that was read from XML: the tables that a generated dialect has, and everything they point to.
/// The tables stay where they are when the object is moved.
class DialectFile {
 public:
  DialectFile(DialectFile&&) noexcept;
  DialectFile& operator=(DialectFile&&) noexcept;
  ~DialectFile();

  /// Valid as long as this object, or the one it was moved to. Of a file with wire="0.9"
  /// (definitions/mavlink/README.md) it is what belongs into the `v09` of another dialect.
  [[nodiscard]] const mavlink::Dialect& dialect() const;

 private:
  struct Tables;
  explicit DialectFile(std::unique_ptr<const Tables> tables);
  friend DialectFile load_dialect(const std::filesystem::path&, const std::vector<std::filesystem::path>&);
  friend DialectFile parse_dialect(std::string_view, const std::filesystem::path&);

  std::unique_ptr<const Tables> tables_;
};

/// Reads a dialect with everything it includes. An include is looked for beside the file that names it, then in the
/// folders of `search_path`. Throws `definitions::DefinitionError`: "file:line: what was wrong and what was expected".
[[nodiscard]] DialectFile load_dialect(const std::filesystem::path& file,
                                       const std::vector<std::filesystem::path>& search_path = {});

/// The same from a text in memory, where includes are refused. `name` names the dialect, and the text in errors.
[[nodiscard]] DialectFile parse_dialect(std::string_view text, const std::filesystem::path& name);

/// The messages of two dialects by id, ascending; where both have one with the same id, in MAVLink 0.9 also of the same
/// length, that of `first`.
[[nodiscard]] std::vector<const mavlink::MessageInfo*> messages_of(const mavlink::Dialect& first,
                                                                   const mavlink::Dialect& second);

}  // namespace ponte::reflection
