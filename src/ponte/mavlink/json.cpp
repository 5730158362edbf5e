#include "ponte/mavlink/json.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/mavlink/field_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace ponte::mavlink {
namespace {

void append_value(JsonText& json, const FieldInfo& field, Bytes payload) {
  if (field.type == FieldType::character) {
    json.value(read_text(field, payload));
    return;
  }
  const auto append_element = [&](std::size_t index) {
    std::visit([&](auto value) { json.value(value); }, read_element(field, payload, index));
  };
  if (field.array_length == 0) return append_element(0);
  json.begin_array();
  for (std::size_t index = 0; index < field.array_length; ++index) append_element(index);
  json.end_array();
}

/// The words for one element, empty if there are none.
std::string words_of(const FieldInfo& field, Bytes payload, std::size_t index) {
  const auto value = read_element(field, payload, index);
  if (const auto* number = std::get_if<std::uint64_t>(&value)) return words_of(*field.enumeration, *number);
  const auto* number = std::get_if<std::int64_t>(&value);
  if (number == nullptr || *number < 0) return {};
  return words_of(*field.enumeration, static_cast<std::uint64_t>(*number));
}

}  // namespace

void append_header(JsonText& json, WallTime time, const FrameView& frame, const MessageInfo* message) {
  json.member("time_us", std::int64_t{unix_us(time)}).member("id", frame.message.value);
  json.key("name");
  if (message != nullptr)
    json.value(message->name);
  else
    json.value(std::string_view{fmt::format("unknown:{}", frame.message.value)});
  json.key("version");
  frame.version == Version::v0_9 ? json.value(0.9) : json.value(static_cast<int>(frame.version));
  json.member("system", int{frame.system.value}).member("component", int{frame.component.value});
  json.member("sequence", int{frame.sequence});
}

void append_frame(JsonText& json, WallTime time, const FrameView& frame, const MessageInfo* message) {
  json.begin_object();
  append_header(json, time, frame, message);
  if (message != nullptr) {
    json.key("fields");
    append_fields(json, *message, readable_payload(frame, *message));
    append_labels(json, *message, readable_payload(frame, *message));
  } else {
    json.member("payload", std::string_view{to_hex(frame.payload)});
  }
  json.end_object();
}

void append_fields(JsonText& json, const MessageInfo& message, Bytes payload) {
  json.begin_object();
  for (const auto& field : message.fields) {
    json.key(field.name);
    append_value(json, field, payload);
  }
  json.end_object();
}

void append_labels(JsonText& json, const MessageInfo& message, Bytes payload) {
  bool begun = false;
  std::vector<std::string> words;
  for (const auto& field : message.fields) {
    if (field.enumeration == nullptr) continue;
    words.clear();
    for (std::size_t index = 0; index < element_count(field); ++index) words.push_back(words_of(field, payload, index));
    if (std::ranges::all_of(words, &std::string::empty)) continue;
    if (!begun) json.key("labels").begin_object();
    begun = true;
    json.key(field.name);
    if (field.array_length != 0) json.begin_array();
    for (const auto& word : words) json.value(std::string_view{word});
    if (field.array_length != 0) json.end_array();
  }
  if (begun) json.end_object();
}

}  // namespace ponte::mavlink
