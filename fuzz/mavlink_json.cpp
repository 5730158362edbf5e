// A message written by hand: the reader refuses it with a place and an expectation, or what it has read is written and
// read again as the same message.
#include "ponte/autopilot/dialect.hpp"
#include "ponte/mavlink/json.hpp"
#include "ponte/reflection/message_json.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ponte;
  const auto& dialect = autopilot::dialect;
  const auto message = reflection::message_from_json({reinterpret_cast<const char*>(data), size}, dialect);
  if (!message) {
    if (message.error().found.empty() || message.error().expected.empty()) std::abort();
    return 0;
  }
  JsonText json;
  json.begin_object().member("name", message->message->name);
  if (message->message->is_v09()) json.member("version", 0.9);
  json.key("fields");
  append_fields(json, *message->message, message->payload());
  json.end_object();
  const auto again = reflection::message_from_json(json.text(), dialect);
  if (!again) std::abort();
  JsonText twice;
  twice.begin_object().member("name", again->message->name);
  if (again->message->is_v09()) twice.member("version", 0.9);
  twice.key("fields");
  append_fields(twice, *again->message, again->payload());
  twice.end_object();
  if (twice.text() != json.text()) std::abort();
  return 0;
}
