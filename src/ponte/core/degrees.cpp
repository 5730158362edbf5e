#include "ponte/core/degrees.hpp"

#include <array>
#include <charconv>
#include <numbers>

namespace ponte {

double degrees_from_radians(Radians angle) {
  const double degrees = angle.value * (180 / std::numbers::pi);
  constexpr int always_exact = 17;
  for (int digits = 15; digits < always_exact; ++digits) {
    std::array<char, 32> text{};
    const auto written =
        std::to_chars(text.data(), text.data() + text.size(), degrees, std::chars_format::scientific, digits - 1);
    double shorter{};
    std::from_chars(text.data(), written.ptr, shorter);
    if (radians_from_degrees(shorter) == angle) return shorter;
  }
  return degrees;
}

}  // namespace ponte
