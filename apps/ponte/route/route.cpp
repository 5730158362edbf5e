#include "route/route.hpp"

#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/log.hpp"
#include "common/standard_input.hpp"
#include "ponte/transport/line_reader.hpp"
#include "route/live_router.hpp"
#include "route/route_commands.hpp"
#include "route/route_limit.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

namespace ponte::app {
namespace {

using namespace std::chrono_literals;

struct Options {
  std::vector<std::string> endpoints;
  std::vector<std::string> untrusted;
  std::vector<std::string> limits;
  bool json{};
  bool commands{};
  double every_s{1};
  LogOptions log;
};

/// "ENDPOINT=MESSAGE:HZ", where the endpoint is one of those that are routed, as they were written.
struct LimitOption {
  std::string endpoint;
  mavlink::RouteRules::Limit limit;
};

LimitOption limit_from(const std::string& text) {
  const auto equals = text.rfind('=', text.rfind(':'));
  const auto limit = equals == std::string::npos ? std::nullopt : route_limit_from(text.substr(equals + 1));
  if (!limit)
    throw UsageError{fmt::format(
        "--limit {}: expected ENDPOINT=MESSAGE:HZ, e.g. udpin://0.0.0.0:14550=ATTITUDE:4; HZ 0 sends none", text)};
  return {text.substr(0, equals), *limit};
}

/// The rules of each endpoint, with its limits.
mavlink::RouteRules rules_for(const std::string& endpoint, bool untrusted, const std::vector<LimitOption>& limits) {
  mavlink::RouteRules rules{.untrusted = untrusted};
  for (const auto& option : limits)
    if (option.endpoint == endpoint) rules.limits.push_back(option.limit);
  return rules;
}

void check(const Options& options, const std::vector<LimitOption>& limits) {
  if (options.endpoints.size() + options.untrusted.size() < 2 && !options.commands)
    throw UsageError{"route: expected two endpoints or more, or --commands to add them"};
  for (const auto& option : limits)
    if (std::ranges::find(options.endpoints, option.endpoint) == options.endpoints.end() &&
        std::ranges::find(options.untrusted, option.endpoint) == options.untrusted.end())
      throw UsageError{fmt::format("--limit {}: no such endpoint is routed", option.endpoint)};
}

/// One line on the terminal, drawn anew; it makes room for the log.
void draw_status(const LiveRouter::Totals& now, const LiveRouter::Totals& before, double seconds) {
  const auto rate = [&](std::uint64_t newer, std::uint64_t older) {
    return newer < older ? 0.0 : static_cast<double>(newer - older) / seconds;
  };
  fmt::print(stderr, "\r{} links, {:.0f} frames/s in, {:.0f} frames/s out, {} dropped\x1b[K\r", now.links,
             rate(now.received, before.received), rate(now.sent, before.sent), now.dropped);
}

void run(const Options& options) {
  std::vector<LimitOption> limits;
  for (const auto& text : options.limits) limits.push_back(limit_from(text));
  check(options, limits);
  auto input = options.commands ? open_standard_input("--commands") : transport::FileDescriptor{};

  transport::Loop loop;
  const auto log = make_log(options.log);
  LiveRouter router{loop, log};
  for (const auto& text : options.endpoints)
    router.add(endpoint_from("ENDPOINT", text), rules_for(text, false, limits));
  for (const auto& text : options.untrusted)
    router.add(endpoint_from("--untrusted", text), rules_for(text, true, limits));

  RouteCommands commands{router, options.json};
  std::optional<transport::LineReader> reader;
  if (options.commands)
    reader.emplace(
        loop, std::move(input), [&](std::string_view line) { commands.obey(line); },
        [&](std::string_view reason) { log->info("commands are over: {}", reason); });

  // It would hide what somebody types.
  const bool has_status_line = !options.json && !options.commands && !options.log.quiet && ::isatty(STDERR_FILENO) != 0;
  const auto period = std::chrono::duration_cast<Duration>(std::chrono::duration<double>{options.every_s});
  LiveRouter::Totals before;
  transport::Timer timer{loop, [&](Timestamp now) {
                           if (options.json) router.print_json();
                           const auto totals = router.totals();
                           if (has_status_line) draw_status(totals, before, options.every_s);
                           before = totals;
                           timer.set(now + period);
                         }};
  if (options.json || has_status_line) timer.set(loop.now() + period);
  loop.on_signal([&](int) { loop.stop(); });
  loop.run();
  if (options.json) router.print_json();
  router.log_counters();
}

}  // namespace

void add_route(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("route", "Pass MAVLink on between endpoints, each message to those it is for");
  command->add_option("ENDPOINT", options->endpoints,
                      "Two or more, e.g. serial:///dev/ttyACM0:57600 udpin://0.0.0.0:14550");
  command->add_option("--untrusted", options->untrusted,
                      "One more endpoint, from and to which no SERIAL_CONTROL, FILE_TRANSFER_PROTOCOL and PREFLIGHT "
                      "command is passed on");
  command->add_option("--limit", options->limits,
                      "ENDPOINT=MESSAGE:HZ sends at most so many of each sender's messages there");
  command->add_flag("--commands", options->commands,
                    "Obey lines of stdin, each answered by a line: add ENDPOINT [untrusted] [MESSAGE:HZ]..., remove "
                    "ENDPOINT|NUMBER, list");
  command->add_flag("--json", options->json, "Print the statistics of every peer and endpoint as JSON lines");
  command->add_option("--every", options->every_s, "Seconds between two statistics")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte route udpin://0.0.0.0:14550 tcpin://0.0.0.0:5760");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
