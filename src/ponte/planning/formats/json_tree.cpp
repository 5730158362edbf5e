#include "ponte/planning/formats/json_tree.hpp"

#include "ponte/planning/formats/refusal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace ponte::planning {
namespace {

constexpr std::size_t deepest = 64;

/// Passes a text on, and counts for others how much of it was read.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* count) : at_{at}, count_{count} {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*count_;
    return *this;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  std::size_t* count_;
};

/// Builds the tree from the parser's events. Its functions have the names that nlohmann's parser calls.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const std::size_t& count) : text_{text}, count_{count} {}

  bool null() { return add({}); }
  bool boolean(bool truth) { return add({.kind = JsonValue::Kind::boolean, .truth = truth}); }
  bool number_integer(std::int64_t number) { return add_number(static_cast<double>(number)); }
  bool number_unsigned(std::uint64_t number) { return add_number(static_cast<double>(number)); }
  bool number_float(double number, const std::string&) { return add_number(number); }
  bool string(std::string& text) { return add({.kind = JsonValue::Kind::text, .text = text}); }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return open(JsonValue::Kind::object); }
  bool start_array(std::size_t) { return open(JsonValue::Kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    if (open_.back().find(name) != nullptr)
      return refuse_here(fmt::format("'{}' comes twice in one object", name), "each name once");
    names_.back() = name;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    const std::string_view what{error.what()};
    const auto reason = what.find("; ");
    return refuse_here(reason == what.npos ? "the text breaks off or is no JSON" : std::string{what.substr(reason + 2)},
                       "JSON");
  }

  [[nodiscard]] JsonValue take_root() { return std::move(root_); }
  [[nodiscard]] const FormatError& error() const { return error_; }

 private:
  bool refuse_here(std::string what, std::string expectation) {
    error_ = {at_line(line()), std::move(what), std::move(expectation)};
    return false;
  }

  /// Of the token just read: events come in the order of the text.
  std::size_t line() {
    const auto last = std::max<std::size_t>(count_, 1) - 1;
    line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                                 text_.begin() + static_cast<std::ptrdiff_t>(last), '\n'));
    counted_ = last;
    return line_;
  }

  bool add_number(double number) { return add({.kind = JsonValue::Kind::number, .number = number}); }

  bool add(JsonValue value) {
    if (value.line == 0) value.line = line();
    if (open_.empty()) {
      root_ = std::move(value);
    } else {
      value.name = names_.back();
      open_.back().elements.push_back(std::move(value));
    }
    return true;
  }

  bool open(JsonValue::Kind kind) {
    if (open_.size() == deepest) return refuse_here("it is nested too deeply", "at most 64 levels");
    open_.push_back({.kind = kind, .line = line(), .begin = count_ - 1});
    names_.emplace_back();
    return true;
  }

  bool close() {
    auto value = std::move(open_.back());
    value.end = count_;
    open_.pop_back();
    names_.pop_back();
    return add(std::move(value));
  }

  std::string_view text_;
  const std::size_t& count_;
  std::size_t counted_{};  ///< bytes whose line ends are in `line_`
  std::size_t line_{1};
  JsonValue root_;
  std::vector<JsonValue> open_;
  std::vector<std::string> names_;  ///< of the member that comes next, for each open value; empty in an array
  FormatError error_;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view wanted) const {
  if (kind != Kind::object) return nullptr;
  const auto member = std::ranges::find(elements, wanted, &JsonValue::name);
  return member == elements.end() ? nullptr : &*member;
}

JsonValue parse_json(std::string_view text) {
  std::size_t count = 0;
  TreeBuilder builder{text, count};
  const CountingIterator begin{text.data(), &count};
  const CountingIterator end{text.data() + text.size(), &count};
  if (!nlohmann::json::sax_parse(begin, end, &builder)) throw FormatError{builder.error()};
  return builder.take_root();
}

std::string shown(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::null: return "null";
    case JsonValue::Kind::boolean: return value.truth ? "true" : "false";
    case JsonValue::Kind::number: return fmt::format("{}", value.number);
    case JsonValue::Kind::text: return fmt::format("'{}'", value.text);
    case JsonValue::Kind::array: return "an array";
    case JsonValue::Kind::object: return "an object";
  }
  return {};
}

double number_of(const JsonValue& value, std::string_view name) {
  if (value.kind != JsonValue::Kind::number)
    refuse(at_line(value.line), fmt::format("{} is {}", name, shown(value)), "a number");
  return value.number;
}

const std::vector<JsonValue>& elements_of(const JsonValue& value, std::string_view name) {
  if (value.kind != JsonValue::Kind::array)
    refuse(at_line(value.line), fmt::format("{} is {}", name, shown(value)), "an array");
  return value.elements;
}

std::string_view text_of(const JsonValue& value, std::string_view name) {
  if (value.kind != JsonValue::Kind::text)
    refuse(at_line(value.line), fmt::format("{} is {}", name, shown(value)), "a text");
  return value.text;
}

const JsonValue& member_of(const JsonValue& object, std::string_view name) {
  if (object.kind != JsonValue::Kind::object)
    refuse(at_line(object.line), fmt::format("it is {}", shown(object)), fmt::format("an object with '{}'", name));
  const auto* value = object.find(name);
  if (value == nullptr) refuse(at_line(object.line), fmt::format("'{}' is missing", name), "an object that has it");
  return *value;
}

}  // namespace ponte::planning
