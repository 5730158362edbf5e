#include "latency/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ponte::app {
namespace {

// The drawing in its own units; the page scales it.
constexpr double width = 760, height = 320;
constexpr double left = 72, right = 744, top = 40, bottom = 272;
constexpr double legend_step = 170;
constexpr std::size_t marks_max = 200;  ///< with more samples the marks would hide each other
constexpr double tick_gaps = 5;

/// The least of 1, 2, 5, 10, 20, ... (and 0.5, 0.2, ...) that divides a span into no more than about `tick_gaps`.
double nice_step(double span) {
  const auto rough = span / tick_gaps;
  const auto power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const auto factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power) return factor * power;
  return 10 * power;
}

/// Values from low to high, with a tick at both ends.
struct Scale {
  double low{};
  double high{};
  double step{};

  explicit Scale(const std::vector<ChartLine>& lines) {
    for (const auto& line : lines)
      for (const auto value : line.values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    step = high > low ? nice_step(high - low) : 1;
    low = std::floor(low / step) * step;
    high = std::max(std::ceil(high / step) * step, low + step);
  }

  [[nodiscard]] double y(double value) const { return bottom - (value - low) / (high - low) * (bottom - top); }
};

double x_of(std::size_t index, std::size_t count) {
  if (count == 1) return (left + right) / 2;
  constexpr double margin = 10;
  return left + margin + static_cast<double>(index) / static_cast<double>(count - 1) * (right - left - 2 * margin);
}

void append_mark(std::string& svg, Mark mark, std::string_view style, double x, double y) {
  auto out = std::back_inserter(svg);
  switch (mark) {
    case Mark::none: return;
    case Mark::circle:
      fmt::format_to(out, R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="3.5"/>)", style, x, y);
      return;
    case Mark::square:
      fmt::format_to(out, R"(<rect class="{}" x="{:.1f}" y="{:.1f}" width="6.5" height="6.5"/>)", style, x - 3.25,
                     y - 3.25);
      return;
    case Mark::triangle:
      fmt::format_to(out, R"(<path class="{}" d="M{:.1f} {:.1f}l4.5 7.5h-9z"/>)", style, x, y - 5);
      return;
  }
}

void append_axes(std::string& svg, const Scale& scale, std::size_t count) {
  auto out = std::back_inserter(svg);
  const auto digits = std::max(0, -static_cast<int>(std::floor(std::log10(scale.step))));
  const auto gaps = static_cast<int>(std::lround((scale.high - scale.low) / scale.step));
  for (int i = 0; i <= gaps; ++i) {
    const auto value = scale.low + i * scale.step;
    const auto y = scale.y(value);
    fmt::format_to(out, R"(<path class="{}" d="M{} {:.1f}H{}"/>)", std::abs(value) < scale.step / 2 ? "zero" : "grid",
                   left, y, right);
    fmt::format_to(out, R"(<text x="{}" y="{:.1f}" text-anchor="end">{:.{}f}</text>)", left - 8, y + 4, value, digits);
  }
  const auto step = count > 1 ? std::max(1.0, nice_step(static_cast<double>(count) / 2)) : 1.0;
  for (std::size_t number = 1; number <= count; ++number)
    if (number == 1 || number % static_cast<std::size_t>(step) == 0)
      fmt::format_to(out, R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", x_of(number - 1, count),
                     bottom + 20, number);
  fmt::format_to(out, R"(<text x="{}" y="{}" text-anchor="middle">sample</text>)", (left + right) / 2, height - 8);
  fmt::format_to(out, R"svg(<text transform="translate(16 {}) rotate(-90)" text-anchor="middle">time, µs</text>)svg",
                 (top + bottom) / 2);
}

void append_line(std::string& svg, const ChartLine& line, const Scale& scale, double legend_x) {
  const auto count = line.values.size();
  auto out = std::back_inserter(svg);
  constexpr double legend_y = 18;
  fmt::format_to(out, R"(<path class="line {}" d="M{} {}h30"/>)", line.style, legend_x, legend_y);
  append_mark(svg, line.mark, line.style, legend_x + 15, legend_y);
  fmt::format_to(out, R"(<text x="{}" y="{}">{}</text>)", legend_x + 38, legend_y + 4, escaped(line.name));

  fmt::format_to(out, R"(<polyline class="line {}" points=")", line.style);
  for (std::size_t i = 0; i < count; ++i)
    fmt::format_to(out, "{:.1f},{:.1f} ", x_of(i, count), scale.y(line.values[i]));
  svg += R"("/>)";
  for (std::size_t i = 0; i < count && count <= marks_max; ++i)
    append_mark(svg, line.mark, line.style, x_of(i, count), scale.y(line.values[i]));
  svg += '\n';
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const auto c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

std::string svg_text(const Chart& chart) {
  auto svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-labelledby="{}-title {}-description">
<title id="{}-title">{}</title>
<desc id="{}-description">{}</desc>
)",
                         width, height, chart.id, chart.id, chart.id, escaped(chart.title), chart.id,
                         escaped(chart.description));
  const Scale scale{chart.lines};
  append_axes(svg, scale, chart.lines.front().values.size());
  svg += '\n';
  auto legend_x = left;
  for (const auto& line : chart.lines) {
    append_line(svg, line, scale, legend_x);
    legend_x += legend_step;
  }
  svg += "</svg>\n";
  return svg;
}

}  // namespace ponte::app
