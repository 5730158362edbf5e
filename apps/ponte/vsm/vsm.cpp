#include "vsm/vsm.hpp"

#include "common/dialect_option.hpp"
#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "common/kept_signer.hpp"
#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "common/outgoing.hpp"
#include "common/realtime.hpp"
#include "common/vsm_options.hpp"
#include "ponte/transport/loop.hpp"
#include "vsm/live_vsm.hpp"
#include "web/bridge_server.hpp"
#include "web/http_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>

namespace ponte::app {
namespace {

struct Options {
  std::vector<std::string> vehicles;
  std::vector<std::string> dli;
  std::string dialect;
  VsmOptions vsm;
  MavlinkOptions mavlink;
  bool json{};
  bool every_sample{};
  bool listen_only{};
  double refresh_s{5};
  std::optional<int> realtime;
  HttpOptions http;
  LogOptions log;
};

/// The bridge page, if it is wanted. Where it is goes to stderr even when the log is quiet, as a secret may be in it.
std::unique_ptr<BridgeServer> start_server(transport::Loop& loop, LiveVsm& vsm, const Options& options,
                                           const Log& log) {
  auto wanted = bridge_server_options_from(options.http);
  if (!wanted) return nullptr;
  if (!options.vsm.dli.profile.empty())
    wanted->profile_name = std::filesystem::path{options.vsm.dli.profile}.stem().string();
  auto server = std::make_unique<BridgeServer>(loop, vsm, std::move(*wanted), log);
  fmt::print(stderr, "The bridge page is at {}\n", server->url());
  return server;
}

void run(const Options& options) {
  if (options.vehicles.empty() && options.http.address.empty())
    throw UsageError{"vsm: expected --vehicle ENDPOINT, or --http ADDRESS:PORT to connect from the page"};
  vsm::BridgeConfig config;
  config.telemetry = telemetry_config_from(options.vsm);
  if (options.every_sample)
    config.rates = vsm::TelemetryRates{};
  else
    config.rates.full_refresh = std::chrono::duration_cast<Duration>(std::chrono::duration<double>{options.refresh_s});
  config.fleet.ask_for_streams = !options.listen_only;
  config.fleet.version = version_from(options.mavlink);
  config.link_policy = link_policy_from(options.mavlink);
  const ChosenDialect dialect{options.dialect};
  config.dialect = &dialect.dialect();

  transport::Loop loop;
  const auto log = make_log(options.log);
  const auto kept = kept_signer_from(loop, options.mavlink, log);
  LiveVsm vsm{loop, config, log, kept ? &kept->signer() : nullptr};
  for (const auto& text : options.vehicles) vsm.add_vehicle(endpoint_from("--vehicle", text));
  for (const auto& text : options.dli) vsm.add_dli(endpoint_from("--dli", text));
  JsonText json;
  if (options.json)
    vsm.observe([&](const vsm::OutgoingMessage& message) {
      append_json(json, message, config.telemetry.profile);
      print_line(json);
      std::fflush(stdout);
    });
  loop.on_signal([&](int) { loop.stop(); });
  const auto server = start_server(loop, vsm, options, log);
  if (!server) vsm.on_finished([&] { loop.stop(); });
  if (options.realtime) enter_realtime(*options.realtime);
  loop.run();
  vsm.log_counters();
}

}  // namespace

void add_vsm(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("vsm", "Make MAVLink vehicles STANAG 4586 vehicles (telemetry; monitor only)");
  command->add_option("--vehicle", options->vehicles,
                      "Where vehicles are, e.g. serial:///dev/ttyACM0:57600; file:///... replays a recording");
  command->add_option("--dli", options->dli, "Where ground stations are, e.g. udpmulticast://239.255.45.86:45860");
  add_mavlink_options(*command, options->mavlink, "Version that a vehicle is spoken to in until it shows its own");
  add_dialect_option(*command, options->dialect);
  add_vsm_options(*command, options->vsm);
  command->add_flag("--json", options->json, "Print one JSON object per DLI message on stdout");
  command->add_flag("--every-sample", options->every_sample, "A message for every sample, with unchanged fields too");
  command->add_option("--full-refresh", options->refresh_s, "Seconds after which unchanged fields are told again")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command->add_flag("--listen-only", options->listen_only, "Do not ask vehicles for their streams");
  add_realtime_option(*command, options->realtime);
  add_http_options(*command, options->http);
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte vsm --vehicle udpin://0.0.0.0:14550 --dli udpmulticast://239.255.45.86:45860");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
