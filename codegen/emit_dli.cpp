#include "codegen/emit.hpp"
#include "ponte/definitions/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace ponte::codegen {
namespace {

constexpr std::size_t longest_variable_text = 255;

std::string member_type(const Field& field) {
  if (field.kind == Kind::character)
    return fmt::format("Text<{}>", field.width == 0 ? longest_variable_text : field.count);
  if (field.kind == Kind::real) return "float";
  const auto bits = field.width == 1 ? 8 : field.width == 2 ? 16 : field.width <= 4 ? 32 : 64;
  return fmt::format("std::{}int{}_t", field.kind == Kind::unsigned_integer ? "u" : "", bits);
}

std::string_view type_name(const Field& field) {
  switch (field.kind) {
    case Kind::unsigned_integer: return "unsigned_integer";
    case Kind::signed_integer: return "signed_integer";
    case Kind::bam: return "bam";
    case Kind::real: return "float32";
    case Kind::character: return field.width == 0 ? "variable_text" : "text";
  }
  return "";
}

std::string_view role_name(const Field& field) {
  if (field.role.empty()) return "value";
  return field.role == "enum" ? "enumeration" : std::string_view{field.role};
}

std::string confidence_name(std::string_view confidence) {
  std::string name{confidence};
  std::ranges::replace(name, '-', '_');
  return "Confidence::" + name;
}

/// A shortest text that reads back as the same number and is a double in C++.
std::string real(double value) {
  auto text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string scale_of(const Field& field) {
  if (field.kind == Kind::bam) return fmt::format("bam_scale({})", field.width);
  return real(field.scale);
}

std::string comment(const Field& field) {
  std::string text = field.unit;
  const auto add = [&](std::string_view more) {
    if (more.empty()) return;
    if (!text.empty()) text += "; ";
    text += more;
  };
  if (field.scale != 0) add(fmt::format("raw * {}", field.scale));
  if (field.kind == Kind::bam) add("binary angle");
  add(field.enumeration);
  if (field.since_edition_a) add("Edition A only");
  if (field.guessed) add("type or scale inferred");
  add(field.note);
  return text.empty() ? "" : "  ///< " + one_line(text);
}

std::string message_info(const Message& message, std::string_view fields) {
  return fmt::format("MessageInfo{{MessageNumber{{{}}}, {}, {}, {}, {{{{{}, {}}}}}, {{{{{}, {}}}}}, {}, {}, {}, {}}}",
                     message.number, literal(message.key), literal(message.name), literal(message.name_a),
                     message.presence_bytes[0], message.presence_bytes[1], message.in_edition[0], message.in_edition[1],
                     confidence_name(message.confidence), confidence_name(message.confidence_ed3), message.partial,
                     fields);
}

std::string message_header(const Message& message) {
  std::string members;
  std::string visits;
  std::string rows;
  bool texts = false;
  bool enumerations = false;
  for (std::size_t i = 0; i < message.fields.size(); ++i) {
    const auto& field = message.fields[i];
    if (!field.excluded)
      members += fmt::format("  std::optional<{}> {}{{}};{}\n", member_type(field), field.key, comment(field));
    visits += field.excluded ? fmt::format("    visitor(fields[{}], ExcludedField{{}});\n", i)
                             : fmt::format("    visitor(fields[{}], self.{});\n", i, field.key);
    rows += fmt::format("      {{{}, {}, {}, {}, FieldType::{}, {}, {}, Role::{}, {}, {}, {}, {}, {}, {}}},\n",
                        field.number, literal(field.key), literal(field.name), literal(field.unique_id),
                        type_name(field), field.size(), field.length_from, role_name(field), scale_of(field),
                        literal(field.unit), field.enumeration.empty() ? "nullptr" : "&enum_info::" + field.enumeration,
                        field.since_edition_a, field.excluded, field.guessed);
    texts |= field.kind == Kind::character;
    enumerations |= !field.enumeration.empty();
  }
  const auto type = pascal_case(message.key);
  std::string includes;
  if (texts) includes += "#include \"ponte/core/text.hpp\"\n";
  includes += "#include \"ponte/dli/message_info.hpp\"\n";
  if (enumerations) includes += "#include \"ponte/dli/messages/enumerations.hpp\"\n";
  return fmt::format(R"({notice}#pragma once

{includes}
#include <array>
#include <cstdint>
#include <optional>

namespace ponte::dli::messages {{

/// #{number} {name}.{note} The values are as on the wire; an absent field means "no new data".
struct {type} {{
{members}
  // clang-format off
  static constexpr std::array<FieldInfo, {count}> fields{{{{
{rows}  }}}};
  // clang-format on
  static constexpr MessageInfo info = {info};

  /// Calls `visitor(field_info, member)` for each field in the order of the standard; the member of a field that is out
  /// of scope is an `ExcludedField`.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {{
{visits}  }}

  friend bool operator==(const {type}&, const {type}&) = default;
}};

}}  // namespace ponte::dli::messages
)",
                     fmt::arg("notice", generated_notice), fmt::arg("includes", includes),
                     fmt::arg("number", message.number), fmt::arg("name", message.name),
                     fmt::arg("note", message.note.empty() ? "" : " " + one_line(message.note)), fmt::arg("type", type),
                     fmt::arg("members", members), fmt::arg("count", message.fields.size()), fmt::arg("rows", rows),
                     fmt::arg("info", message_info(message, "fields")), fmt::arg("visits", visits));
}

std::string enumerations_header(const Protocol& protocol) {
  std::string text;
  std::string infos;
  for (const auto& enumeration : protocol.enumerations) {
    infos += fmt::format("extern const EnumInfo {};\n", enumeration.name);
    std::string constants;
    std::set<std::string> keys;
    for (const auto& entry : enumeration.entries) {
      const auto key = snake_case(entry.name);
      if (entry.first == entry.last && key != "reserved" && keys.insert(key).second)
        constants += fmt::format("inline constexpr {} {} = {};{}\n", unsigned_type_for(entry.last), key, entry.first,
                                 entry.note.empty() ? "" : "  ///< " + one_line(entry.note));
    }
    if (!constants.empty())
      text += fmt::format("namespace {} {{\n{}}}  // namespace {}\n\n", enumeration.name, constants, enumeration.name);
  }
  return fmt::format(R"({}#pragma once

#include "ponte/dli/message_info.hpp"

/// The values of enumerations and the bits of bitmaps, one namespace each. The fields of messages are plain integers,
/// since a vehicle may have values of its own.
namespace ponte::dli {{

{}namespace enum_info {{
{}}}  // namespace enum_info

}}  // namespace ponte::dli
)",
                     generated_notice, text, infos);
}

std::string enumerations_source(const Protocol& protocol) {
  std::string tables;
  for (const auto& enumeration : protocol.enumerations) {
    tables += fmt::format("namespace {{\nconstexpr std::array<EnumEntry, {}> entries_{}{{{{\n",
                          enumeration.entries.size(), enumeration.name);
    for (const auto& entry : enumeration.entries)
      tables += fmt::format("    {{{}, {}, {}}},\n", entry.first, entry.last, literal(entry.name));
    tables += fmt::format("}}}};\n}}  // namespace\nconst EnumInfo {}{{{}, {}, {}, entries_{}}};\n\n", enumeration.name,
                          literal(enumeration.name), confidence_name(enumeration.confidence), enumeration.bitmap,
                          enumeration.name);
  }
  return fmt::format(R"({}#include "ponte/dli/messages/enumerations.hpp"

#include <array>

namespace ponte::dli::enum_info {{

{}}}  // namespace ponte::dli::enum_info
)",
                     generated_notice, tables);
}

std::string catalogue_header() {
  return fmt::format(R"({}#pragma once

#include "ponte/dli/message_info.hpp"

namespace ponte::dli::messages {{

/// Every message that the definitions name, also those of which only the number is known.
extern const Catalogue catalogue;

}}  // namespace ponte::dli::messages
)",
                     generated_notice);
}

std::string catalogue_source(const Protocol& protocol) {
  std::string bare;
  std::string list;
  for (const auto& message : protocol.messages) {
    if (message.fields.empty()) {
      bare += fmt::format("constexpr MessageInfo {} = {};\n", message.key, message_info(message, "{}"));
      list += fmt::format("    &{},\n", message.key);
    } else {
      list += fmt::format("    &{}::info,\n", pascal_case(message.key));
    }
  }
  return fmt::format(R"({}#include "ponte/dli/messages/catalogue.hpp"

#include "ponte/dli/messages/all.hpp"

namespace ponte::dli::messages {{
namespace {{

{}
constexpr std::array<const MessageInfo*, {}> all{{{{
{}}}}};

}}  // namespace

const Catalogue catalogue{{all}};

}}  // namespace ponte::dli::messages
)",
                     generated_notice, bare, protocol.messages.size(), list);
}

}  // namespace

Files emit_dli(const Protocol& protocol) {
  const std::filesystem::path folder{"ponte/dli/messages"};
  Files files;
  std::vector<const Message*> messages;
  for (const auto& message : protocol.messages) {
    if (message.fields.empty()) continue;
    files[folder / (message.key + ".hpp")] = message_header(message);
    messages.push_back(&message);
  }
  files[folder / "enumerations.hpp"] = enumerations_header(protocol);
  files[folder / "enumerations.cpp"] = enumerations_source(protocol);
  files[folder / "catalogue.hpp"] = catalogue_header();
  files[folder / "catalogue.cpp"] = catalogue_source(protocol);
  files[folder / "all.hpp"] = emit_all_header(messages, folder.string(), "ponte::dli::messages", "MessageNumber");
  return files;
}

}  // namespace ponte::codegen
