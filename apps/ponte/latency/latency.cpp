#include "latency/latency.hpp"

#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "common/load_file.hpp"
#include "common/log.hpp"
#include "common/realtime.hpp"
#include "common/vsm_options.hpp"
#include "latency/conditions.hpp"
#include "latency/report.hpp"
#include "latency/study_run.hpp"

#include <fmt/chrono.h>
#include <CLI/CLI.hpp>

#include <unistd.h>

#include <memory>
#include <variant>

namespace ponte::app {
namespace {

struct Options {
  std::string vehicle;
  std::string dli;
  VsmOptions vsm;
  std::size_t samples{30};
  double limit_ms{500};
  double patience_s{30};
  std::optional<int> realtime;
  bool json{};
  std::string csv_file, json_file, html_file;
  LogOptions log;
};

Duration duration_from(std::chrono::duration<double> time) { return std::chrono::round<Duration>(time); }

StudyPlan plan_from(const Options& options) {
  StudyPlan plan{.vehicle = endpoint_from("--vehicle", options.vehicle),
                 .dli = {},
                 .telemetry = telemetry_config_from(options.vsm),
                 .samples = options.samples,
                 .patience = duration_from(std::chrono::duration<double>{options.patience_s}),
                 .realtime = options.realtime};
  if (std::holds_alternative<transport::FileEndpoint>(plan.vehicle))
    throw UsageError{
        fmt::format("--vehicle {}: a recording is decoded before it is replayed, so there is nothing to "
                    "measure; expected a link to a vehicle",
                    options.vehicle)};
  if (!options.dli.empty()) plan.dli = endpoint_from("--dli", options.dli);
  return plan;
}

std::vector<vsm::LatencyCondition> conditions_of(const Options& options, WallTime begin) {
  auto conditions = conditions_of_this_machine();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(begin);
  conditions.push_back({"time", fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", seconds)});
  conditions.push_back({"vehicle", options.vehicle});
  conditions.push_back({"dli", options.dli.empty() ? "a socket of our own on the loopback interface" : options.dli});
  conditions.push_back({"samples", fmt::format("{}", options.samples)});
  conditions.push_back(
      {"realtime", options.realtime ? fmt::format("SCHED_FIFO {}, memory locked", *options.realtime) : "no"});
  return conditions;
}

/// Counts on a terminal, in a line that the next output writes over; nothing elsewhere.
void show_progress(std::size_t count, const Options& options) {
  if (options.log.quiet || ::isatty(STDERR_FILENO) == 0) return;
  constexpr auto erase = "\033[K\r";
  if (count < options.samples)
    fmt::print(stderr, "{} of {} samples{}", count, options.samples, erase);
  else
    fmt::print(stderr, "{}", erase);
}

void print_json(const vsm::LatencyStudy& study) {
  JsonText json;
  for (std::size_t index = 1; index <= study.samples.size(); ++index) {
    append_sample(json, study, index);
    print_line(json);
  }
  json.begin_object();
  append_summary(json, study);
  json.end_object();
  print_line(json);
}

void print_summary(std::string_view name, const vsm::SeriesSummary& summary) {
  fmt::print("{:<18}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}\n", name, summary.mean, summary.median,
             summary.p95, summary.p99, summary.min, summary.max, summary.standard_deviation);
}

void print_samples(const vsm::LatencyStudy& study) {
  const auto quantities = vsm::latency_quantities();
  fmt::print("sample");
  for (const auto& quantity : quantities) fmt::print("{:>{}}", quantity.name, quantity.name.size() + 3);
  fmt::print("\n");
  for (std::size_t i = 0; i < study.samples.size(); ++i) {
    fmt::print("{:>6}", i + 1);
    for (const auto& quantity : quantities)
      fmt::print("{:>{}.1f}", vsm::microseconds(quantity.of(study.samples[i])), quantity.name.size() + 3);
    fmt::print("\n");
  }
}

void print_summaries(const vsm::LatencyStudy& study) {
  fmt::print("{:<18}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "", "mean", "median", "p95", "p99", "min", "max",
             "st.dev.");
  for (const auto& quantity : vsm::latency_quantities()) print_summary(quantity.name, summary_of(study, quantity.of));
  if (!study.wakeups_late_us.empty()) print_summary("timer late", vsm::summarise(study.wakeups_late_us));
}

void print_tables(const vsm::LatencyStudy& study) {
  fmt::print(
      "All times in microseconds. direct: receive, decode, present; converted: the same message, also translated,\n"
      "encoded and sent; delay: converted less direct; timer late: wake-ups that were due every {} ms.\n\n",
      std::chrono::duration_cast<std::chrono::milliseconds>(WakeupWatch::period).count());
  print_samples(study);
  fmt::print("\n");
  print_summaries(study);
  const auto converted = summary_of(study, [](const vsm::LatencySample& s) { return s.converted(); });
  fmt::print("\ntrend   {}\njitter  of converted: standard deviation {:.1f} us, peak to peak {:.1f} us\n{}\n",
             trend_text(study), converted.standard_deviation, converted.peak_to_peak(), verdict_text(study));
}

void save(const std::string& file, const std::string& text) {
  if (!file.empty()) save_file(file, std::as_bytes(std::span{text}));
}

void run(const Options& options) {
  StudyRun run{plan_from(options), make_log(options.log), [&](std::size_t count) { show_progress(count, options); }};
  const auto begin = transport::Loop::wall();
  auto data = run.run();
  const vsm::LatencyStudy study{.limit = duration_from(std::chrono::duration<double, std::milli>{options.limit_ms}),
                                .samples = std::move(data.samples),
                                .wakeups_late_us = std::move(data.wakeups_late_us),
                                .conditions = conditions_of(options, begin)};
  options.json ? print_json(study) : print_tables(study);
  JsonText json;
  append_study(json, study);
  save(options.json_file, json.text() + '\n');
  save(options.csv_file, csv_text(study));
  save(options.html_file, html_text(study));
  if (!passes(study)) throw Failure{verdict_text(study)};
}

}  // namespace

void add_latency(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("latency", "Measure how much later an attitude comes when it is converted");
  command->add_option("--vehicle", options->vehicle, "Where the vehicle is, e.g. serial:///dev/ttyACM0:57600")
      ->required();
  command->add_option("--dli", options->dli, "Where the DLI messages go; by default to ourselves");
  add_vsm_options(*command, options->vsm);
  command->add_option("--samples", options->samples, "How many attitudes")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--limit-ms", options->limit_ms, "The delay that no sample may reach, in milliseconds")
      ->check(CLI::Range(0.000'001, 60'000.0))
      ->capture_default_str();
  command->add_option("--patience", options->patience_s, "Give up when no sample comes for so many seconds")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  add_realtime_option(*command, options->realtime);
  command->add_flag("--json", options->json, "Print one JSON object per sample, then one with the summary, on stdout");
  command->add_option("--output-csv", options->csv_file, "Write the samples");
  command->add_option("--output-json", options->json_file, "Write everything as one JSON object");
  command->add_option("--output-html", options->html_file, "Write a page with tables and charts");
  add_log_options(*command, options->log);
  command->footer(
      "Example:\n  ponte latency --vehicle udpin://127.0.0.1:14550 --samples 30 --limit-ms 500 --output-html out.html");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
