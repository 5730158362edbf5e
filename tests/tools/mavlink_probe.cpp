// Decodes and encodes single frames for tests that compare Ponte with other implementations: one JSON request per line
// on stdin, one JSON answer per line on stdout. Everything goes through the typed structs.
//   {"frame":"<hex>"}                      -> {"id":0,"name":...,"fields":{...},"reencoded":"<hex>"}
//   {"id":0,"version":2,"fields":{...}...} -> {"frame":"<hex>"}
// A request that cannot be met is answered by {"error":"..."}.

#include "ponte/core/hex.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/autopilots/all.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/frame.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace ponte::mavlink {
namespace {

using Json = nlohmann::json;

/// A request that makes no sense. Ends the work on one line; the text becomes the answer.
struct BadRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// From JSON to the members of a message.

template <std::integral T>
void assign(T& member, const Json& value, std::string_view name) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), member);
    if (error == std::errc{} && end == text.data() + text.size()) return;
  } else if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    member = static_cast<T>(number);
    if (std::in_range<T>(number)) return;
  } else if (value.is_number_integer()) {
    const auto number = value.get<std::int64_t>();
    member = static_cast<T>(number);
    if (std::in_range<T>(number)) return;
  }
  throw BadRequest{"not an integer in the range of field " + std::string{name} + ": " + value.dump()};
}

template <std::floating_point T>
void assign(T& member, const Json& value, std::string_view name) {
  if (value.is_number()) {
    const auto number = value.get<double>();
    member = static_cast<T>(number);
    if (std::isfinite(member)) return;
  }
  if (value == "NaN")
    member = std::numeric_limits<T>::quiet_NaN();
  else if (value == "Infinity")
    member = std::numeric_limits<T>::infinity();
  else if (value == "-Infinity")
    member = -std::numeric_limits<T>::infinity();
  else
    throw BadRequest{"not a number in the range of field " + std::string{name} + ": " + value.dump()};
}

template <std::size_t Size>
void assign(Text<Size>& member, const Json& value, std::string_view name) {
  if (!value.is_string() || value.get_ref<const std::string&>().size() > Size)
    throw BadRequest{"not a text that fits field " + std::string{name} + ": " + value.dump()};
  member = std::string_view{value.get_ref<const std::string&>()};
}

template <class T, std::size_t Size>
void assign(std::array<T, Size>& member, const Json& value, std::string_view name) {
  if (!value.is_array() || value.size() != Size)
    throw BadRequest{"field " + std::string{name} + " needs a list of " + std::to_string(Size) + " values"};
  for (std::size_t i = 0; i < Size; ++i) assign(member[i], value[i], name);
}

template <class M>
M message_from(const Json& fields) {
  M message;
  std::size_t assigned = 0;
  M::visit(message, [&](const FieldInfo& field, auto& member) {
    const auto value = fields.find(field.name);
    if (value == fields.end()) return;
    assign(member, *value, field.name);
    ++assigned;
  });
  if (assigned != fields.size()) throw BadRequest{std::string{M::info.name} + " does not have all these fields"};
  return message;
}

// From the members of a message to JSON.

template <WireNumber T>
void append(JsonText& json, T value) {
  if constexpr (std::floating_point<T>)
    json.value(value);
  else if constexpr (std::signed_integral<T>)
    json.value(std::int64_t{value});
  else
    json.value(std::uint64_t{value});
}

template <std::size_t Size>
void append(JsonText& json, const Text<Size>& value) {
  json.value(value.view());
}

template <class T, std::size_t Size>
void append(JsonText& json, const std::array<T, Size>& values) {
  json.begin_array();
  for (const auto& value : values) append(json, value);
  json.end_array();
}

template <class M>
void append_fields(JsonText& json, const M& message) {
  json.begin_object();
  M::visit(message, [&](const FieldInfo& field, const auto& member) {
    json.key(field.name);
    append(json, member);
  });
  json.end_object();
}

// The two requests.

template <class M>
std::string encoded_hex(const M& message, const FrameHeader& header) {
  std::array<std::byte, max_frame_size> out{};
  const auto size = encode(message, header, out);
  if (!size) throw BadRequest{"the message id does not fit MAVLink 1"};
  return to_hex(Bytes{out}.first(*size));
}

FrameView checked_frame(Bytes bytes) {
  const auto frame = parse_frame(bytes);
  if (!frame && frame.error() == FrameError::incomplete) throw BadRequest{"the frame is incomplete"};
  if (!frame && frame.error() == FrameError::unknown_flag) throw BadRequest{"the frame has an unknown flag"};
  if (!frame) throw BadRequest{"no frame"};
  if (frame->whole.size() != bytes.size()) throw BadRequest{"bytes behind the frame"};
  const auto* info = autopilots::dialect.find(frame->message);
  if (info == nullptr) throw BadRequest{"unknown message id " + std::to_string(frame->message.value)};
  if (!checksum_matches(*frame, info->crc_extra)) throw BadRequest{"the checksum is wrong"};
  return *frame;
}

void decode_request(const Json& request, JsonText& answer) {
  if (!request["frame"].is_string()) throw BadRequest{"frame is not a text"};
  const auto bytes = parse_hex(request["frame"].get_ref<const std::string&>());
  if (!bytes) throw BadRequest{"frame is not hex"};
  const auto frame = checked_frame(*bytes);

  answer.begin_object().member("id", frame.message.value);
  autopilots::with_message(frame.message, [&]<class M>() {
    const auto message = decode<M>(frame);
    answer.member("name", M::info.name).member("version", static_cast<int>(frame.version));
    answer.member("system", int{frame.system.value}).member("component", int{frame.component.value});
    answer.member("sequence", int{frame.sequence}).key("fields");
    append_fields(answer, message);
    const FrameHeader header{frame.version, frame.system, frame.component, frame.sequence};
    answer.member("reencoded", std::string_view{encoded_hex(message, header)});
  });
  answer.end_object();
}

template <class T>
T member_of(const Json& request, const char* name) {
  const auto value = request.find(name);
  if (value == request.end()) throw BadRequest{"no " + std::string{name} + " in the request"};
  T number{};
  assign(number, *value, name);
  return number;
}

void encode_request(const Json& request, JsonText& answer) {
  const MessageId id{member_of<std::uint32_t>(request, "id")};
  const auto version = member_of<std::uint8_t>(request, "version");
  if (version != 1 && version != 2) throw BadRequest{"version is neither 1 nor 2"};
  const FrameHeader header{
      .version = version == 1 ? Version::v1 : Version::v2,
      .system = SystemId{member_of<std::uint8_t>(request, "system")},
      .component = ComponentId{member_of<std::uint8_t>(request, "component")},
      .sequence = member_of<std::uint8_t>(request, "sequence"),
  };
  const auto fields = request.find("fields");
  if (fields == request.end() || !fields->is_object()) throw BadRequest{"no fields in the request"};

  const bool is_known = autopilots::with_message(id, [&]<class M>() {
    const auto hex = encoded_hex(message_from<M>(*fields), header);
    answer.begin_object().member("frame", std::string_view{hex}).end_object();
  });
  if (!is_known) throw BadRequest{"unknown message id " + std::to_string(id.value)};
}

void answer_line(const std::string& line, JsonText& answer) {
  try {
    const auto request = Json::parse(line, nullptr, false);
    if (!request.is_object()) throw BadRequest{"not a JSON object"};
    if (request.contains("frame"))
      decode_request(request, answer);
    else
      encode_request(request, answer);
  } catch (const BadRequest& bad) {
    answer.clear();
    answer.begin_object().member("error", bad.what()).end_object();
  }
}

}  // namespace
}  // namespace ponte::mavlink

int main() {
  ponte::JsonText answer;
  for (std::string line; std::getline(std::cin, line);) {
    answer.clear();
    ponte::mavlink::answer_line(line, answer);
    std::cout << answer.text() << '\n' << std::flush;
  }
}
