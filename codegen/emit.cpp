#include "codegen/emit.hpp"

#include "ponte/definitions/names.hpp"

#include <fmt/format.h>

#include <fstream>

namespace ponte::codegen {

std::string emit_all_header(const std::vector<const Message*>& messages, std::string_view include_folder,
                            std::string_view name_space, std::string_view id_type) {
  std::string includes;
  std::string cases;
  std::string calls;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const auto& message = *messages[i];
    const auto call = fmt::format("f.template operator()<{}>();", pascal_case(message.key));
    includes += fmt::format("#include \"{}/{}.hpp\"\n", include_folder, message.key);
    calls += fmt::format("  {}\n", call);
    if (i == 0 || messages[i - 1]->number != message.number) cases += fmt::format("    case {}:", message.number);
    cases += ' ' + call;
    if (i + 1 == messages.size() || messages[i + 1]->number != message.number) cases += " return true;\n";
  }
  return fmt::format(R"({}#pragma once

{}
namespace {} {{

/// Calls `f.template operator()<M>()` with the message type that has this number; several may, in MAVLink 0.9 alone.
/// False when there is none.
template <class F>
bool with_message({} number, F&& f) {{
  switch (number.value) {{
{}    default: return false;
  }}
}}

/// Calls `f.template operator()<M>()` for every message type.
template <class F>
void for_each_message(F&& f) {{
{}}}

}}  // namespace {}
)",
                     generated_notice, includes, name_space, id_type, cases, calls, name_space);
}

std::string table_cell(std::string_view written) {
  auto text = one_line(written);
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string unsigned_type_for(std::uint64_t largest) {
  for (const unsigned bits : {8U, 16U, 32U})
    if (largest >> bits == 0) return fmt::format("std::uint{}_t", bits);
  return "std::uint64_t";
}

void write_files(const Files& files, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::recursive_directory_iterator{folder})
    if (entry.is_regular_file() && !files.contains(std::filesystem::relative(entry.path(), folder)) &&
        read_file(entry.path()).starts_with(generated_notice))
      std::filesystem::remove(entry.path());
  for (const auto& [name, text] : files) {
    const auto path = folder / name;
    if (std::filesystem::exists(path) && read_file(path) == text) continue;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file{path, std::ios::binary};
    file << text;
    file.close();
    if (!file) throw DefinitionError{{path, 0}, "cannot be written"};
  }
}

}  // namespace ponte::codegen
