#include "ponte/autopilot/parameter_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

namespace ponte::autopilot {
namespace {

/// Reads the lines of one file. Errors leave it as exceptions, which `read_parameter_file` returns.
class Reader {
 public:
  std::vector<ParameterLine> read(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    for (line_ = 1; !text.empty(); ++line_) {
      const auto length = std::min(text.find('\n'), text.size());
      read_line(text.substr(0, length));
      text.remove_prefix(std::min(length + 1, text.size()));
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(std::string what, std::string expectation) const {
    throw ParameterFileError{line_, std::move(what), std::move(expectation)};
  }

  void read_line(std::string_view line) {
    const auto fields = fields_of(line.substr(0, line.find('#')));
    if (fields.empty()) return;
    constexpr std::size_t mavproxy_fields = 2;
    constexpr std::size_t qgroundcontrol_fields = 5;
    ParameterLine entry{.line = line_};
    if (fields.size() == mavproxy_fields) {
      entry.name = name(fields[0]);
      entry.value = value(fields[1]);
    } else if (fields.size() == qgroundcontrol_fields) {
      entry.system = integer(fields[0], "vehicle");
      entry.component = integer(fields[1], "component");
      entry.name = name(fields[2]);
      entry.value = value(fields[3]);
      entry.type = type(fields[4]);
      if (!is_value_of(*entry.type, entry.value))
        refuse(fmt::format("the value is '{}'", fields[3]), fmt::format("one that type {} has", fields[4]));
    } else {
      refuse(fmt::format("it has {} fields", fields.size()),
             "2: name, value; or 5: vehicle, component, name, value, type");
    }
    // Components of one vehicle may have parameters of the same name.
    if (!names_.emplace(entry.component.value_or(0), std::string{entry.name.view()}).second)
      refuse(fmt::format("the name {} comes twice", entry.name.view()), "each name once");
    result_.push_back(entry);
  }

  [[nodiscard]] static std::vector<std::string_view> fields_of(std::string_view line) {
    constexpr std::string_view space = " \t\r";
    std::vector<std::string_view> fields;
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(space), line.size()));
      if (line.empty()) return fields;
      const auto length = std::min(line.find_first_of(space), line.size());
      fields.push_back(line.substr(0, length));
      line.remove_prefix(length);
    }
  }

  [[nodiscard]] ParameterName name(std::string_view field) const {
    const auto is_letter = [](char c) {
      return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (field.size() > ParameterName::capacity || !std::ranges::all_of(field, is_letter))
      refuse(fmt::format("the name is '{}'", field), "up to 16 letters, digits and underscores");
    return field;
  }

  template <class Number>
  [[nodiscard]] static std::optional<Number> number(std::string_view field) {
    Number result{};
    const auto* const end = field.data() + field.size();
    const auto read = std::from_chars(field.data(), end, result);
    if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
    return result;
  }

  /// What no parameter can hold is refused here; that it fits its type is looked at where the type is known.
  [[nodiscard]] double value(std::string_view field) const {
    const auto result = number<double>(field.starts_with('+') ? field.substr(1) : field);
    const bool is_possible = result && std::abs(*result) <= std::numeric_limits<float>::max();
    if (!is_possible) refuse(fmt::format("the value is '{}'", field), "a number");
    return *result;
  }

  [[nodiscard]] std::uint8_t integer(std::string_view field, std::string_view what) const {
    const auto result = number<std::uint8_t>(field);
    if (!result) refuse(fmt::format("the {} is '{}'", what, field), "an integer from 0 to 255");
    return *result;
  }

  [[nodiscard]] ParameterType type(std::string_view field) const {
    const auto result = number<std::uint8_t>(field);
    const auto known = result ? parameter_type(*result) : std::nullopt;
    if (!known) refuse(fmt::format("the type is '{}'", field), "a MAV_PARAM_TYPE: 1 to 6, or 9");
    return *known;
  }

  std::size_t line_{};
  std::set<std::pair<unsigned, std::string>> names_;
  std::vector<ParameterLine> result_;
};

/// The shortest text that is read as this very value.
std::string value_text(const Parameter& parameter) {
  const bool is_integer = parameter.type != ParameterType::real32 && is_value_of(parameter.type, parameter.value);
  if (is_integer) return fmt::format("{}", static_cast<std::int64_t>(parameter.value));
  return fmt::format("{}", static_cast<float>(parameter.value));
}

}  // namespace

Result<std::vector<ParameterLine>, ParameterFileError> read_parameter_file(Bytes file) try {
  return Reader{}.read({reinterpret_cast<const char*>(file.data()), file.size()});
} catch (const ParameterFileError& error) {
  return fail(error);
}

std::string write_qgroundcontrol_file(std::span<const Parameter> parameters, std::uint8_t system,
                                      std::uint8_t component) {
  std::string text = "# Onboard parameters\n#\n# Vehicle-Id Component-Id Name Value Type\n";
  for (const auto& each : parameters)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\n", system, component, each.name.view(), value_text(each),
                        static_cast<unsigned>(each.type));
  return text;
}

std::string write_mavproxy_file(std::span<const Parameter> parameters) {
  std::string text;
  for (const auto& each : parameters) text += fmt::format("{:<16} {}\n", each.name.view(), value_text(each));
  return text;
}

}  // namespace ponte::autopilot
