#include "ponte/definitions/mavlink_reader.hpp"

#include "ponte/definitions/names.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <numeric>
#include <set>

namespace ponte::definitions {
namespace {

constexpr std::size_t largest_payload = 255;
constexpr std::size_t deepest_include = 16;
/// Names of generated files that are not messages.
constexpr std::array taken_keys{"all", "dialect", "enums"};

struct ScalarType {
  std::string_view name;
  Kind kind;
  std::size_t width;
};
constexpr std::array scalar_types{
    ScalarType{"char", Kind::character, 1},
    ScalarType{"uint8_t", Kind::unsigned_integer, 1},
    ScalarType{"int8_t", Kind::signed_integer, 1},
    ScalarType{"uint16_t", Kind::unsigned_integer, 2},
    ScalarType{"int16_t", Kind::signed_integer, 2},
    ScalarType{"uint32_t", Kind::unsigned_integer, 4},
    ScalarType{"int32_t", Kind::signed_integer, 4},
    ScalarType{"uint64_t", Kind::unsigned_integer, 8},
    ScalarType{"int64_t", Kind::signed_integer, 8},
    ScalarType{"float", Kind::real, 4},
    ScalarType{"double", Kind::real, 8},
};

/// The type's name in the checksum seed, e.g. "uint8_t".
std::string_view wire_type_name(const Field& field) {
  const auto found = std::ranges::find_if(
      scalar_types, [&](const ScalarType& type) { return type.kind == field.kind && type.width == field.width; });
  return found->name;
}

class CrcX25 {
 public:
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint8_t>(c));
  }
  void add(std::uint8_t byte) {
    auto low = static_cast<std::uint8_t>(byte ^ (value_ & 0xFFU));
    low = static_cast<std::uint8_t>(low ^ (low << 4U));
    value_ = static_cast<std::uint16_t>((value_ >> 8U) ^ (low << 8U) ^ (low << 3U) ^ (low >> 4U));
  }
  [[nodiscard]] std::uint8_t folded() const { return static_cast<std::uint8_t>((value_ & 0xFFU) ^ (value_ >> 8U)); }

 private:
  std::uint16_t value_{0xFFFF};
};

/// One XML file while it is read.
class Document {
 public:
  Document(std::filesystem::path file, std::string_view text) : path{std::move(file)} {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') line_ends_.push_back(i);
    const auto parsed = xml_.load_buffer(text.data(), text.size());
    if (!parsed) throw DefinitionError{at(parsed.offset), fmt::format("not well-formed XML: {}", parsed.description())};
  }

  const std::filesystem::path path;

  [[nodiscard]] pugi::xml_node root() const {
    const auto found = xml_.child("mavlink");
    if (!found) throw DefinitionError{{path, 1}, "the root element is not <mavlink>"};
    return found;
  }
  [[nodiscard]] Source at(std::ptrdiff_t offset) const {
    const auto line = std::ranges::lower_bound(line_ends_, static_cast<std::size_t>(std::max(offset, {})));
    return {path, static_cast<std::size_t>(line - line_ends_.begin()) + 1};
  }
  [[nodiscard]] Source at(const pugi::xml_node& node) const { return at(node.offset_debug()); }
  [[noreturn]] void refuse(const pugi::xml_node& node, std::string_view what) const {
    throw DefinitionError{at(node), what};
  }
  [[nodiscard]] std::string attribute(const pugi::xml_node& node, const char* name) const {
    const auto found = node.attribute(name);
    if (!found || *found.value() == '\0') refuse(node, fmt::format("<{}> needs a {}", node.name(), name));
    return found.value();
  }

 private:
  pugi::xml_document xml_;
  std::vector<std::size_t> line_ends_;  ///< offsets of the newlines
};

std::optional<std::uint64_t> parse_digits(std::string_view text, int base) {
  std::uint64_t value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "12", "0x0C", "0b1100" or a power such as "2**5".
std::optional<std::uint64_t> parse_number(std::string_view text) {
  if (text.starts_with("2**")) {
    const auto exponent = parse_digits(text.substr(3), 10);
    if (!exponent || *exponent > 63) return std::nullopt;
    return std::uint64_t{1} << *exponent;
  }
  if (text.starts_with("0x") || text.starts_with("0X")) return parse_digits(text.substr(2), 16);
  if (text.starts_with("0b") || text.starts_with("0B")) return parse_digits(text.substr(2), 2);
  return parse_digits(text, 10);
}

/// Letters, digits and underscores of ASCII: what the names of messages and fields are made of.
bool is_plain(std::string_view name) {
  return std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::vector<std::size_t> order_of_definition(const Message& message) {
  std::vector<std::size_t> order(message.fields.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

class DialectReader {
 public:
  /// Without a search path there are no files, and includes are refused.
  explicit DialectReader(const std::vector<std::filesystem::path>* search_path) : search_path_{search_path} {}

  void read(const std::filesystem::path& path, std::size_t depth = 0) {
    std::error_code ignored;
    if (!read_.insert(std::filesystem::weakly_canonical(path, ignored)).second) return;
    read_text(path, read_file(path), depth);
  }

  void read_text(const std::filesystem::path& path, std::string_view text, std::size_t depth = 0) {
    const Document document{path, text};
    const auto root = document.root();
    read_wire(document, root, depth);
    for (const auto& include : root.children("include")) {
      if (depth == deepest_include) document.refuse(include, "includes are nested too deeply");
      read(resolve(document, include), depth + 1);
    }
    for (const auto& group : root.children("enums"))
      for (const auto& node : group.children("enum")) read_enumeration(document, node);
    for (const auto& group : root.children("messages"))
      for (const auto& node : group.children("message")) read_message(document, node);
  }

  [[nodiscard]] Protocol finish(std::string name) {
    Protocol protocol{.name = std::move(name), .messages = {}, .enumerations = {}, .v09 = v09_};
    for (auto& extension : extensions_) extend(extension);
    std::map<std::string, std::uint32_t> types;  ///< "A_1" and "A1" would be one struct
    for (auto& [key, message] : messages_) {
      const auto [twin, is_new] = types.emplace(pascal_case(message.key), message.number);
      if (!is_new)
        throw DefinitionError{message.source, fmt::format("the name {} of message {} is taken by message {}",
                                                          message.name, message.number, twin->second)};
      check_and_lay_out(message);
      protocol.messages.push_back(std::move(message));
    }
    for (auto& [key, enumeration] : enumerations_) {
      std::ranges::stable_sort(enumeration.entries, {}, &Entry::first);
      protocol.enumerations.push_back(std::move(enumeration));
    }
    return protocol;
  }

 private:
  /// By number. In MAVLink 0.9 several messages may share one if their lengths differ; elsewhere the length is left
  /// out.
  using MessageKey = std::pair<std::uint32_t, std::size_t>;

  [[nodiscard]] MessageKey key_of(const Message& message) const {
    std::size_t length = 0;
    if (v09_)
      for (const auto& field : message.fields) length += field.size();
    return {message.number, length};
  }

  /// What travels how: the attribute `wire` of the outermost file, which the files that it includes must share.
  void read_wire(const Document& document, const pugi::xml_node& root, std::size_t depth) {
    const std::string_view wire = root.attribute("wire").value();
    if (!wire.empty() && wire != "0.9") document.refuse(root, fmt::format("wire is '{}', expected 0.9 or none", wire));
    if (depth > 0 && v09_ != (wire == "0.9")) document.refuse(root, "it is included by a file of another wire format");
    v09_ = wire == "0.9";
  }

  [[nodiscard]] std::filesystem::path resolve(const Document& document, const pugi::xml_node& include) const {
    const std::string name = one_line(include.child_value());
    if (search_path_ == nullptr) document.refuse(include, fmt::format("'{}' cannot be included into a text", name));
    auto candidates = *search_path_;
    candidates.insert(candidates.begin(), document.path.parent_path());
    for (const auto& folder : candidates) {
      std::error_code error;
      if (!name.empty() && std::filesystem::is_regular_file(folder / name, error)) return folder / name;
    }
    document.refuse(include, fmt::format("included file '{}' was not found", name));
  }

  void read_enumeration(const Document& document, const pugi::xml_node& node) {
    const auto name = document.attribute(node, "name");
    if (!is_identifier(name)) document.refuse(node, fmt::format("enum name '{}' is not an identifier", name));
    auto& enumeration = enumerations_[name];
    if (enumeration.name.empty()) {
      enumeration.name = name;
      enumeration.source = document.at(node);
    }
    enumeration.bitmap |= node.attribute("bitmask").as_bool();
    std::uint64_t next = 0;
    for (const auto& item : node.children("entry")) {
      Entry entry;
      entry.name = document.attribute(item, "name");
      entry.source = document.at(item);
      if (!is_identifier(entry.name))
        document.refuse(item, fmt::format("entry name '{}' is not an identifier", entry.name));
      if (const auto text = item.attribute("value")) {
        const auto value = parse_number(text.value());
        if (!value) document.refuse(item, fmt::format("value '{}' of {} is not a number", text.value(), entry.name));
        next = *value;
      }
      entry.first = entry.last = next;
      next = entry.first + 1;
      add_entry(enumeration, std::move(entry));
    }
  }

  void add_entry(Enumeration& enumeration, Entry entry) {
    const auto twin = entries_.find(entry.name);
    if (twin == entries_.end()) {
      entries_.emplace(entry.name, std::pair{enumeration.name, entry.first});
      enumeration.entries.push_back(std::move(entry));
      return;
    }
    // Dialects repeat entries of the files they include; only a repeated name with another meaning is a mistake.
    if (twin->second != std::pair{enumeration.name, entry.first})
      throw DefinitionError{entry.source,
                            fmt::format("{} is {} of {} here, and {} of {} elsewhere", entry.name, entry.first,
                                        enumeration.name, twin->second.second, twin->second.first)};
  }

  void read_message(const Document& document, const pugi::xml_node& node) {
    Message message;
    message.source = document.at(node);
    message.name = document.attribute(node, "name");
    message.key = snake_case(message.name);
    if (!is_plain(message.name) || message.key.empty() ||
        std::ranges::find(taken_keys, message.key) != taken_keys.end())
      document.refuse(node, fmt::format("'{}' cannot be the name of a message", message.name));
    const auto number = parse_number(document.attribute(node, "id"));
    const std::uint64_t highest = v09_ ? 0xFF : 0xFFFFFF;
    if (!number || *number > highest)
      document.refuse(node, fmt::format("id of {} must be 0 to {}", message.name, highest));
    message.number = static_cast<std::uint32_t>(*number);
    const bool extends = node.attribute("extend").as_bool();
    bool extension = false;
    for (const auto& child : node.children()) {
      const std::string_view kind = child.name();
      if (kind == "extensions") extension = true;
      if (kind == "description") message.note = one_line(child.child_value());
      if (kind == "field") message.fields.push_back(read_field(document, child, extension));
    }
    if (v09_ && (extension || extends)) document.refuse(node, "MAVLink 0.9 has no extension fields");
    if (extends) {
      extensions_.push_back(std::move(message));
      return;
    }
    const auto twin = messages_.find(key_of(message));
    if (twin != messages_.end())
      document.refuse(node,
                      fmt::format("message {} has the id {} of {}, defined at {}:{}", message.name, message.number,
                                  twin->second.name, twin->second.source.file.string(), twin->second.source.line));
    messages_.emplace(key_of(message), std::move(message));
  }

  Field read_field(const Document& document, const pugi::xml_node& node, bool extension) const {
    Field field;
    field.source = document.at(node);
    field.name = document.attribute(node, "name");
    field.key = snake_case(field.name);
    if (!is_plain(field.name) || field.key.empty())
      document.refuse(node, fmt::format("'{}' cannot be the name of a field", field.name));
    field.unit = node.attribute("units").value();
    field.invalid = node.attribute("invalid").value();
    field.instance = node.attribute("instance").as_bool();
    field.enumeration = node.attribute("enum").value();
    if (std::string_view{node.attribute("display").value()} == "bitmask") field.role = "bitmap";
    field.note = one_line(node.child_value());
    field.extension = extension;

    const auto written = document.attribute(node, "type");
    std::string_view type = written;
    if (type == "uint8_t_mavlink_version") {
      type = "uint8_t";
      field.initial = v09_ ? "2" : "3";  // what every sender announces: 3 in MAVLink 1 and 2
    }
    if (const auto bracket = type.find('['); bracket != std::string_view::npos) {
      const auto count =
          type.back() == ']' ? parse_number(type.substr(bracket + 1, type.size() - bracket - 2)) : std::nullopt;
      if (!count || *count == 0 || *count > largest_payload)
        document.refuse(node, fmt::format("type '{}' of {}: the array length must be 1 to 255", written, field.name));
      field.count = static_cast<std::size_t>(*count);
      type = type.substr(0, bracket);
    }
    const auto found = std::ranges::find(scalar_types, type, &ScalarType::name);
    if (found == scalar_types.end())
      document.refuse(node, fmt::format("type '{}' of {} is not a MAVLink type", written, field.name));
    field.kind = found->kind;
    field.width = found->width;
    return field;
  }

  void extend(Message& extension) {
    const auto found = messages_.find(key_of(extension));
    if (found == messages_.end() || found->second.name != extension.name)
      throw DefinitionError{extension.source,
                            fmt::format("extends {} ({}), which is not defined", extension.name, extension.number)};
    for (auto& field : extension.fields) {
      // A newer package may have the field already.
      if (std::ranges::find(found->second.fields, field.name, &Field::name) != found->second.fields.end()) continue;
      field.extension = true;
      found->second.fields.push_back(std::move(field));
    }
  }

  void check_and_lay_out(Message& message) {
    std::set<std::string> keys;
    for (const auto& field : message.fields) {
      if (!keys.insert(field.key).second)
        throw DefinitionError{field.source, fmt::format("{} has two fields named {}", message.name, field.name)};
      if (field.enumeration.empty()) continue;
      const auto enumeration = enumerations_.find(field.enumeration);
      if (enumeration == enumerations_.end())
        throw DefinitionError{field.source, fmt::format("enum {} of {} is not defined", field.enumeration, field.name)};
      enumeration->second.bitmap |= field.role == "bitmap";
    }
    CrcX25 crc;
    crc.add(message.name + ' ');
    std::size_t offset = 0;
    for (const auto index : v09_ ? order_of_definition(message) : wire_order(message)) {
      auto& field = message.fields[index];
      field.offset = offset;
      offset += field.size();
      if (field.extension) continue;
      message.base_length = offset;
      crc.add(fmt::format("{} {} ", wire_type_name(field), field.name));
      if (field.count > 0) crc.add(static_cast<std::uint8_t>(field.count));
    }
    message.full_length = offset;
    if (!v09_) message.crc_extra = crc.folded();
    if (message.fields.empty()) throw DefinitionError{message.source, fmt::format("{} has no fields", message.name)};
    if (offset > largest_payload)
      throw DefinitionError{message.source,
                            fmt::format("{} needs {} bytes, more than the 255 of a frame", message.name, offset)};
  }

  const std::vector<std::filesystem::path>* search_path_;
  std::set<std::filesystem::path> read_;
  bool v09_{};
  std::map<MessageKey, Message> messages_;
  std::vector<Message> extensions_;
  std::map<std::string, Enumeration> enumerations_;
  std::map<std::string, std::pair<std::string, std::uint64_t>> entries_;  ///< name of an entry: its enum and value
};

std::string dialect_name(const std::filesystem::path& file) {
  auto name = snake_case(file.stem().string());
  if (name.empty()) throw DefinitionError{{file, 0}, "the file name must have a letter or digit, to name the dialect"};
  return name;
}

}  // namespace

std::vector<std::size_t> wire_order(const Message& message) {
  auto order = order_of_definition(message);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const auto& left = message.fields[a];
    const auto& right = message.fields[b];
    if (left.extension || right.extension) return !left.extension && right.extension;
    return left.width > right.width;
  });
  return order;
}

Protocol read_mavlink(const std::filesystem::path& file, const std::vector<std::filesystem::path>& search_path) {
  DialectReader reader{&search_path};
  reader.read(file);
  return reader.finish(dialect_name(file));
}

Protocol read_mavlink_text(std::string_view text, const std::filesystem::path& name) {
  DialectReader reader{nullptr};
  reader.read_text(name, text);
  return reader.finish(dialect_name(name));
}

}  // namespace ponte::definitions
