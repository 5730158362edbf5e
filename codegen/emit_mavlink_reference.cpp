#include "codegen/emit.hpp"

#include <fmt/format.h>

namespace ponte::codegen {
namespace {

std::string type_of(const Field& field) {
  std::string name;
  switch (field.kind) {
    case Kind::character: name = "char"; break;
    case Kind::real: name = field.width == 4 ? "float" : "double"; break;
    case Kind::signed_integer: name = fmt::format("int{}_t", 8 * field.width); break;
    default: name = fmt::format("uint{}_t", 8 * field.width);
  }
  return field.count == 0 ? name : fmt::format("{}[{}]", name, field.count);
}

std::string meaning_of(const Field& field, bool descriptions) {
  std::string text;
  const auto add = [&](std::string_view more) {
    if (more.empty()) return;
    if (!text.empty()) text += "; ";
    text += more;
  };
  if (!field.enumeration.empty()) add(fmt::format("[{0}](#{0})", field.enumeration));
  if (!field.invalid.empty()) add(fmt::format("{} means unknown", field.invalid));
  if (field.extension) add("extension");
  if (descriptions) add(field.note);
  return text;
}

}  // namespace

std::string emit_mavlink_reference(const Protocol& protocol, bool descriptions) {
  auto text = fmt::format("# MAVLink messages: {}\n\n{} messages, {} enumerations.\n\n## Messages\n\n", protocol.name,
                          protocol.messages.size(), protocol.enumerations.size());
  for (const auto& message : protocol.messages) {
    text += fmt::format("### {} ({})\n\n", message.name, message.number);
    if (descriptions && !message.note.empty()) text += message.note + "\n\n";
    text +=
        fmt::format("{} bytes, with extensions {}.\n\n| field | type | unit | values, meaning |\n|---|---|---|---|\n",
                    message.base_length, message.full_length);
    for (const auto& field : message.fields)
      text += fmt::format("| {} | {} | {} | {} |\n", field.name, type_of(field), table_cell(field.unit),
                          table_cell(meaning_of(field, descriptions)));
    text += '\n';
  }
  text += "## Enumerations\n\n";
  for (const auto& enumeration : protocol.enumerations) {
    text += fmt::format("### {}\n\n{}", enumeration.name, enumeration.bitmap ? "A bitmask.\n\n" : "");
    for (const auto& entry : enumeration.entries) text += fmt::format("- {}: {}\n", entry.first, entry.name);
    text += '\n';
  }
  return text;
}

}  // namespace ponte::codegen
