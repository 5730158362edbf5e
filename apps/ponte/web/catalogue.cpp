#include "web/catalogue.hpp"

#include "ponte/autopilot/vehicle_monitor.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/dlisession/status_messages.hpp"

#include <array>
#include <map>
#include <string_view>

namespace ponte::app {
namespace {

std::string_view name_of(mavlink::FieldType type) {
  static constexpr std::array<std::string_view, 11> names{"char",  "uint8",  "int8",  "uint16", "int16", "uint32",
                                                          "int32", "uint64", "int64", "float",  "double"};
  return names.at(static_cast<std::size_t>(type));
}

std::string_view name_of(dli::FieldType type) {
  static constexpr std::array<std::string_view, 6> names{"unsigned", "signed", "bam", "float", "text", "variable_text"};
  return names.at(static_cast<std::size_t>(type));
}

std::string_view name_of(dli::Confidence confidence) {
  static constexpr std::array<std::string_view, 4> names{"standard", "single_source", "inferred", "unknown"};
  return names.at(static_cast<std::size_t>(confidence));
}

std::string_view confidence_in(const dli::MessageInfo& message, dli::Edition edition) {
  return name_of(edition == dli::Edition::ed3 ? message.confidence_ed3 : message.confidence);
}

template <class Names>
void append_names(JsonText& json, std::string_view key, const Names& names) {
  json.key(key).begin_array();
  for (const std::string_view name : names)
    if (!name.empty()) json.value(name);
  json.end_array();
}

void append_message(JsonText& json, const mavlink::MessageInfo& message) {
  json.begin_object().member("id", message.id.value).member("name", message.name).key("fields").begin_array();
  for (const auto& field : message.fields) {
    json.begin_object().member("name", field.name).member("type", name_of(field.type));
    json.member("offset", unsigned{field.offset});
    if (field.array_length != 0) json.member("array_length", unsigned{field.array_length});
    if (!field.unit.empty()) json.member("unit", field.unit);
    if (field.enumeration != nullptr) json.member("enum", field.enumeration->name);
    json.end_object();
  }
  json.end_array().end_object();
}

void append_mavlink(JsonText& json, const mavlink::Dialect& dialect) {
  std::map<std::string_view, const mavlink::EnumInfo*> enums;
  json.key("mavlink").begin_object().key("messages").begin_array();
  for (const auto* message : dialect.messages) {
    append_message(json, *message);
    for (const auto& field : message->fields)
      if (field.enumeration != nullptr) enums[field.enumeration->name] = field.enumeration;
  }
  json.end_array().key("enums").begin_object();
  for (const auto& [name, info] : enums) {
    json.key(name).begin_object().member("bitmask", info->bitmask).key("labels").begin_object();
    for (const auto& entry : info->entries) json.member(std::to_string(entry.value), entry.name);
    json.end_object().end_object();
  }
  json.end_object().end_object();
}

void append_message(JsonText& json, const dli::MessageInfo& message, const dli::Profile& profile) {
  json.begin_object().member("number", unsigned{message.number.value});
  json.member("name", message.name_in(profile.edition));
  json.member("presence_bytes", unsigned{profile.presence_bytes_of(message)});
  json.member("confidence", confidence_in(message, profile.edition)).key("fields").begin_array();
  for (const auto& field : message.fields) {
    if (field.since_edition_a && profile.edition == dli::Edition::ed3) continue;
    json.begin_object().member("number", unsigned{field.number}).member("key", field.key).member("name", field.name);
    json.member("type", name_of(field.type)).member("width", unsigned{field.width});
    if (field.length_from != 0) json.member("length_from", unsigned{field.length_from});
    if (const auto scale = profile.scale_of(message, field); scale != 0) json.member("scale", scale);
    if (!field.unit.empty()) json.member("unit", field.unit);
    if (field.guessed) json.member("guessed", true);
    json.end_object();
  }
  json.end_array().end_object();
}

void append_rules(JsonText& json, const dli::Profile& profile) {
  json.key("rules").begin_object().key("from_mavlink").begin_array();
  for (const auto& row : autopilot::telemetry_row_texts()) {
    json.begin_object().member("message", row.message);
    append_names(json, "sources", row.sources);
    json.member("fact", row.target).member("rule", row.rule).member("unit", row.unit);
    json.member("rank", unsigned{row.rank}).member("reference", row.reference).end_object();
  }
  json.end_array().key("to_dli").begin_array();
  for (const auto& row : dlisession::status_row_texts()) {
    json.begin_object().member("number", unsigned{row.message->number.value}).member("field", row.field->key);
    append_names(json, "facts", row.sources);
    json.member("rule", row.rule).member("reference", row.reference);
    json.member("confidence", confidence_in(*row.message, profile.edition)).end_object();
  }
  json.end_array().end_object();
}

}  // namespace

std::string catalogue_json(const mavlink::Dialect& dialect, const dli::Catalogue& catalogue,
                           const dli::Profile& profile) {
  JsonText json;
  json.begin_object();
  append_mavlink(json, dialect);
  json.key("dli").begin_object().key("messages").begin_array();
  for (const auto* message : catalogue.messages)
    if (profile.has_fields(*message)) append_message(json, *message, profile);
  json.end_array().end_object();
  append_rules(json, profile);
  json.end_object();
  return json.text();
}

}  // namespace ponte::app
