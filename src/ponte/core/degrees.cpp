#include "ponte/core/degrees.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace ponte {

namespace {

double rounded(double number, int digits) {
  std::array<char, 32> text{};
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::scientific, digits - 1);
  double result{};
  std::from_chars(text.data(), written.ptr, result);
  return result;
}

}  // namespace

double degrees_from_radians(Radians angle) {
  const double degrees = angle.value * (180 / std::numbers::pi);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double candidate : {rounded(degrees, 15), rounded(degrees, 16), degrees, std::nextafter(degrees, infinity),
                                 std::nextafter(degrees, -infinity)})
    if (radians_from_degrees(candidate) == angle) return candidate;
  return degrees;
}

}  // namespace ponte
