#include "ponte/mavlink/json.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/mavlink/field_value.hpp"

#include <fmt/format.h>

#include <string>
#include <variant>

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

}  // namespace ponte::mavlink
