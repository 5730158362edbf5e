#include "ponte/vsm/series.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace ponte::vsm {

double quantile(std::span<const double> ascending, double part) {
  PONTE_ASSERT(!ascending.empty() && part >= 0 && part <= 1);
  const auto place = part * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, ascending.size() - 1);
  return std::lerp(ascending[below], ascending[above], place - std::floor(place));
}

SeriesSummary summarise(std::span<const double> series) {
  PONTE_ASSERT(!series.empty());
  std::vector<double> ascending{series.begin(), series.end()};
  std::ranges::sort(ascending);
  const auto count = static_cast<double>(series.size());
  SeriesSummary summary{.count = series.size(),
                        .mean = std::accumulate(series.begin(), series.end(), 0.0) / count,
                        .median = quantile(ascending, 0.5),
                        .p95 = quantile(ascending, 0.95),
                        .p99 = quantile(ascending, 0.99),
                        .min = ascending.front(),
                        .max = ascending.back()};
  summary.intercept = summary.mean;
  if (series.size() == 1) return summary;

  const auto middle = (count + 1) / 2;  // the mean of the sample numbers
  double squares = 0;
  double products = 0;
  double number_squares = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto number = static_cast<double>(i + 1) - middle;
    const auto value = series[i] - summary.mean;
    squares += value * value;
    products += number * value;
    number_squares += number * number;
  }
  summary.standard_deviation = std::sqrt(squares / (count - 1));
  summary.slope = products / number_squares;
  summary.intercept = summary.mean - summary.slope * middle;
  return summary;
}

}  // namespace ponte::vsm
