#include "ponte/autopilot/parameter.hpp"

#include "ponte/core/bytes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

/// Calls `act` with a zero of the type.
template <class Act>
auto with_type(ParameterType type, Act&& act) {
  switch (type) {
    case ParameterType::uint8: return act(std::uint8_t{});
    case ParameterType::int8: return act(std::int8_t{});
    case ParameterType::uint16: return act(std::uint16_t{});
    case ParameterType::int16: return act(std::int16_t{});
    case ParameterType::uint32: return act(std::uint32_t{});
    case ParameterType::int32: return act(std::int32_t{});
    case ParameterType::real32: break;
  }
  return act(float{});
}

}  // namespace

std::optional<ParameterType> parameter_type(std::uint8_t mav_param_type) {
  const bool is_known = (mav_param_type >= 1 && mav_param_type <= 6) || mav_param_type == 9;
  if (!is_known) return std::nullopt;
  return static_cast<ParameterType>(mav_param_type);
}

bool is_value_of(ParameterType type, double value) {
  return with_type(type, [value]<class Number>(Number) {
    using Limits = std::numeric_limits<Number>;
    const bool is_in_range =
        value >= static_cast<double>(Limits::lowest()) && value <= static_cast<double>(Limits::max());
    return is_in_range && (std::floating_point<Number> || value == std::trunc(value));
  });
}

double decode_parameter(Stack stack, ParameterType type, float wire) {
  if (stack != Stack::px4) return double{wire};
  const auto bytes = std::bit_cast<std::array<std::byte, sizeof wire>>(wire);
  return with_type(type, [&]<class Number>(Number) { return static_cast<double>(load_le<Number>(bytes.data())); });
}

float encode_parameter(Stack stack, ParameterType type, double value) {
  if (stack != Stack::px4) return static_cast<float>(value);
  std::array<std::byte, sizeof(float)> bytes{};
  with_type(type, [&]<class Number>(Number) {
    store_le(bytes.data(), static_cast<Number>(value));
    return 0;
  });
  return std::bit_cast<float>(bytes);
}

}  // namespace ponte::autopilot
