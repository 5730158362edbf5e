// A dialect that a user adds, a definition file or a profile with a slip of the pen: the readers refuse it with an
// error and nothing else, and what they accept can be emitted, and used at once. The first byte chooses the reader, the
// second whether the package's descriptions are emitted.
#include "codegen/dli_reader.hpp"
#include "codegen/emit.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/profile_file.hpp"
#include "ponte/mavlink/json.hpp"
#include "ponte/reflection/dialect_file.hpp"
#include "ponte/reflection/message_json.hpp"

#include <cstdlib>

namespace {

using namespace ponte::codegen;

void read_and_emit_dli(std::string_view text) {
  const auto protocol = read_dli_text(text, "fuzz.toml");
  if (emit_dli(protocol).empty() || emit_dli_reference(protocol).empty()) std::abort();
}

void read_and_emit_mavlink(std::string_view text, bool descriptions) {
  const auto protocol = read_mavlink_text(text, "fuzz.xml");
  for (const auto& message : protocol.messages)
    if (message.full_length > 255 || message.base_length > message.full_length) std::abort();
  // One header per message and five files more: no message has replaced another file.
  if (emit_mavlink(protocol, descriptions).size() != protocol.messages.size() + 5) std::abort();
  if (emit_mavlink_reference(protocol, descriptions).empty()) std::abort();
}

/// Every message of the dialect, with the same byte everywhere, becomes JSON and comes back.
void use_at_once(std::string_view text, std::byte byte) {
  const auto file = ponte::reflection::parse_dialect(text, "fuzz.xml");
  for (const auto* message : file.dialect().messages) {
    std::array<std::byte, ponte::mavlink::max_payload_size> payload{};
    std::fill_n(payload.begin(), message->full_length, byte);
    ponte::JsonText json;
    json.begin_object().member("name", message->name).key("fields");
    append_fields(json, *message, ponte::Bytes{payload}.first(message->full_length));
    append_labels(json, *message, ponte::Bytes{payload}.first(message->full_length));
    json.end_object();
    const auto back = ponte::reflection::message_from_json(json.text(), file.dialect());
    if (!back || back->message != message) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::string_view text{reinterpret_cast<const char*>(data) + 2, size - 2};
  try {
    switch (data[0] % 3) {
      case 0: read_and_emit_dli(text); break;
      case 1:
        read_and_emit_mavlink(text, data[1] % 2 == 0);
        use_at_once(text, std::byte{data[1]} & std::byte{0x7F});
        break;
      default: (void)ponte::dli::parse_profile(text, ponte::dli::messages::catalogue);
    }
  } catch (const DefinitionError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
