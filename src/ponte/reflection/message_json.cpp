#include "ponte/reflection/message_json.hpp"

#include "ponte/mavlink/field_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <vector>

namespace ponte::reflection {
namespace {

using mavlink::FieldInfo;
using mavlink::FieldType;
using mavlink::FieldValue;
using Json = nlohmann::json;

constexpr std::array known_members{"time_us",   "id",       "name",   "version", "system",
                                   "component", "sequence", "fields", "labels"};
constexpr std::size_t longest_shown = 60;

/// Ends the reading, and becomes the answer.
struct Refused {
  JsonRefusal refusal;
};

[[noreturn]] void refuse(std::string path, std::string found, std::string expected) {
  throw Refused{{std::move(path), std::move(found), std::move(expected)}};
}

/// The value as it stands in the text, unless it is long or has parts.
std::string shown(const Json& value) {
  if (value.is_array()) return fmt::format("a list of {} values", value.size());
  if (value.is_object()) return "an object";
  const auto text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > longest_shown ? text.substr(0, longest_shown) + "..." : text;
}

/// Notices a member that comes twice in one object, which a tree would forget.
class TwinFinder {
 public:
  bool operator()(int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event == Json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second)
      refuse("", fmt::format("an object with {} twice", shown(parsed)), "each name once");
    return true;
  }

 private:
  std::vector<std::set<std::string>> open_;
};

Json parse(std::string_view text) {
  TwinFinder finder;
  try {
    return Json::parse(text, std::ref(finder));
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string_view what{error.what()};
    const auto end = what.find("] ");
    refuse("", std::string{end == what.npos ? what : what.substr(end + 2)}, "a JSON object");
  }
}

template <class T>
std::string range_of() {
  return fmt::format("an integer from {} to {}", std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
}

std::string expected_of(FieldType type) {
  switch (type) {
    case FieldType::character:
    case FieldType::uint8: return range_of<std::uint8_t>();
    case FieldType::int8: return range_of<std::int8_t>();
    case FieldType::uint16: return range_of<std::uint16_t>();
    case FieldType::int16: return range_of<std::int16_t>();
    case FieldType::uint32: return range_of<std::uint32_t>();
    case FieldType::int32: return range_of<std::int32_t>();
    case FieldType::uint64: return range_of<std::uint64_t>();
    case FieldType::int64: return range_of<std::int64_t>();
    case FieldType::float32:
    case FieldType::float64: break;
  }
  return fmt::format(R"(a number of {} bits, "NaN", "Infinity" or "-Infinity")", 8 * mavlink::size_of(type));
}

std::string expected_of(const FieldInfo& field) {
  if (field.type == FieldType::character) return fmt::format("a text of at most {} bytes", field.size());
  auto text = expected_of(field.type);
  if (field.enumeration != nullptr)
    text += fmt::format(", or {} of {}", field.enumeration->bitmask ? "names" : "a name", field.enumeration->name);
  return text;
}

template <std::integral T>
std::optional<FieldValue> digits(std::string_view text) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<FieldValue> value_of_text(const FieldInfo& field, std::string_view text) {
  if (field.enumeration != nullptr)
    if (const auto value = mavlink::value_of(*field.enumeration, text)) return *value;
  if (field.type == FieldType::float32 || field.type == FieldType::float64) {
    if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (text == "Infinity") return std::numeric_limits<double>::infinity();
    if (text == "-Infinity") return -std::numeric_limits<double>::infinity();
    return std::nullopt;
  }
  return text.starts_with('-') ? digits<std::int64_t>(text) : digits<std::uint64_t>(text);
}

std::optional<FieldValue> value_of(const FieldInfo& field, const Json& value) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number_float()) return value.get<double>();
  if (value.is_string()) return value_of_text(field, value.get_ref<const std::string&>());
  return std::nullopt;
}

void read_element(const FieldInfo& field, const Json& json, std::size_t index, const std::string& path,
                  MutableBytes payload) {
  const auto value = value_of(field, json);
  if (!value || !mavlink::write_element(field, payload, index, *value)) refuse(path, shown(json), expected_of(field));
}

void read_field(const FieldInfo& field, const Json& json, MutableBytes payload) {
  const auto path = fmt::format("fields.{}", field.name);
  if (field.type == FieldType::character) {
    if (!json.is_string() || !mavlink::write_text(field, payload, json.get_ref<const std::string&>()))
      refuse(path, shown(json), expected_of(field));
    return;
  }
  if (field.array_length == 0) return read_element(field, json, 0, path, payload);
  if (!json.is_array() || json.size() != field.array_length)
    refuse(path, shown(json), fmt::format("a list of {} values", field.array_length));
  for (std::size_t index = 0; index < json.size(); ++index)
    read_element(field, json[index], index, fmt::format("{}[{}]", path, index), payload);
}

std::string names_of(const mavlink::MessageInfo& message) {
  std::vector<std::string_view> names;
  for (const auto& field : message.fields) names.push_back(field.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void read_fields(const Json& fields, const mavlink::MessageInfo& message, MutableBytes payload) {
  if (!fields.is_object())
    refuse("fields", shown(fields), fmt::format("an object with the fields of {}", message.name));
  for (const auto& [name, value] : fields.items())
    if (message.find(name) == nullptr)
      refuse("fields." + name, fmt::format("no field of {}", message.name), "one of " + names_of(message));
  for (const auto& field : message.fields) {
    const auto value = fields.find(field.name);
    if (value != fields.end())
      read_field(field, *value, payload);
    else if (!field.extension)
      refuse(fmt::format("fields.{}", field.name), "missing", expected_of(field));
  }
}

/// A member of the object that is an integer from 0, or what stands in for a missing one.
std::uint32_t number_of(const Json& object, const char* name, std::uint32_t most, std::uint32_t otherwise) {
  const auto value = object.find(name);
  if (value == object.end()) return otherwise;
  if (!value->is_number_unsigned() || value->get<std::uint64_t>() > most)
    refuse(name, shown(*value), fmt::format("an integer from 0 to {}", most));
  return value->get<std::uint32_t>();
}

const mavlink::MessageInfo& message_of(const Json& object, const mavlink::Dialect& dialect) {
  const auto name = object.find("name");
  if (name == object.end()) refuse("name", "missing", "the name of a message");
  const auto* message =
      name->is_string() ? dialect.find(std::string_view{name->get_ref<const std::string&>()}) : nullptr;
  if (message == nullptr) refuse("name", shown(*name), fmt::format("the name of a message of {}", dialect.name));
  const auto id = message->id.value;
  if (number_of(object, "id", 0xFFFFFF, id) != id)
    refuse("id", shown(object["id"]), fmt::format("{}, or none, for {}", id, message->name));
  return *message;
}

mavlink::Version version_of(const Json& object, bool is_v09) {
  using mavlink::Version;
  const auto version = object.find("version");
  if (version == object.end()) return is_v09 ? Version::v0_9 : Version::v2;
  if (*version == 0.9 && is_v09) return Version::v0_9;
  if (*version == 1 && !is_v09) return Version::v1;
  if (*version == 2 && !is_v09) return Version::v2;
  refuse("version", shown(*version), is_v09 ? "0.9" : "1 or 2");
}

JsonMessage read(std::string_view text, const mavlink::Dialect& dialect) {
  const auto object = parse(text);
  if (!object.is_object()) refuse("", shown(object), "a JSON object");
  for (const auto& [name, value] : object.items())
    if (std::ranges::find(known_members, name) == known_members.end())
      refuse(name, "no member of a message", fmt::format("one of {}", fmt::join(known_members, ", ")));
  JsonMessage result;
  const bool wants_v09 = dialect.v09 != nullptr && object.value("version", Json{}) == 0.9;
  result.message = &message_of(object, wants_v09 ? *dialect.v09 : dialect);
  const auto byte_of = [&](const char* name) { return static_cast<std::uint8_t>(number_of(object, name, 255, 0)); };
  result.header = {.version = version_of(object, result.message->is_v09()),
                   .system = mavlink::SystemId{byte_of("system")},
                   .component = mavlink::ComponentId{byte_of("component")},
                   .sequence = byte_of("sequence")};
  const auto fields = object.find("fields");
  if (fields == object.end()) refuse("fields", "missing", fmt::format("the fields of {}", result.message->name));
  read_fields(*fields, *result.message, MutableBytes{result.bytes}.first(result.message->full_length));
  return result;
}

}  // namespace

std::string to_text(const JsonRefusal& refusal) {
  return fmt::format("{}{}it is {}; expected {}", refusal.path, refusal.path.empty() ? "" : ": ", refusal.found,
                     refusal.expected);
}

Result<JsonMessage, JsonRefusal> message_from_json(std::string_view text, const mavlink::Dialect& dialect) {
  try {
    return read(text, dialect);
  } catch (const Refused& refused) {
    return fail(refused.refusal);
  }
}

}  // namespace ponte::reflection
