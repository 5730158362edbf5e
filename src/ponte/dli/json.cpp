#include "ponte/dli/json.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/dli/integers.hpp"
#include "ponte/dli/walk.hpp"

#include <bit>
#include <string_view>

namespace ponte::dli {
namespace {

/// Up to the first NUL.
std::string_view text_in(Bytes bytes) {
  const auto* chars = reinterpret_cast<const char*>(bytes.data());
  const std::string_view whole{chars, bytes.size()};
  return whole.substr(0, whole.find('\0'));
}

void append_labels_of_bits(JsonText& json, const EnumInfo& bitmap, std::uint64_t raw) {
  json.key("label").begin_array();
  for (const auto& entry : bitmap.entries)
    if (entry.first != 0 && (raw & entry.first) == entry.first) json.value(entry.label);
  json.end_array();
}

void append_label(JsonText& json, const FieldInfo& field, std::int64_t raw) {
  if (field.role == Role::id) {
    json.member("label", to_text(EntityId{static_cast<std::uint32_t>(raw)}).view());
    return;
  }
  if (field.enumeration == nullptr) return;
  if (field.enumeration->bitmap) {
    append_labels_of_bits(json, *field.enumeration, static_cast<std::uint64_t>(raw));
    return;
  }
  for (const auto& entry : field.enumeration->entries) {
    if (raw < entry.first || raw > entry.last) continue;
    json.member("label", entry.label);
    return;
  }
}

void append_value(JsonText& json, const FieldInfo& field, double raw, double scale) {
  if (scale != 0) json.member("value", raw * scale);
  if ((scale != 0 || field.type == FieldType::float32) && !field.unit.empty()) json.member("unit", field.unit);
}

}  // namespace

void append_field(JsonText& json, const FieldInfo& field, Bytes bytes, double scale) {
  json.key(field.key).begin_object();
  if (is_integer(field.type)) {
    const auto raw = raw_integer(field, bytes);
    json.member("raw", raw);
    append_value(json, field, static_cast<double>(raw), scale);
    append_label(json, field, raw);
  } else if (field.type == FieldType::float32) {
    const auto raw = std::bit_cast<float>(load_be<std::uint32_t>(bytes.data()));
    json.member("raw", raw);
    append_value(json, field, static_cast<double>(raw), scale);
  } else {
    json.member("raw", text_in(bytes));
  }
  json.end_object();
}

void append_header(JsonText& json, const WrapperView& message, const MessageInfo* info, const Profile& profile,
                   std::int64_t time_ms) {
  json.member("time_ms", time_ms).member("number", unsigned{message.number.value});
  json.member("name", info == nullptr ? std::string_view{"unknown"} : info->name_in(profile.edition));
  json.member("edition", name_of(profile.edition));
  json.member("source", to_text(message.source).view()).member("destination", to_text(message.destination).view());
}

Result<DecodeFacts, DecodeError> append_json(JsonText& json, const WrapperView& message, const Catalogue& catalogue,
                                             const Profile& profile, std::int64_t time_ms) {
  const auto* info = catalogue.find(message.number);
  const auto has_fields = info != nullptr && profile.has_fields(*info);
  DecodeFacts facts;
  if (has_fields) {
    const auto checked = walk(*info, message.data, profile, [](const FieldInfo&, Bytes) {});
    if (!checked) return checked;
    facts = *checked;
  }

  json.begin_object();
  append_header(json, message, info, profile, time_ms);
  if (has_fields) {
    json.key("fields").begin_object();
    const auto append = [&](const FieldInfo& field, Bytes bytes) {
      append_field(json, field, bytes, profile.scale_of(*info, field));
    };
    facts = *walk(*info, message.data, profile, append);
    json.end_object();
    if (facts.newer_fields) json.member("newer_fields", true);
  } else {
    json.member("partial", true).member("data", std::string_view{to_hex(message.data)});
  }
  json.end_object();
  return facts;
}

}  // namespace ponte::dli
