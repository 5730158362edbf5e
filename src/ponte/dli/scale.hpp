#pragma once

#include "ponte/core/result.hpp"
#include "ponte/dli/integers.hpp"
#include "ponte/dli/message_info.hpp"

#include <cstdint>

/// Between physical values and the integers on the wire (Edition 3, data types).
namespace ponte::dli {

enum class ScaleError : std::uint8_t {
  not_a_number,   ///< NaN; for an angle, infinity as well
  unknown_scale,  ///< 0: the field has no physical value, or nobody knows its scale
};

struct Scaled {
  std::int64_t raw;
  bool saturated;  ///< the value was out of range; the standard wants the field absent then

  friend constexpr bool operator==(const Scaled&, const Scaled&) = default;
};

/// `value` / `scale`, rounded to the nearest integer (halves away from zero) and held within `range`.
[[nodiscard]] Result<Scaled, ScaleError> scaled_from(double value, double scale, IntegerRange range);

/// A binary angular measurement in a signed integer of `width` bytes, 1 to 4: one unit is pi / 2^(8 width - 1) rad. Any
/// angle is wrapped into [-pi, pi), so that 180 degrees are the most negative integer.
[[nodiscard]] Result<std::int32_t, ScaleError> bam_from_radians(double radians, std::uint8_t width);

/// In [-pi, pi) for every raw value that fits the width.
[[nodiscard]] constexpr double radians_from_bam(std::int32_t raw, std::uint8_t width) { return raw * bam_scale(width); }

/// The raw value of an integer field for a physical value in the field's unit. `scale` is what `Profile::scale_of`
/// says. A BAM wraps, any other integer saturates. To be asked of integer fields only.
[[nodiscard]] Result<Scaled, ScaleError> raw_from_value(const FieldInfo& field, double scale, double value);

}  // namespace ponte::dli
