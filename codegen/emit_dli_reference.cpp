#include "codegen/emit.hpp"
#include "ponte/definitions/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace ponte::codegen {
namespace {

std::string type_of(const Field& field) {
  switch (field.kind) {
    case Kind::unsigned_integer: return fmt::format("Unsigned {}", field.width);
    case Kind::signed_integer: return fmt::format("Integer {}", field.width);
    case Kind::bam: return fmt::format("BAM {}", field.width);
    case Kind::real: return "Float 4";
    case Kind::character:
      return field.width == 0 ? fmt::format("Character, length in field {}", field.length_from)
                              : fmt::format("Character {}", field.count);
  }
  return {};
}

std::string meaning_of(const Field& field) {
  if (field.excluded) return "out of scope: never sent, skipped when received";
  std::string text;
  const auto add = [&](std::string_view more) {
    if (more.empty()) return;
    if (!text.empty()) text += ", ";
    text += more;
  };
  add(field.scale != 0 ? fmt::format("{} {}", field.scale, field.unit) : field.unit);
  if (field.lacks_scale()) add("**scale not known**");
  if (!field.enumeration.empty())
    add(fmt::format("[{}](#{})", field.enumeration, field.enumeration));
  else
    add(field.role);
  if (field.since_edition_a) add("Edition A only");
  if (field.guessed) add("inferred");
  add(field.note);
  return text;
}

std::string message_section(const Message& message) {
  std::string text = fmt::format("### #{} {}\n\n", message.number, message.name);
  if (message.name_a != message.name) text += fmt::format("Edition A calls it {}. ", message.name_a);
  text += fmt::format("{}, {}. Editions:{}{}. Confidence: {}", message.direction, message.exchange,
                      message.in_edition[0] ? " 3" : "", message.in_edition[1] ? " A" : "", message.confidence);
  if (message.in_edition[0]) text += fmt::format(" (Edition 3: {})", message.confidence_ed3);
  text += fmt::format(". Source: {}.", fmt::join(message.sources, ", "));
  if (!message.levels.empty()) text += fmt::format(" Levels of interoperability: {}.", fmt::join(message.levels, ", "));
  if (message.number_ed2 != 0) text += fmt::format(" #{} in Edition 2.", message.number_ed2);
  if (message.latency_ms != 0) text += fmt::format(" Delay of at most {} ms.", message.latency_ms);
  if (message.partial) text += " **Partial.**";
  text += "\n\n";
  if (!message.note.empty()) text += message.note + "\n\n";
  if (message.fields.empty()) return text + "The field table is not known.\n\n";
  text += fmt::format("Presence vector: {} bytes in Edition 3, {} in Edition A (0: not there).\n\n",
                      message.presence_bytes[0], message.presence_bytes[1]);
  text += "| field | unique id | name | type | unit, scale, values |\n|---|---|---|---|---|\n";
  for (const auto& field : message.fields)
    text += fmt::format("| {} | {} | {} | {} | {} |\n", field.number, field.unique_id, table_cell(field.name),
                        type_of(field), table_cell(meaning_of(field)));
  return text + '\n';
}

}  // namespace

std::string emit_dli_reference(const Protocol& protocol) {
  std::string text =
      "# DLI messages\n\nMade from `definitions/dli/`, which says in its README.md where each entry comes from.\n\n";
  for (const auto& group : protocol.groups) {
    const auto in_group = [&](const Message& message) {
      return message.number >= group.first && message.number <= group.last;
    };
    const auto known = std::ranges::count_if(protocol.messages, in_group);
    const auto known_ed3 = std::ranges::count_if(
        protocol.messages, [&](const Message& message) { return in_group(message) && message.in_edition[0]; });
    text += fmt::format("## {} ({} to {})\n\nEdition 3 has {} messages here (table {}); {} of them are known to us",
                        group.name, group.first, group.last, group.message_count, group.table, known_ed3);
    text += known > known_ed3 ? fmt::format(", and {} of Edition A alone.\n\n", known - known_ed3) : ".\n\n";
    for (const auto& message : protocol.messages)
      if (in_group(message)) text += message_section(message);
  }
  text += "## Enumerations\n\n";
  for (const auto& enumeration : protocol.enumerations) {
    text += fmt::format("### {}\n\nConfidence: {}.\n\n", enumeration.name, enumeration.confidence);
    for (const auto& entry : enumeration.entries) {
      const auto value =
          entry.first == entry.last ? fmt::format("{}", entry.first) : fmt::format("{}-{}", entry.first, entry.last);
      text += fmt::format("- {}: {}{}\n", value, entry.name, entry.note.empty() ? "" : " (" + entry.note + ")");
    }
    text += enumeration.entries.empty() ? "The values are not known.\n\n" : "\n";
  }
  return text;
}

}  // namespace ponte::codegen
