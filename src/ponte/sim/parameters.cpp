#include "ponte/sim/parameters.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

Parameters::Parameters(Personality personality, AirframeType type)
    : table_{parameter_table(personality, type)}, values_(table_.rows.size()) {
  for (std::size_t i = 0; i < values_.size(); ++i) set(i, info(i).default_value);
}

std::optional<std::size_t> Parameters::find(std::string_view name) const {
  const auto name_of = [this](std::size_t index) { return info(index).name; };
  const auto found = std::ranges::lower_bound(table_.by_name, name, {}, name_of);
  if (found == table_.by_name.end() || name_of(*found) != name) return std::nullopt;
  return *found;
}

double Parameters::value(std::string_view name) const {
  const auto index = find(name);
  PONTE_ASSERT(index.has_value());
  return values_[*index];
}

double Parameters::default_value(std::size_t index) const {
  return to_type(info(index).default_value, info(index).type);
}

void Parameters::set(std::size_t index, double value) {
  PONTE_ASSERT(std::isfinite(value));
  values_[index] = to_type(value, info(index).type);
  ++changes_;
}

void Parameters::set(std::string_view name, double value) {
  const auto index = find(name);
  PONTE_ASSERT(index.has_value());
  set(*index, value);
}

}  // namespace ponte::sim
