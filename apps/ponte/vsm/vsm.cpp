#include "vsm/vsm.hpp"

#include "common/endpoint_option.hpp"
#include "common/json_line.hpp"
#include "common/log.hpp"
#include "common/outgoing.hpp"
#include "common/realtime.hpp"
#include "common/vsm_options.hpp"
#include "ponte/transport/loop.hpp"
#include "vsm/live_vsm.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

namespace ponte::app {
namespace {

struct Options {
  std::vector<std::string> vehicles;
  std::vector<std::string> dli;
  VsmOptions vsm;
  bool json{};
  bool every_sample{};
  bool listen_only{};
  double refresh_s{5};
  std::optional<int> realtime;
  LogOptions log;
};

void run(const Options& options) {
  vsm::BridgeConfig config;
  config.telemetry = telemetry_config_from(options.vsm);
  if (options.every_sample)
    config.rates = vsm::TelemetryRates{};
  else
    config.rates.full_refresh = std::chrono::duration_cast<Duration>(std::chrono::duration<double>{options.refresh_s});
  config.fleet.ask_for_streams = !options.listen_only;

  transport::Loop loop;
  LiveVsm vsm{loop, config, make_log(options.log)};
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
  vsm.on_finished([&] { loop.stop(); });
  if (options.realtime) enter_realtime(*options.realtime);
  loop.run();
  vsm.log_counters();
}

}  // namespace

void add_vsm(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("vsm", "Make MAVLink vehicles STANAG 4586 vehicles (telemetry; monitor only)");
  command
      ->add_option("--vehicle", options->vehicles,
                   "Where vehicles are, e.g. serial:///dev/ttyACM0:57600; file:///... replays a recording")
      ->required();
  command->add_option("--dli", options->dli, "Where ground stations are, e.g. udpmulticast://239.255.45.86:45860");
  add_vsm_options(*command, options->vsm);
  command->add_flag("--json", options->json, "Print one JSON object per DLI message on stdout");
  command->add_flag("--every-sample", options->every_sample, "A message for every sample, with unchanged fields too");
  command->add_option("--full-refresh", options->refresh_s, "Seconds after which unchanged fields are told again")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command->add_flag("--listen-only", options->listen_only, "Do not ask vehicles for their streams");
  add_realtime_option(*command, options->realtime);
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte vsm --vehicle udpin://0.0.0.0:14550 --dli udpmulticast://239.255.45.86:45860");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
