#include "ponte/vsm/latency_study.hpp"

#include "ponte/core/assert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace ponte::vsm {
namespace {

using Sample = LatencySample;

constexpr std::array<LatencyQuantity, 8> quantities{{
    {"direct", "receive, decode, present", [](const Sample& s) { return s.direct(); }},
    {"converted", "the same, and translate, encode, send", [](const Sample& s) { return s.converted(); }},
    {"delay", "converted less direct", [](const Sample& s) { return s.delay(); }},
    {"decode", "find the frame, examine its checksum", [](const Sample& s) { return s.decoded - s.received; }},
    {"translate", "and encode", [](const Sample& s) { return s.translated - s.decoded; }},
    {"send", "hand to the network", [](const Sample& s) { return s.sent - s.translated; }},
    {"present_direct", "the MAVLink message", [](const Sample& s) { return s.present_direct; }},
    {"present_converted", "the DLI message, decoded first", [](const Sample& s) { return s.present_converted; }},
}};

/// Calls `visit(name, number)` for each figure of a sample, in the order of the columns.
template <class Visit>
void for_each_figure(const LatencyStudy& study, std::size_t index, Visit visit) {
  PONTE_ASSERT(index >= 1 && index <= study.samples.size());
  const auto& sample = study.samples[index - 1];
  const auto start = study.samples.front().received;
  visit("index", std::uint64_t{index});
  visit("time_us", unix_us(sample.time));
  visit("sequence", std::uint64_t{sample.sequence});
  visit("received_us", microseconds(sample.received - start));
  visit("decoded_us", microseconds(sample.decoded - sample.received));
  visit("translated_us", microseconds(sample.translated - sample.received));
  visit("sent_us", microseconds(sample.sent - sample.received));
  visit("present_direct_us", microseconds(sample.present_direct));
  visit("present_converted_us", microseconds(sample.present_converted));
  visit("direct_us", microseconds(sample.direct()));
  visit("converted_us", microseconds(sample.converted()));
  visit("delay_us", microseconds(sample.delay()));
}

void append(JsonText& json, std::string_view name, const SeriesSummary& summary) {
  json.key(name).begin_object();
  json.member("count", std::uint64_t{summary.count});
  json.member("mean_us", summary.mean);
  json.member("median_us", summary.median);
  json.member("p95_us", summary.p95);
  json.member("p99_us", summary.p99);
  json.member("min_us", summary.min);
  json.member("max_us", summary.max);
  json.member("standard_deviation_us", summary.standard_deviation);
  json.member("peak_to_peak_us", summary.peak_to_peak());
  json.member("slope_us_per_sample", summary.slope);
  json.member("intercept_us", summary.intercept);
  json.end_object();
}

}  // namespace

std::span<const LatencyQuantity> latency_quantities() { return quantities; }

double microseconds(Duration time) { return static_cast<double>(time.count()) / 1000; }

std::vector<double> series_of(const LatencyStudy& study, Duration (*of)(const Sample&)) {
  std::vector<double> series;
  series.reserve(study.samples.size());
  for (const auto& sample : study.samples) series.push_back(microseconds(of(sample)));
  return series;
}

SeriesSummary summary_of(const LatencyStudy& study, Duration (*of)(const Sample&)) {
  return summarise(series_of(study, of));
}

bool passes(const LatencyStudy& study) {
  return !study.samples.empty() &&
         std::ranges::all_of(study.samples, [&](const Sample& sample) { return sample.delay() < study.limit; });
}

void append_sample(JsonText& json, const LatencyStudy& study, std::size_t index) {
  json.begin_object();
  for_each_figure(study, index, [&](std::string_view name, auto number) { json.member(name, number); });
  json.end_object();
}

void append_summary(JsonText& json, const LatencyStudy& study) {
  json.member("limit_ms", std::chrono::duration<double, std::milli>(study.limit).count());
  json.member("pass", passes(study));
  json.key("summary").begin_object();
  for (const auto& quantity : quantities) append(json, quantity.name, summary_of(study, quantity.of));
  json.end_object();
  if (!study.wakeups_late_us.empty()) append(json, "wakeups_late", summarise(study.wakeups_late_us));
  json.key("conditions").begin_object();
  for (const auto& condition : study.conditions) json.key(condition.name).value(condition.value);
  json.end_object();
}

void append_study(JsonText& json, const LatencyStudy& study) {
  json.begin_object();
  append_summary(json, study);
  json.key("samples").begin_array();
  for (std::size_t index = 1; index <= study.samples.size(); ++index) append_sample(json, study, index);
  json.end_array().end_object();
}

std::string csv_text(const LatencyStudy& study) {
  std::string text;
  const auto append_line = [&](std::size_t index, auto cell) {
    std::string_view separator;
    for_each_figure(study, index, [&](std::string_view name, auto number) {
      text += separator;
      cell(name, number);
      separator = ",";
    });
    text += '\n';
  };
  append_line(1, [&](std::string_view name, auto) { text += name; });
  for (std::size_t index = 1; index <= study.samples.size(); ++index)
    append_line(index, [&](std::string_view, auto number) { fmt::format_to(std::back_inserter(text), "{}", number); });
  return text;
}

}  // namespace ponte::vsm
