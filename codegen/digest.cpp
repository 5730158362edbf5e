#include "codegen/digest.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace ponte::codegen {
namespace {

constexpr std::string_view header =
    "# id crc_extra base_length full_length name; made by `ponte_codegen mavlink --write-digest`\n";
constexpr std::size_t most_differences_told = 20;

std::string line_of(const Message& message) {
  return fmt::format("{} {} {} {} {}", message.number, message.crc_extra, message.base_length, message.full_length,
                     message.name);
}

/// Line number and text of each entry, by message id.
std::map<std::uint32_t, std::pair<std::size_t, std::string>> read_digest(const std::filesystem::path& path) {
  std::map<std::uint32_t, std::pair<std::size_t, std::string>> entries;
  std::istringstream text{read_file(path)};
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::uint32_t id{};
    if (!(std::istringstream{line} >> id))
      throw DefinitionError{{path, number}, fmt::format("'{}': a message id was expected first", line)};
    entries[id] = {number, line};
  }
  return entries;
}

}  // namespace

std::string digest_of(const Protocol& protocol) {
  std::string text{header};
  for (const auto& message : protocol.messages) text += line_of(message) + '\n';
  return text;
}

void check_digest(const Protocol& protocol, const std::filesystem::path& digest_file) {
  auto expected = read_digest(digest_file);
  std::size_t differences = 0;
  std::string told;
  const auto tell = [&](const Source& source, std::string_view found, std::string_view wanted) {
    if (++differences <= most_differences_told)
      told += fmt::format("\n  {}:{}: '{}', the digest has '{}'", source.file.string(), source.line, found, wanted);
  };
  for (const auto& message : protocol.messages) {
    const auto entry = expected.find(message.number);
    if (entry == expected.end()) {
      tell(message.source, line_of(message), "nothing");
      continue;
    }
    if (entry->second.second != line_of(message)) tell(message.source, line_of(message), entry->second.second);
    expected.erase(entry);
  }
  for (const auto& [id, entry] : expected) tell({digest_file, entry.first}, "no such message", entry.second);
  if (differences > most_differences_told) told += fmt::format("\n  and {} more", differences - most_differences_told);
  if (differences > 0)
    throw DefinitionError{{digest_file, 0},
                          fmt::format("the definitions differ from the digest in {} messages. A changed message is "
                                      "another message on the wire: check it against a peer before the digest is "
                                      "written anew.{}",
                                      differences, told)};
}

}  // namespace ponte::codegen
