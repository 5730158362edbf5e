#include "mission/settings.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>

#include <charconv>

namespace ponte::app {

std::pair<std::string_view, std::string_view> split(std::string_view text, char at) {
  const auto found = text.find(at);
  if (found == std::string_view::npos) return {text, {}};
  return {text.substr(0, found), text.substr(found + 1)};
}

double number(std::string_view text, const std::string& whole, double least, double most) {
  double value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most))
    throw UsageError{fmt::format("'{}': '{}' is not a number from {} to {}", whole, text, least, most)};
  return value;
}

}  // namespace ponte::app
