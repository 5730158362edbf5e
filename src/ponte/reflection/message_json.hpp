#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

/// MAVLink messages from JSON: the way back from `ponte/mavlink/json.hpp`.
namespace ponte::reflection {

/// Why a text is no message.
struct JsonRefusal {
  std::string path;      ///< the value that is wrong, e.g. "fields.cells[3]"; empty: the text as a whole
  std::string found;     ///< e.g. "300"
  std::string expected;  ///< e.g. "an integer from 0 to 255"

  friend bool operator==(const JsonRefusal&, const JsonRefusal&) = default;
};

/// "fields.cells[3]: it is 300; expected an integer from 0 to 255".
[[nodiscard]] std::string to_text(const JsonRefusal& refusal);

/// A message with its bytes, ready for `mavlink::write_frame` or `mavlink::decode`.
struct JsonMessage {
  const mavlink::MessageInfo* message{};  ///< in the dialect that was searched
  mavlink::FrameHeader header{};
  std::array<std::byte, mavlink::max_payload_size> bytes{};

  /// Of the full length of the message.
  [[nodiscard]] Bytes payload() const { return Bytes{bytes}.first(message->full_length); }
};

/// Reads `{"name":"ATTITUDE","fields":{"roll":0.1, ...}}`, or any line that `mavlink::append_frame` has written of a
/// message in `dialect`. Instead of the name, or besides it, there may be the `id`. `version`, `system`, `component`
/// and `sequence` go into the header; `time_us` and `labels` say nothing about the message and are passed over.
///
/// Every field is expected, but for extensions, which are zero if they are missing. A field takes
/// - a number that it can hold, in digits also as a string, and "NaN", "Infinity", "-Infinity" if it has fractions;
/// - if it has an enumeration, a name of it, of a bitmask several: "A|B|64";
/// - a list if it is an array, and a text if it is one of characters.
/// So a message that was written comes back with every bit, but for the bits of a NaN beyond its being one, texts that
/// are not UTF-8, and what stands behind the end of a text.
[[nodiscard]] Result<JsonMessage, JsonRefusal> message_from_json(std::string_view text,
                                                                 const mavlink::Dialect& dialect);

}  // namespace ponte::reflection
