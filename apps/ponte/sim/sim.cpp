#include "sim/sim.hpp"

#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/kept_signer.hpp"
#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "common/standard_input.hpp"
#include "ponte/transport/line_reader.hpp"
#include "ponte/transport/pty.hpp"
#include "sim/fleet.hpp"
#include "sim/vehicle_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

namespace ponte::app {
namespace {

struct Options {
  std::vector<std::string> endpoints{"udpout://127.0.0.1:14550"};
  std::string pty;
  MavlinkOptions mavlink;
  bool is_local{};
  sim::Personality personality{sim::Personality::ardupilot};
  sim::AirframeType type{sim::AirframeType::copter};
  unsigned vehicles{1};
  std::string wind;
  std::vector<std::string> faults;
  std::vector<std::string> parameters;
  std::size_t mission_items{};
  bool radio{};
  std::size_t baud{};
  unsigned system{1};
  std::string home;
  double speedup{1};
  std::uint64_t seed{1};
  std::optional<double> arm_after_s;
  LogOptions log;
};

constexpr std::size_t bits_per_byte = 10;  // on a serial line, with start and stop
constexpr double spacing_m = 20;           // from one vehicle of many to the next, eastwards

/// The vehicle that is the n-th of many.
sim::VehicleConfig config_of(const Options& options, unsigned n) {
  sim::VehicleConfig config;
  config.personality = options.personality;
  config.type = options.type;
  if (options.mission_items != 0) config.mission_items = options.mission_items;
  if (options.baud != 0) config.line_rate = options.baud / bits_per_byte;
  config.radio = options.radio;
  for (const auto& each : options.parameters) config.parameters.push_back(setting_from(each, config));
  config.fly_square = options.arm_after_s.has_value();
  config.system = mavlink::SystemId{static_cast<std::uint8_t>(options.system + n)};
  config.version = version_from(options.mavlink);
  config.seed = options.seed + n;
  config.power_on = transport::Loop::wall();
  if (!options.home.empty()) config.start = position_from(options.home);
  config.start = sim::displaced(config.start, {0, spacing_m * n, 0});
  if (!options.wind.empty()) config.wind = wind_from(options.wind);
  std::vector<std::string> faults;
  std::ranges::copy_if(options.faults, std::back_inserter(faults), [](const auto& each) { return each != "-"; });
  config.faults = faults_from(faults, config.system.value);
  return config;
}

/// A fault that was typed, for the vehicles that it names.
void inject(std::string_view line, const Fleet& fleet, spdlog::logger& log) {
  for (const auto& each : fleet.vehicles()) {
    auto fault = line;
    if (!take_target(fault, each->system().value)) continue;
    const auto result = each->inject(fault);
    if (!result) return log.warn("no such fault: {}", result.error());
    log.info("vehicle {}: {}", each->system().value, fault);
  }
}

void run(const Options& options) {
  if (options.system + options.vehicles > 256)
    throw UsageError{
        fmt::format("--vehicles {}: system ids end at 255, and the first is {}", options.vehicles, options.system)};
  if (options.endpoints.size() > 1 && options.endpoints.size() != options.vehicles)
    throw UsageError{fmt::format("--endpoint: expected one, or one for each of the {} vehicles; there are {}",
                                 options.vehicles, options.endpoints.size())};
  transport::Loop loop;
  const auto log = make_log(options.log);
  const auto policy = link_policy_from(options.mavlink);
  const auto kept = kept_signer_from(loop, options.mavlink, log);
  Fleet fleet;
  for (unsigned n = 0; n < options.vehicles; ++n)
    fleet.add(
        std::make_unique<LiveVehicle>(loop, config_of(options, n), options.speedup,
                                      VehicleSecurity{policy, kept ? &kept->signer() : nullptr, options.is_local}));

  const auto open = [&](const std::string& endpoint, transport::LinkHandler& handler) {
    auto link = options.pty.empty() ? transport::open_link(loop, endpoint_from("--endpoint", endpoint), handler)
                                    : transport::open_pty(loop, options.pty, handler);
    if (!link) throw Failure{transport::to_text(link.error())};
    return std::shared_ptr{std::move(*link)};
  };
  if (options.endpoints.size() == 1)
    fleet.attach(open(options.endpoints.front(), fleet));
  else
    for (std::size_t n = 0; n < fleet.vehicles().size(); ++n)
      fleet.vehicles()[n]->attach(open(options.endpoints[n], *fleet.vehicles()[n]));

  log->info("{} with {}, system {}, speaks MAVLink {} on {}",
            options.vehicles > 1                       ? fmt::format("each of {} vehicles", options.vehicles)
            : options.type == sim::AirframeType::plane ? "a plane"
                                                       : "a copter",
            options.personality == sim::Personality::px4 ? "PX4" : "ArduPilot",
            options.vehicles > 1 ? fmt::format("{} to {}", options.system, options.system + options.vehicles - 1)
                                 : std::to_string(options.system),
            options.mavlink.version,
            options.pty.empty() ? fmt::format("{}", fmt::join(options.endpoints, " ")) : options.pty);
  for (const auto& each : fleet.vehicles())
    if (options.arm_after_s)
      each->arm_after(std::chrono::duration_cast<Duration>(std::chrono::duration<double>{*options.arm_after_s}));
  std::optional<transport::LineReader> lines;
  if (std::ranges::find(options.faults, "-") != options.faults.end())
    lines.emplace(
        loop, open_standard_input("--fault -"),
        [&](std::string_view line) {
          if (!line.empty()) inject(line, fleet, *log);
        },
        [&](std::string_view reason) { log->info("no more faults from standard input: {}", reason); });
  loop.on_signal([&](int) { loop.stop(); });
  loop.run();
  mavlink::Refusals refused{};
  for (const auto& each : fleet.vehicles())
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += each->refused()[i];
  log->info("the simulation ends{}", refusals_in(refused));
}

}  // namespace

void add_sim(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("sim", "Simulated vehicles that speak MAVLink as ArduPilot or PX4 does");
  auto* endpoint = command
                       ->add_option("--endpoint", options->endpoints,
                                    "Where it speaks; of many vehicles all, or each, if there are as many endpoints")
                       ->capture_default_str();
  command->add_option("--pty", options->pty, "Make a serial port of this name instead, e.g. /tmp/ttyVehicle")
      ->excludes(endpoint);
  add_mavlink_options(*command, options->mavlink, "Version on the wire");
  const std::map<std::string, sim::Personality> personalities{{"ardupilot", sim::Personality::ardupilot},
                                                              {"px4", sim::Personality::px4}};
  command->add_option("--autopilot", options->personality, "Whose ways it has: ardupilot (default) or px4")
      ->transform(CLI::CheckedTransformer(personalities))
      ->option_text("NAME");
  const std::map<std::string, sim::AirframeType> types{{"copter", sim::AirframeType::copter},
                                                       {"plane", sim::AirframeType::plane}};
  command->add_option("--type", options->type, "What it is: copter (default) or plane")
      ->transform(CLI::CheckedTransformer(types))
      ->option_text("NAME");
  command
      ->add_option("--vehicles", options->vehicles,
                   "How many; each has the next system id and stands 20 m further east")
      ->check(CLI::Range(1U, 255U))
      ->capture_default_str();
  command
      ->add_option("--wind", options->wind,
                   "Metres per second, the degrees where it comes from, and gusts as a share of it, e.g. 6,270,0.2")
      ->option_text("SPEED,FROM[,GUSTS]");
  command
      ->add_option("--fault", options->faults,
                   "What goes wrong (battery-low, battery-critical, gps-loss, link-loss, motor, reboot), when and for "
                   "how long, e.g. battery-low@60s,gps-loss@90s+20s; SYSTEM: before it names one vehicle; may be "
                   "repeated. With -, lines of standard input do so while it runs: gps-loss+20s")
      ->option_text("[SYSTEM:]FAULT@TIME[+DURATION]");
  command
      ->add_option("--param", options->parameters, "A parameter to begin with, e.g. FS_GCS_ENABLE=1; may be repeated")
      ->option_text("NAME=VALUE");
  command
      ->add_option("--mission-items", options->mission_items,
                   "The most items of a mission, instead of as many as the real autopilot takes")
      ->check(CLI::Range(std::size_t{1}, std::size_t{4000}));
  command
      ->add_option("--baud", options->baud,
                   "Bits per second of the line that the vehicle takes it for: parameter lists take a third of it")
      ->check(CLI::Range(std::size_t{1200}, std::size_t{4'000'000}));
  command->add_flag("--radio", options->radio,
                    "A telemetry radio (SiK) is on the line, and reports what it hears (RADIO_STATUS)");
  command->add_flag("--local", options->is_local,
                    "Nobody else can listen on the link: the vehicle takes its signing key from there (SETUP_SIGNING)");
  command->add_option("--system", options->system, "System id")->check(CLI::Range(1U, 255U))->capture_default_str();
  command->add_option("--home", options->home, "LAT,LON,ALT in degrees and metres above sea level");
  command->add_option("--speedup", options->speedup, "Times as fast as real time")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of chance: noise and gusts")->capture_default_str();
  command->add_option("--arm-after", options->arm_after_s,
                      "Arm it by command after so many seconds; it then climbs and flies squares");
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte sim --endpoint udpout://127.0.0.1:14550 --arm-after 10");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
