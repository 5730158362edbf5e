#include "codegen/emit.hpp"
#include "ponte/definitions/names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ponte::codegen {
namespace {

std::string scalar_type(const Field& field) {
  if (field.kind == Kind::real) return field.width == 4 ? "float" : "double";
  return fmt::format("std::{}int{}_t", field.kind == Kind::signed_integer ? "" : "u", field.width * 8);
}

std::string member_type(const Field& field) {
  if (field.kind == Kind::character) return field.count == 0 ? "char" : fmt::format("Text<{}>", field.count);
  return field.count == 0 ? scalar_type(field) : fmt::format("std::array<{}, {}>", scalar_type(field), field.count);
}

std::string field_type_name(const Field& field) {
  switch (field.kind) {
    case Kind::character: return "character";
    case Kind::real: return fmt::format("float{}", field.width * 8);
    case Kind::signed_integer: return fmt::format("int{}", field.width * 8);
    default: return fmt::format("uint{}", field.width * 8);
  }
}

/// A type that holds every value of an enumeration.
std::string underlying_type(const Enumeration& enumeration) {
  std::uint64_t largest = 0;
  for (const auto& entry : enumeration.entries) largest = std::max(largest, entry.last);
  return unsigned_type_for(largest);
}

std::string comment(const Field& field, bool descriptions) {
  std::string text = field.unit;
  const auto add = [&](std::string_view more) {
    if (more.empty()) return;
    if (!text.empty()) text += "; ";
    text += more;
  };
  add(field.enumeration);
  if (!field.invalid.empty()) add(fmt::format("{} means unknown", field.invalid));
  if (field.extension) add("extension");
  if (descriptions) add(field.note);
  return text.empty() ? "" : "  ///< " + one_line(text);
}

std::string field_table(const Message& message, bool big_endian) {
  std::string rows;
  for (const auto& field : message.fields)
    rows += fmt::format(
        "      {{{}, FieldType::{}, {}, {}, {}, {}, {}, {}{}{}}},\n", literal(field.name), field_type_name(field),
        field.count, field.offset, field.extension, literal(field.unit), literal(field.invalid),
        field.enumeration.empty() ? "nullptr" : "&enum_info::" + field.enumeration,
        field.instance || big_endian ? fmt::format(", {}", field.instance) : "", big_endian ? ", true" : "");
  return rows;
}

std::string message_header(const Protocol& protocol, const Message& message, bool descriptions) {
  std::string members;
  std::string visits;
  bool texts = false;
  bool enums = false;
  for (std::size_t i = 0; i < message.fields.size(); ++i) {
    const auto& field = message.fields[i];
    members +=
        fmt::format("  {} {}{{{}}};{}\n", member_type(field), field.key, field.initial, comment(field, descriptions));
    visits += fmt::format("    visitor(fields[{}], self.{});\n", i, field.key);
    texts |= field.kind == Kind::character && field.count > 0;
    enums |= !field.enumeration.empty();
  }
  std::string includes;
  if (texts) includes += "#include \"ponte/core/text.hpp\"\n";
  if (enums) includes += fmt::format("#include \"ponte/mavlink/{}/enums.hpp\"\n", protocol.name);
  return fmt::format(
      R"({notice}#pragma once

{includes}#include "ponte/mavlink/message_info.hpp"

#include <array>

namespace ponte::mavlink::{dialect} {{

{description}struct {type} {{
{members}
  static constexpr std::array<FieldInfo, {count}> fields{{{{
{rows}  }}}};
  static constexpr MessageInfo info{{MessageId{{{id}}}, {name}, {crc_extra}, {base_length}, {full_length}, fields}};

  /// Calls `visitor(field_info, member)` for each field in the order of the definition.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {{
{visits}  }}

  friend bool operator==(const {type}&, const {type}&) = default;
}};

}}  // namespace ponte::mavlink::{dialect}
)",
      fmt::arg("notice", generated_notice), fmt::arg("includes", includes), fmt::arg("dialect", protocol.name),
      fmt::arg("type", pascal_case(message.key)),
      fmt::arg("description", descriptions && !message.note.empty() ? "/// " + message.note + "\n" : std::string{}),
      fmt::arg("members", members), fmt::arg("count", message.fields.size()),
      fmt::arg("rows", field_table(message, protocol.v09)), fmt::arg("id", message.number),
      fmt::arg("name", literal(message.name)), fmt::arg("crc_extra", message.crc_extra),
      fmt::arg("base_length", message.base_length), fmt::arg("full_length", message.full_length),
      fmt::arg("visits", visits));
}

std::string enums_header(const Protocol& protocol) {
  std::string enums;
  std::string infos;
  for (const auto& enumeration : protocol.enumerations) {
    enums += fmt::format("enum {} : {} {{\n", enumeration.name, underlying_type(enumeration));
    for (const auto& entry : enumeration.entries) enums += fmt::format("  {} = {}U,\n", entry.name, entry.first);
    enums += "};\n\n";
    infos += fmt::format("extern const EnumInfo {};\n", enumeration.name);
  }
  return fmt::format(R"({}#pragma once

#include "ponte/mavlink/message_info.hpp"

/// The enumerations under their official names. The fields of messages are plain integers, since a newer sender may use
/// values that are not listed here.
namespace ponte::mavlink::{} {{

{}namespace enum_info {{
{}}}  // namespace enum_info

}}  // namespace ponte::mavlink::{}
)",
                     generated_notice, protocol.name, enums, infos, protocol.name);
}

std::string enums_source(const Protocol& protocol) {
  std::string tables;
  for (const auto& enumeration : protocol.enumerations) {
    tables += fmt::format("namespace {{\nconstexpr std::array<EnumEntry, {}> entries_{}{{{{\n",
                          enumeration.entries.size(), enumeration.name);
    for (const auto& entry : enumeration.entries)
      tables += fmt::format("    {{{}U, {}}},\n", entry.first, literal(entry.name));
    tables += fmt::format("}}}};\n}}  // namespace\nconst EnumInfo {}{{{}, {}, entries_{}}};\n\n", enumeration.name,
                          literal(enumeration.name), enumeration.bitmap, enumeration.name);
  }
  return fmt::format(R"({}#include "ponte/mavlink/{}/enums.hpp"

#include <array>

namespace ponte::mavlink::{}::enum_info {{

{}}}  // namespace ponte::mavlink::{}::enum_info
)",
                     generated_notice, protocol.name, protocol.name, tables, protocol.name);
}

std::string dialect_header(const Protocol& protocol) {
  return fmt::format(R"({}#pragma once

#include "ponte/mavlink/message_info.hpp"

namespace ponte::mavlink::{} {{

extern const Dialect dialect;

}}  // namespace ponte::mavlink::{}
)",
                     generated_notice, protocol.name, protocol.name);
}

std::string dialect_source(const Protocol& protocol) {
  std::string list;
  for (const auto& message : protocol.messages) list += fmt::format("    &{}::info,\n", pascal_case(message.key));
  return fmt::format(R"({}#include "ponte/mavlink/{}/dialect.hpp"

#include "ponte/mavlink/{}/all.hpp"

namespace ponte::mavlink::{} {{
namespace {{

constexpr std::array<const MessageInfo*, {}> messages{{{{
{}}}}};
constexpr auto low = low_messages(messages);

}}  // namespace

const Dialect dialect{{.name = {}, .messages = messages, .low = low}};

}}  // namespace ponte::mavlink::{}
)",
                     generated_notice, protocol.name, protocol.name, protocol.name, protocol.messages.size(), list,
                     literal(protocol.name), protocol.name);
}

}  // namespace

Files emit_mavlink(const Protocol& protocol, bool descriptions) {
  const auto folder = std::filesystem::path{"ponte/mavlink"} / protocol.name;
  Files files;
  std::vector<const Message*> messages;
  for (const auto& message : protocol.messages) {
    files[folder / (message.key + ".hpp")] = message_header(protocol, message, descriptions);
    messages.push_back(&message);
  }
  files[folder / "enums.hpp"] = enums_header(protocol);
  files[folder / "enums.cpp"] = enums_source(protocol);
  files[folder / "dialect.hpp"] = dialect_header(protocol);
  files[folder / "dialect.cpp"] = dialect_source(protocol);
  files[folder / "all.hpp"] =
      emit_all_header(messages, folder.string(), "ponte::mavlink::" + protocol.name, "MessageId");
  return files;
}

}  // namespace ponte::codegen
