#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/core/text.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

/// Parameters of an autopilot, and how their values travel.
namespace ponte::autopilot {

/// Of at most 16 characters.
using ParameterName = Text<16>;

/// MAV_PARAM_TYPE, as far as a value of four bytes can have it.
enum class ParameterType : std::uint8_t {
  uint8 = 1,
  int8 = 2,
  uint16 = 3,
  int16 = 4,
  uint32 = 5,
  int32 = 6,
  real32 = 9,
};

[[nodiscard]] std::optional<ParameterType> parameter_type(std::uint8_t mav_param_type);

struct Parameter {
  ParameterName name{};
  ParameterType type{ParameterType::real32};
  double value{};
  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// Whether this is a value of the type: a whole number in its range, or one that a float comes near to.
[[nodiscard]] bool is_value_of(ParameterType type, double value);

/// The value in the float of PARAM_VALUE. ArduPilot turns every number into a float; PX4 puts the bytes of integers
/// there. Neither sets the capability that would tell, so that the stack decides.
[[nodiscard]] double decode_parameter(Stack stack, ParameterType type, float wire);
/// The inverse, of a value of this type.
[[nodiscard]] float encode_parameter(Stack stack, ParameterType type, double value);

}  // namespace ponte::autopilot
