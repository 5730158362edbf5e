#include "codegen/dli_reader.hpp"

#include "ponte/definitions/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace ponte::codegen {
namespace {

constexpr std::size_t widest_presence_vector = 8;
constexpr std::size_t longest_text = 255;
constexpr std::int64_t largest_number = 65000;
constexpr std::size_t longest_line = 4000;
constexpr double largest_scale = 1'000'000;
constexpr std::array confidences{"standard", "single-source", "inferred", "unknown"};
constexpr std::array roles{"enum", "bitmap", "id", "table", "country"};
constexpr std::array editions{"3", "A"};
/// Names of generated files that are not messages.
constexpr std::array taken_keys{"all", "catalogue", "enumerations"};

/// A TOML table with its file: reads typed keys, and refuses what is missing, mistyped or left over.
class Table {
 public:
  Table(const toml::table& table, const std::filesystem::path& file) : table_{table}, file_{file} {}

  [[nodiscard]] Source source() const { return at(table_); }
  [[nodiscard]] Source source(std::string_view key) const {
    const auto* node = table_.get(key);
    return node == nullptr ? source() : at(*node);
  }
  [[noreturn]] void refuse(std::string_view key, std::string_view expectation) const {
    throw DefinitionError{source(key), fmt::format("{}: {}", key, expectation)};
  }
  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }

  [[nodiscard]] std::string text(std::string_view key) {
    const auto value = optional_text(key);
    if (value.empty()) refuse(key, "a text is needed here");
    return value;
  }
  [[nodiscard]] std::string optional_text(std::string_view key) {
    const auto* node = take(key);
    if (node == nullptr) return {};
    const auto* value = node->as_string();
    if (value == nullptr) refuse(key, "must be a text");
    return value->get();
  }
  [[nodiscard]] std::string one_of(std::string_view key, auto choices, std::string_view otherwise) {
    if (!has(key)) return std::string{otherwise};
    auto value = text(key);
    if (std::ranges::find(choices, value) == choices.end())
      refuse(key, fmt::format("is '{}', expected one of {}", value, fmt::join(choices, ", ")));
    return value;
  }
  [[nodiscard]] std::int64_t number(std::string_view key, std::int64_t smallest, std::int64_t largest) {
    const auto* node = take(key);
    const auto* value = node == nullptr ? nullptr : node->as_integer();
    if (value == nullptr || value->get() < smallest || value->get() > largest)
      refuse(key, fmt::format("must be a whole number from {} to {}", smallest, largest));
    return value->get();
  }
  [[nodiscard]] double optional_real(std::string_view key) {
    const auto* node = take(key);
    if (node == nullptr) return 0;
    const auto value = node->value<double>();
    if (!node->is_number() || !value || !(*value > 0) || *value > largest_scale)
      refuse(key, fmt::format("must be a number above 0, at most {}", largest_scale));
    return *value;
  }
  [[nodiscard]] bool optional_flag(std::string_view key) {
    const auto* node = take(key);
    if (node == nullptr) return false;
    const auto* value = node->as_boolean();
    if (value == nullptr) refuse(key, "must be true or false");
    return value->get();
  }
  [[nodiscard]] std::vector<std::string> optional_texts(std::string_view key) {
    std::vector<std::string> result;
    const auto* node = take(key);
    if (node == nullptr) return result;
    const auto* list = node->as_array();
    if (list == nullptr) refuse(key, "must be a list of texts");
    for (const auto& item : *list) {
      if (!item.is_string()) refuse(key, "must be a list of texts");
      result.push_back(item.as_string()->get());
    }
    return result;
  }
  [[nodiscard]] std::vector<std::int64_t> optional_numbers(std::string_view key, std::int64_t smallest,
                                                           std::int64_t largest) {
    std::vector<std::int64_t> result;
    const auto* node = take(key);
    if (node == nullptr) return result;
    const auto expectation = fmt::format("must be a list of whole numbers from {} to {}", smallest, largest);
    const auto* list = node->as_array();
    if (list == nullptr) refuse(key, expectation);
    for (const auto& item : *list) {
      const auto* value = item.as_integer();
      if (value == nullptr || value->get() < smallest || value->get() > largest) refuse(key, expectation);
      result.push_back(value->get());
    }
    return result;
  }
  [[nodiscard]] std::vector<Table> optional_tables(std::string_view key) {
    std::vector<Table> result;
    const auto* node = take(key);
    if (node == nullptr) return result;
    const auto* list = node->as_array();
    if (list == nullptr) refuse(key, "must be a list of tables");
    for (const auto& item : *list) {
      if (!item.is_table()) refuse(key, "must be a list of tables");
      result.emplace_back(*item.as_table(), file_);
    }
    return result;
  }
  [[nodiscard]] std::optional<Table> optional_table(std::string_view key) {
    const auto* node = take(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_table()) refuse(key, "must be a table");
    return Table{*node->as_table(), file_};
  }
  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> result;
    for (const auto& [key, node] : table_) result.emplace_back(key.str());
    return result;
  }
  /// Every key must have been asked for by now.
  void refuse_the_rest() const {
    for (const auto& key : keys())
      if (!taken_.contains(key)) refuse(key, "is not a key that is known here");
  }

 private:
  [[nodiscard]] Source at(const toml::node& node) const { return {file_, node.source().begin.line}; }
  const toml::node* take(std::string_view key) {
    taken_.emplace(key);
    return table_.get(key);
  }

  const toml::table& table_;
  const std::filesystem::path& file_;
  std::set<std::string, std::less<>> taken_;
};

void read_type(Field& field, Table& table) {
  const auto type = table.text("type");
  const auto kind = type.front();
  std::size_t width{};
  const auto [end, error] = std::from_chars(type.data() + 1, type.data() + type.size(), width);
  const bool has_width = type.size() > 1 && error == std::errc{} && end == type.data() + type.size();
  const auto is = [&](char letter, std::size_t largest) {
    return kind == letter && has_width && width >= 1 && width <= largest;
  };
  if (is('u', 5)) {
    field.kind = Kind::unsigned_integer;
  } else if (is('i', 5)) {
    field.kind = Kind::signed_integer;
  } else if (is('b', 4)) {
    field.kind = Kind::bam;
  } else if (type == "f4") {
    field.kind = Kind::real;
  } else if (is('c', longest_text)) {
    field.kind = Kind::character;
    field.count = width;
    width = 1;
  } else if (type == "c") {
    field.kind = Kind::character;
    width = 0;
    field.length_from = static_cast<std::size_t>(table.number("length_from", 1, 64));
  } else {
    table.refuse("type",
                 fmt::format("is '{}', expected u1 to u5, i1 to i5, b1 to b4, f4, c1 to c{} or c", type, longest_text));
  }
  field.width = width;
}

Field read_field(Table& table) {
  Field field;
  field.source = table.source();
  field.number = static_cast<std::size_t>(table.number("n", 1, 64));
  field.unique_id = table.optional_text("id");
  field.excluded = table.optional_flag("excluded");
  read_type(field, table);
  if (field.excluded) {
    field.name = "out of scope";
    field.key = fmt::format("excluded_{}", field.number);
  } else {
    field.name = table.text("name");
    field.key = snake_case(field.name);
    field.enumeration = table.optional_text("enum");
    field.role = table.one_of("role", roles, field.enumeration.empty() ? "" : "enum");
    field.unit = table.optional_text("unit");
    field.scale = table.optional_real("scale");
    field.since_edition_a = table.one_of("since", std::array{"A"}, "") == "A";
    for (const auto& guess : table.optional_texts("guess")) {
      if (guess != "type" && guess != "scale") table.refuse("guess", "may name \"type\" and \"scale\"");
      field.guessed = true;
    }
    field.note = table.optional_text("note");
    if (field.key.empty()) table.refuse("name", "must have a letter or digit");
    if (field.scale != 0 && !field.is_integer()) table.refuse("scale", "only an integer has a scale");
    if (!field.role.empty() && !field.is_integer())
      table.refuse("role", "only an integer can be an enum, bitmap or id");
  }
  table.refuse_the_rest();
  return field;
}

/// True when `field` tells the length of a variable text that comes after it.
bool can_tell_length(const Field& field) { return field.kind == Kind::unsigned_integer && !field.excluded; }

void check_fields(const Message& message, Table& table) {
  std::set<std::string> keys;
  for (std::size_t i = 0; i < message.fields.size(); ++i) {
    const auto& field = message.fields[i];
    if (field.number != i + 1)
      throw DefinitionError{
          field.source, fmt::format("n: is {}, expected {}: fields are numbered without gaps", field.number, i + 1)};
    if (!keys.insert(field.key).second)
      throw DefinitionError{field.source, fmt::format("name: '{}' stands twice in #{}", field.name, message.number)};
    if (field.length_from == 0) continue;
    if (field.length_from >= field.number || !can_tell_length(message.fields[field.length_from - 1]))
      throw DefinitionError{field.source, "length_from: must name an earlier field that is an unsigned integer"};
  }
  for (std::size_t e = 0; e < editions.size(); ++e) {
    std::size_t last = 0;
    for (const auto& field : message.fields)
      if (e == 1 || !field.since_edition_a) last = field.number;
    if (message.presence_bytes[e] != 0 && message.presence_bytes[e] * 8 < last)
      table.refuse("presence_bytes", fmt::format("{} bytes cannot mark field {} of Edition {}",
                                                 message.presence_bytes[e], last, editions[e]));
  }
}

Message read_message(Table& table) {
  Message message;
  message.source = table.source();
  message.number = static_cast<std::uint32_t>(table.number("number", 1, largest_number));
  message.name = table.text("name");
  message.name_a = table.has("name_a") ? table.text("name_a") : message.name;
  message.key = table.has("key") ? table.text("key") : snake_case(message.name);
  if (message.key.empty()) table.refuse("name", "must have a letter or digit");
  if (message.key != snake_case(message.key)) table.refuse("key", "must be snake_case");
  if (std::ranges::find(taken_keys, message.key) != taken_keys.end())
    table.refuse(table.has("key") ? "key" : "name",
                 fmt::format("'{}' is the name of another generated file", message.key));
  for (const auto& edition : table.optional_texts("editions")) {
    const auto found = std::ranges::find(editions, edition);
    if (found == editions.end()) table.refuse("editions", fmt::format("'{}' is not one of 3, A", edition));
    message.in_edition[static_cast<std::size_t>(found - editions.begin())] = true;
  }
  if (!message.in_edition[0] && !message.in_edition[1]) table.refuse("editions", "name at least one of 3, A");
  if (auto widths = table.optional_table("presence_bytes")) {
    for (std::size_t e = 0; e < editions.size(); ++e)
      if (widths->has(editions[e]))
        message.presence_bytes[e] = static_cast<std::size_t>(widths->number(editions[e], 1, widest_presence_vector));
    widths->refuse_the_rest();
  }
  message.direction = table.one_of("direction", std::array{"CUCS->VSM", "VSM->CUCS", "both"}, "both");
  message.exchange = table.one_of("exchange", std::array{"push", "pull", "push/pull"}, "push");
  message.confidence = table.one_of("confidence", confidences, "unknown");
  message.confidence_ed3 = table.one_of("confidence_ed3", confidences, "unknown");
  message.sources = table.optional_texts("source");
  message.note = table.optional_text("note");
  if (table.has("number_ed2"))
    message.number_ed2 = static_cast<std::uint32_t>(table.number("number_ed2", 1, largest_number));
  if (table.has("latency_ms")) message.latency_ms = static_cast<std::uint32_t>(table.number("latency_ms", 1, 60'000));
  message.levels = table.optional_numbers("loi", 1, 5);
  for (auto& field : table.optional_tables("fields")) message.fields.push_back(read_field(field));
  table.refuse_the_rest();
  check_fields(message, table);
  for (std::size_t e = 0; e < editions.size(); ++e)
    if (message.in_edition[e] && !message.fields.empty() && message.presence_bytes[e] == 0)
      table.refuse("presence_bytes", fmt::format("Edition {} is missing", editions[e]));
  message.partial = message.fields.empty() || std::ranges::any_of(message.fields, &Field::lacks_scale);
  return message;
}

Enumeration read_enumeration(std::string name, Table& table) {
  Enumeration enumeration;
  enumeration.name = std::move(name);
  enumeration.source = table.source();
  enumeration.confidence = table.one_of("confidence", confidences, "unknown");
  enumeration.bitmap = table.optional_flag("bitmap");
  for (auto& item : table.optional_tables("values")) {
    constexpr std::int64_t largest = 0xFFFFFFFF;
    Entry entry;
    entry.source = item.source();
    const bool is_range = item.has("first");
    entry.first = static_cast<std::uint64_t>(item.number(is_range ? "first" : "value", 0, largest));
    entry.last = is_range ? static_cast<std::uint64_t>(item.number("last", 0, largest)) : entry.first;
    entry.name = item.text("label");
    entry.note = item.optional_text("note");
    item.refuse_the_rest();
    if (snake_case(entry.name).empty()) item.refuse("label", "must have a letter or digit");
    if (entry.last < entry.first) item.refuse("last", "is below first");
    if (!enumeration.entries.empty() && entry.first <= enumeration.entries.back().last)
      item.refuse(is_range ? "first" : "value", "values must ascend");
    enumeration.entries.push_back(std::move(entry));
  }
  table.refuse_the_rest();
  return enumeration;
}

Group read_group(Table& table) {
  Group group;
  group.name = table.text("name");
  group.first = static_cast<std::uint32_t>(table.number("first", 0, largest_number));
  group.last = static_cast<std::uint32_t>(table.number("last", 0, largest_number));
  if (group.last < group.first) table.refuse("last", "is below first");
  group.message_count = static_cast<std::uint32_t>(table.number("messages_in_ed3", 0, largest_number));
  group.table = table.text("ed3_table");
  table.refuse_the_rest();
  return group;
}

/// toml++ 3.3 goes one call deeper for every dot of a key: a line of nothing but dots would exhaust the stack.
void check_lines(std::string_view text, const std::filesystem::path& file) {
  for (std::size_t line = 1, begin = 0; begin < text.size(); ++line) {
    const auto end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest_line)
      throw DefinitionError{{file, line}, fmt::format("the line is longer than {} characters", longest_line)};
    begin = end + 1;
  }
}

void read_file_into(Protocol& protocol, std::string_view text, const std::filesystem::path& file) {
  check_lines(text, file);
  toml::table parsed;
  try {
    parsed = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw DefinitionError{{file, error.source().begin.line}, error.description()};
  }
  Table table{parsed, file};
  for (auto& message : table.optional_tables("message")) {
    protocol.messages.push_back(read_message(message));
  }
  if (auto enumerations = table.optional_table("enum"))
    for (const auto& name : enumerations->keys()) {
      auto entry = enumerations->optional_table(name);
      if (name.empty() || name != snake_case(name)) enumerations->refuse(name, "must be snake_case");
      protocol.enumerations.push_back(read_enumeration(name, *entry));
    }
  for (auto& group : table.optional_tables("group")) protocol.groups.push_back(read_group(group));
  table.refuse_the_rest();
}

void check_protocol(Protocol& protocol) {
  std::ranges::stable_sort(protocol.messages, {}, &Message::number);
  std::ranges::stable_sort(protocol.enumerations, {}, &Enumeration::name);
  std::set<std::string> keys;
  for (std::size_t i = 0; i < protocol.messages.size(); ++i) {
    const auto& message = protocol.messages[i];
    if (i > 0 && protocol.messages[i - 1].number == message.number)
      throw DefinitionError{message.source, fmt::format("number: {} is defined twice", message.number)};
    if (!keys.insert(pascal_case(message.key)).second)  // "a_1" and "a1" are one struct name
      throw DefinitionError{message.source, fmt::format("key: '{}' is taken by another message", message.key)};
    for (const auto& field : message.fields)
      if (!field.enumeration.empty() && protocol.find_enumeration(field.enumeration) == nullptr)
        throw DefinitionError{field.source, fmt::format("enum: '{}' is not defined", field.enumeration)};
  }
  for (std::size_t i = 1; i < protocol.enumerations.size(); ++i)
    if (protocol.enumerations[i - 1].name == protocol.enumerations[i].name)
      throw DefinitionError{protocol.enumerations[i].source,
                            fmt::format("enum: '{}' is defined twice", protocol.enumerations[i].name)};
}

}  // namespace

Protocol read_dli(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator{folder, error})
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw DefinitionError{{folder, 0}, "no *.toml definition files are here"};
  std::ranges::sort(files);
  Protocol protocol{"dli", {}, {}, {}};
  for (const auto& file : files) read_file_into(protocol, read_file(file), file);
  check_protocol(protocol);
  return protocol;
}

Protocol read_dli_text(std::string_view text, const std::filesystem::path& name) {
  Protocol protocol{"dli", {}, {}, {}};
  read_file_into(protocol, text, name);
  check_protocol(protocol);
  return protocol;
}

}  // namespace ponte::codegen
