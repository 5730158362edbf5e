#include "ponte/definitions/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace ponte::definitions {

DefinitionError::DefinitionError(const Source& source, std::string_view what)
    : std::runtime_error{source.line == 0 ? fmt::format("{}: {}", source.file.string(), what)
                                          : fmt::format("{}:{}: {}", source.file.string(), source.line, what)} {}

const Enumeration* Protocol::find_enumeration(std::string_view wanted) const {
  const auto found = std::ranges::lower_bound(enumerations, wanted, {}, &Enumeration::name);
  return found != enumerations.end() && found->name == wanted ? &*found : nullptr;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file{path, std::ios::binary};
  if (!file || std::filesystem::is_directory(path)) throw DefinitionError{{path, 0}, "cannot be read"};
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

}  // namespace ponte::definitions
