#pragma once

#include <cstddef>
#include <span>

namespace ponte::vsm {

/// What a series of measurements says, in their unit.
struct SeriesSummary {
  std::size_t count{};
  double mean{};
  double median{};
  double p95{};
  double p99{};
  double min{};
  double max{};
  double standard_deviation{};  ///< of a sample, over count - 1; 0 for a single value
  /// The straight line with the least squares, over the sample numbers 1, 2, ...; level for a single value.
  double slope{};      ///< unit per sample
  double intercept{};  ///< at the sample number 0

  [[nodiscard]] double peak_to_peak() const { return max - min; }
};

/// The value that a part of a series does not exceed: 0 gives the least, 0.5 the median, 1 the greatest. Between two
/// values it is interpolated. The series has at least one value and is in ascending order.
[[nodiscard]] double quantile(std::span<const double> ascending, double part);

/// The series has at least one value, and no NaN.
[[nodiscard]] SeriesSummary summarise(std::span<const double> series);

}  // namespace ponte::vsm
