#include "ponte/dli/scale.hpp"

#include <cmath>
#include <numbers>

namespace ponte::dli {

Result<Scaled, ScaleError> scaled_from(double value, double scale, IntegerRange range) {
  if (std::isnan(value)) return fail(ScaleError::not_a_number);
  if (scale == 0) return fail(ScaleError::unknown_scale);
  const auto rounded = std::round(value / scale);
  if (rounded < static_cast<double>(range.first)) return Scaled{range.first, true};
  if (rounded > static_cast<double>(range.last)) return Scaled{range.last, true};
  return Scaled{static_cast<std::int64_t>(rounded), false};
}

Result<std::int32_t, ScaleError> bam_from_radians(double radians, std::uint8_t width) {
  if (!std::isfinite(radians)) return fail(ScaleError::not_a_number);
  const auto half_turn = std::ldexp(1.0, 8 * width - 1);
  const auto half_turns = std::remainder(radians * std::numbers::inv_pi, 2.0);
  const auto rounded = std::round(half_turns * half_turn);
  return static_cast<std::int32_t>(rounded == half_turn ? -half_turn : rounded);
}

Result<Scaled, ScaleError> raw_from_value(const FieldInfo& field, double scale, double value) {
  if (field.type != FieldType::bam) return scaled_from(value, scale, range_of(field));
  const auto raw = bam_from_radians(value, field.width);
  if (!raw) return fail(raw.error());
  return Scaled{*raw, false};
}

}  // namespace ponte::dli
