#include "latency/report.hpp"

#include "latency/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ponte::app {
namespace {

using vsm::LatencySample;
using vsm::LatencyStudy;
using vsm::SeriesSummary;

constexpr std::size_t times = 3;  ///< the first of the quantities; the others are stages

constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>Latency study</title>
<style>
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1d2430; --faint: #5b6472; --rule: #d9dee6;
  --direct: #0063a6; --converted: #b34700; --delay: #00745a; --pass: #00623f; --fail: #b3002d; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #14181f; --ink: #e6eaf0; --faint: #a3adbb; --rule: #343c48;
    --direct: #6cb6f5; --converted: #f5a15f; --delay: #56d0ae; --pass: #5fd6a0; --fail: #ff8098; }
}
body { margin: 2rem auto; max-width: 56rem; padding: 0 1rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .5rem; }
h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; }
.verdict { border-left: .4rem solid; padding: .4rem .8rem; font-weight: 600; }
.pass { color: var(--pass); }
.fail { color: var(--fail); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--rule); padding: .2rem .5rem; text-align: right; }
th { white-space: nowrap; }
th:first-child, td.text { text-align: left; }
td.text { color: var(--faint); }
svg { display: block; width: 100%; height: auto; font-size: 13px; }
svg text { fill: var(--ink); }
.grid { stroke: var(--rule); }
.zero { stroke: var(--faint); }
.line { fill: none; stroke-width: 1.8; }
.direct { stroke: var(--direct); fill: var(--direct); }
.converted { stroke: var(--converted); fill: var(--converted); }
.delay { stroke: var(--delay); fill: var(--delay); }
.trend { stroke: var(--ink); stroke-dasharray: 7 4; }
.line.direct, .line.converted, .line.delay { fill: none; }
</style>
</head>
<body>
<h1>Latency study</h1>
)";

constexpr std::string_view meaning = R"(<h2>What is measured</h2>
<p>Each sample is one MAVLink ATTITUDE that became one STANAG 4586 message #4000, presented both ways: <b>direct</b> is
receive, decode, present; <b>converted</b> is the same message received, decoded, translated, encoded, sent and presented
from the bytes of the DLI message; <b>delay</b> is converted less direct. Presenting is writing the message out as a line
of JSON; both are written once before, so that neither warms the caches for the other. The stamps are of one monotonic
clock, beginning with the last byte received. The network beyond the sending socket is not part of it. The greatest
delay is judged.</p>
)";

void append_row(std::string& html, std::string_view name, std::string_view text, const SeriesSummary& summary) {
  fmt::format_to(std::back_inserter(html),
                 R"(<tr><th scope="row">{}</th><td class="text">{}</td><td>{:.1f}</td><td>{:.1f}</td><td>{:.1f}</td>)"
                 "<td>{:.1f}</td><td>{:.1f}</td><td>{:.1f}</td><td>{:.1f}</td></tr>\n",
                 name, text, summary.mean, summary.median, summary.p95, summary.p99, summary.min, summary.max,
                 summary.standard_deviation);
}

constexpr std::string_view table_head =
    R"(<div class="scroll"><table><thead><tr><th scope="col">µs</th><th></th><th scope="col">mean</th>)"
    R"(<th scope="col">median</th><th scope="col">p95</th><th scope="col">p99</th><th scope="col">min</th>)"
    R"(<th scope="col">max</th><th scope="col">st. dev.</th></tr></thead><tbody>)"
    "\n";
constexpr std::string_view table_end = "</tbody></table></div>\n";

void append_times(std::string& html, const LatencyStudy& study) {
  html += "<h2>Times</h2>\n";
  html += table_head;
  for (const auto& quantity : vsm::latency_quantities().first(times))
    append_row(html, quantity.name, quantity.meaning, summary_of(study, quantity.of));
  html += table_end;
}

void append_stages(std::string& html, const LatencyStudy& study) {
  html += "<h2>Stages</h2>\n";
  html += table_head;
  for (const auto& quantity : vsm::latency_quantities().subspan(times)) {
    std::string name{quantity.name};
    std::ranges::replace(name, '_', ' ');
    append_row(html, name, quantity.meaning, summary_of(study, quantity.of));
  }
  if (!study.wakeups_late_us.empty())
    append_row(html, "timer late", "wake-ups of the same program", vsm::summarise(study.wakeups_late_us));
  html += table_end;
}

ChartLine line_of(const LatencyStudy& study, const vsm::LatencyQuantity& quantity, Mark mark) {
  return {.name = quantity.name, .style = quantity.name, .mark = mark, .values = series_of(study, quantity.of)};
}

ChartLine trend_of(const SeriesSummary& summary) {
  ChartLine line{.name = "linear trend", .style = "trend", .mark = Mark::none, .values = {}};
  for (std::size_t number = 1; number <= summary.count; ++number)
    line.values.push_back(summary.intercept + summary.slope * static_cast<double>(number));
  return line;
}

std::string description_of(const std::vector<ChartLine>& lines) {
  std::string text;
  for (const auto& line : lines) {
    const auto [least, greatest] = std::ranges::minmax(line.values);
    fmt::format_to(std::back_inserter(text), "{}{}: {:.1f} to {:.1f} µs", text.empty() ? "" : "; ", line.name, least,
                   greatest);
  }
  return text;
}

void append_chart(std::string& html, std::string_view id, std::string_view title, std::vector<ChartLine> lines) {
  auto description = description_of(lines);
  fmt::format_to(
      std::back_inserter(html), "<h2>{}</h2>\n{}", title,
      svg_text({.id = id, .title = title, .description = std::move(description), .lines = std::move(lines)}));
}

void append_charts(std::string& html, const LatencyStudy& study) {
  const auto quantities = vsm::latency_quantities();
  const auto direct = line_of(study, quantities[0], Mark::circle);
  const auto converted = line_of(study, quantities[1], Mark::square);
  const auto delay = line_of(study, quantities[2], Mark::triangle);
  append_chart(html, "times", "Both times", {direct, converted});
  append_chart(html, "times-and-delay", "Both times and the delay", {direct, converted, delay});
  append_chart(html, "trend", "The delay and its trend", {delay, trend_of(vsm::summarise(delay.values))});
  fmt::format_to(std::back_inserter(html), "<p>{}</p>\n", trend_text(study));
}

void append_conditions(std::string& html, const LatencyStudy& study) {
  html += "<h2>Conditions</h2>\n<table><tbody>\n";
  for (const auto& condition : study.conditions)
    fmt::format_to(std::back_inserter(html), "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td></tr>\n",
                   escaped(condition.name), escaped(condition.value));
  html += "</tbody></table>\n";
}

}  // namespace

std::string trend_text(const LatencyStudy& study) {
  const auto delay = summary_of(study, [](const LatencySample& s) { return s.delay(); });
  return fmt::format("delay = {:.2f} us {} {:.3f} us x sample", delay.intercept, delay.slope < 0 ? '-' : '+',
                     std::abs(delay.slope));
}

std::string verdict_text(const LatencyStudy& study) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto& samples = study.samples;
  const auto worst = std::ranges::max_element(samples, {}, &LatencySample::delay);
  const Milliseconds delay = worst->delay();
  const Milliseconds limit = study.limit;
  if (passes(study))
    return fmt::format("PASS: the greatest delay, {:.3f} ms, is below the limit of {} ms", delay.count(),
                       limit.count());
  return fmt::format("FAIL: the greatest delay, {:.3f} ms (sample {} of {}), is {:.3f} ms above the limit of {} ms",
                     delay.count(), worst - samples.begin() + 1, samples.size(), (delay - limit).count(),
                     limit.count());
}

std::string html_text(const LatencyStudy& study) {
  std::string html{head};
  fmt::format_to(std::back_inserter(html), "<p class=\"verdict {}\">{}</p>\n", passes(study) ? "pass" : "fail",
                 escaped(verdict_text(study)));
  append_times(html, study);
  append_charts(html, study);
  append_stages(html, study);
  html += meaning;
  append_conditions(html, study);
  html += "</body>\n</html>\n";
  return html;
}

}  // namespace ponte::app
