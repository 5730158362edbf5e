#include "ponte/sim/parameters.hpp"

#include "ponte/core/assert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ponte::sim {
namespace {

template <class Integer>
double to_integer(double value) {
  using Limits = std::numeric_limits<Integer>;
  return std::clamp(std::round(value), double{Limits::min()}, double{Limits::max()});
}

double to_type(double value, ParameterType type) {
  switch (type) {
    case ParameterType::int8: return to_integer<std::int8_t>(value);
    case ParameterType::int16: return to_integer<std::int16_t>(value);
    case ParameterType::int32: return to_integer<std::int32_t>(value);
    case ParameterType::real32: {
      constexpr double most = std::numeric_limits<float>::max();
      return static_cast<float>(std::clamp(value, -most, most));
    }
  }
  return value;
}

/// "MORE_0000" and so on, which stay where they are.
std::string_view name_of_another(std::size_t number) {
  static const auto names = [] {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < Parameters::most_more; ++i) result.push_back(fmt::format("MORE_{:04}", i));
    return result;
  }();
  return names[number];
}

}  // namespace

Parameters::Parameters(Personality personality, AirframeType type, std::size_t more)
    : table_{parameter_table(personality, type)} {
  PONTE_ASSERT(more <= most_more);
  for (std::size_t i = 0; i < more; ++i)
    table_.push_back({name_of_another(i), ParameterType::real32, static_cast<double>(i)});
  values_.resize(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) set(i, table_[i].default_value);
}

std::optional<std::size_t> Parameters::find(std::string_view name) const {
  const auto found =
      std::find_if(table_.begin(), table_.end(), [=](const ParameterInfo& each) { return each.name == name; });
  if (found == table_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table_.begin());
}

double Parameters::value(std::string_view name) const {
  const auto index = find(name);
  PONTE_ASSERT(index.has_value());
  return values_[*index];
}

double Parameters::default_value(std::size_t index) const {
  return to_type(table_[index].default_value, table_[index].type);
}

void Parameters::set(std::size_t index, double value) {
  PONTE_ASSERT(std::isfinite(value));
  values_[index] = to_type(value, table_[index].type);
  ++changes_;
}

void Parameters::set(std::string_view name, double value) {
  const auto index = find(name);
  PONTE_ASSERT(index.has_value());
  set(*index, value);
}

}  // namespace ponte::sim
