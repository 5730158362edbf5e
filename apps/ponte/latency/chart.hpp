#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ponte::app {

enum class Mark { none, circle, square, triangle };

/// One value per sample. Lines are told apart by the shape of their marks or by dashes, not by colour alone.
struct ChartLine {
  std::string_view name;
  std::string_view style;  ///< CSS class, which gives colour and dashes
  Mark mark{};
  std::vector<double> values;
};

/// A diagram of microseconds over sample numbers.
struct Chart {
  std::string_view id;  ///< unique in the page
  std::string_view title;
  std::string description;  ///< for who cannot see it
  std::vector<ChartLine> lines;
};

/// The chart as an `svg` element for an HTML page that has the CSS classes. Every line has as many values as the first,
/// at least one.
[[nodiscard]] std::string svg_text(const Chart& chart);

/// A text with what HTML and XML reserve replaced.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace ponte::app
