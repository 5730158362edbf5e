#include "ponte/core/json_text.hpp"

#include "ponte/core/utf8.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace ponte {
namespace {

constexpr std::uint64_t largest_exact_integer = std::uint64_t{1} << 53U;

template <class T>
std::string_view special_name(T number) {
  return std::isnan(number) ? "NaN" : number > 0 ? "Infinity" : "-Infinity";
}

/// "-0" would be read back as the integer 0, which has no sign.
template <class T>
void append_finite(std::string& text, T number) {
  if (number == 0 && std::signbit(number))
    text += "-0.0";
  else
    fmt::format_to(std::back_inserter(text), "{}", number);
}

}  // namespace

void JsonText::separate() {
  if (needs_comma_) text_ += ',';
  needs_comma_ = true;
}

JsonText& JsonText::begin_object() {
  separate();
  text_ += '{';
  needs_comma_ = false;
  return *this;
}

JsonText& JsonText::end_object() {
  text_ += '}';
  needs_comma_ = true;
  return *this;
}

JsonText& JsonText::begin_array() {
  separate();
  text_ += '[';
  needs_comma_ = false;
  return *this;
}

JsonText& JsonText::end_array() {
  text_ += ']';
  needs_comma_ = true;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  value(name);
  text_ += ':';
  needs_comma_ = false;
  return *this;
}

JsonText& JsonText::value(std::string_view text) {
  separate();
  text_ += '"';
  while (!text.empty()) {
    const auto c = static_cast<unsigned char>(text.front());
    if (c == '"' || c == '\\') {
      text_ += '\\';
      text_ += text.front();
    } else if (c < 0x20 || c == 0x7F) {
      fmt::format_to(std::back_inserter(text_), "\\u{:04x}", c);
    } else if (const auto length = utf8_length(text); length > 0) {
      text_ += text.substr(0, length);
      text.remove_prefix(length - 1);
    } else {
      fmt::format_to(std::back_inserter(text_), "\\u{:04x}", c);
    }
    text.remove_prefix(1);
  }
  text_ += '"';
  return *this;
}

JsonText& JsonText::value(bool truth) {
  separate();
  text_ += truth ? "true" : "false";
  return *this;
}

JsonText& JsonText::value(double number) {
  if (!std::isfinite(number)) return value(special_name(number));
  separate();
  append_finite(text_, number);
  return *this;
}

JsonText& JsonText::value(float number) {
  if (!std::isfinite(number)) return value(special_name(number));
  separate();
  append_finite(text_, number);
  return *this;
}

JsonText& JsonText::value(std::int64_t number) {
  const auto magnitude = number < 0 ? ~static_cast<std::uint64_t>(number) : static_cast<std::uint64_t>(number);
  if (magnitude >= largest_exact_integer) return value(std::string_view{fmt::format("{}", number)});
  separate();
  fmt::format_to(std::back_inserter(text_), "{}", number);
  return *this;
}

JsonText& JsonText::value(std::uint64_t number) {
  if (number >= largest_exact_integer) return value(std::string_view{fmt::format("{}", number)});
  separate();
  fmt::format_to(std::back_inserter(text_), "{}", number);
  return *this;
}

JsonText& JsonText::written(std::string_view json) {
  separate();
  text_ += json;
  return *this;
}

void JsonText::clear() {
  text_.clear();
  needs_comma_ = false;
}

}  // namespace ponte
