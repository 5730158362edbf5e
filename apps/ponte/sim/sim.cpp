#include "sim/sim.hpp"

#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/kept_signer.hpp"
#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "ponte/transport/pty.hpp"
#include "sim/live_vehicle.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <map>
#include <memory>
#include <optional>

namespace ponte::app {
namespace {

struct Options {
  std::string endpoint{"udpout://127.0.0.1:14550"};
  std::string pty;
  MavlinkOptions mavlink;
  bool is_local{};
  sim::Personality personality{sim::Personality::ardupilot};
  std::vector<std::string> parameters;
  std::size_t mission_items{};
  unsigned system{1};
  std::string home;
  double speedup{1};
  std::uint64_t seed{1};
  std::optional<double> arm_after_s;
  LogOptions log;
};

/// "LAT,LON,ALT" in degrees and metres above sea level.
sim::Position position_from(const std::string& text) {
  std::array<double, 3> numbers{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    const bool last = i + 1 == numbers.size();
    if (error != std::errc{} || (last ? next != end : next == end || *next != ','))
      throw UsageError{fmt::format("--home {}: expected LAT,LON,ALT in degrees and metres", text)};
    at = last ? next : next + 1;
  }
  const auto [latitude, longitude, altitude] = numbers;
  if (!(std::abs(latitude) <= 85 && std::abs(longitude) <= 180 && std::abs(altitude) <= 10'000))
    throw UsageError{
        fmt::format("--home {}: expected a latitude of at most 85, a longitude of at most 180 and an "
                    "altitude of at most 10000",
                    text)};
  return {radians_from_degrees(latitude), radians_from_degrees(longitude), Metres{altitude}};
}

/// "NAME=VALUE" of a parameter that this autopilot has.
sim::ParameterSetting setting_from(const std::string& text, const sim::VehicleConfig& config) {
  const auto equals = text.find('=');
  const auto name = text.substr(0, equals);
  sim::ParameterSetting setting{.name = name};
  const char* const end = text.data() + text.size();
  const char* const at = equals == std::string::npos ? end : text.data() + equals + 1;
  const auto [after, error] = std::from_chars(at, end, setting.value);
  if (error != std::errc{} || after != end || !std::isfinite(setting.value))
    throw UsageError{fmt::format("--param {}: expected NAME=NUMBER", text)};
  if (!sim::Parameters{config.personality, config.type}.find(name))
    throw UsageError{fmt::format("--param {}: this autopilot has no parameter {}", text, name)};
  return setting;
}

void run(const Options& options) {
  sim::VehicleConfig config;
  config.personality = options.personality;
  if (options.mission_items != 0) config.mission_items = options.mission_items;
  for (const auto& each : options.parameters) config.parameters.push_back(setting_from(each, config));
  config.fly_square = options.arm_after_s.has_value();
  config.system = mavlink::SystemId{static_cast<std::uint8_t>(options.system)};
  config.version = version_from(options.mavlink);
  config.seed = options.seed;
  config.power_on = transport::Loop::wall();
  if (!options.home.empty()) config.start = position_from(options.home);

  transport::Loop loop;
  const auto log = make_log(options.log);
  const auto policy = link_policy_from(options.mavlink);
  const auto kept = kept_signer_from(loop, options.mavlink, log);
  LiveVehicle vehicle{loop, config, options.speedup, {policy, kept ? &kept->signer() : nullptr, options.is_local}};
  auto link = options.pty.empty() ? transport::open_link(loop, endpoint_from("--endpoint", options.endpoint), vehicle)
                                  : transport::open_pty(loop, options.pty, vehicle);
  if (!link) throw Failure{transport::to_text(link.error())};
  log->info("a copter with {}, system {}, speaks MAVLink {} on {}",
            options.personality == sim::Personality::px4 ? "PX4" : "ArduPilot", options.system, options.mavlink.version,
            options.pty.empty() ? options.endpoint : options.pty);
  vehicle.attach(std::move(*link));
  if (options.arm_after_s)
    vehicle.arm_after(std::chrono::duration_cast<Duration>(std::chrono::duration<double>{*options.arm_after_s}));
  loop.on_signal([&](int) { loop.stop(); });
  loop.run();
  log->info("the vehicle ends{}", refusals_in(vehicle.refused()));
}

}  // namespace

void add_sim(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("sim", "A simulated copter that speaks MAVLink as ArduPilot or PX4 does");
  auto* endpoint = command->add_option("--endpoint", options->endpoint, "Where it speaks")->capture_default_str();
  command->add_option("--pty", options->pty, "Make a serial port of this name instead, e.g. /tmp/ttyVehicle")
      ->excludes(endpoint);
  add_mavlink_options(*command, options->mavlink, "Version on the wire");
  const std::map<std::string, sim::Personality> personalities{{"ardupilot", sim::Personality::ardupilot},
                                                              {"px4", sim::Personality::px4}};
  command->add_option("--autopilot", options->personality, "Whose ways it has: ardupilot (default) or px4")
      ->transform(CLI::CheckedTransformer(personalities))
      ->option_text("NAME");
  command
      ->add_option("--param", options->parameters, "A parameter to begin with, e.g. FS_GCS_ENABLE=1; may be repeated")
      ->option_text("NAME=VALUE");
  command
      ->add_option("--mission-items", options->mission_items,
                   "The most items of a mission, instead of as many as the real autopilot takes")
      ->check(CLI::Range(std::size_t{1}, std::size_t{4000}));
  command->add_flag("--local", options->is_local,
                    "Nobody else can listen on the link: the vehicle takes its signing key from there (SETUP_SIGNING)");
  command->add_option("--system", options->system, "System id")->check(CLI::Range(1U, 255U))->capture_default_str();
  command->add_option("--home", options->home, "LAT,LON,ALT in degrees and metres above sea level");
  command->add_option("--speedup", options->speedup, "Times as fast as real time")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the sensor noise")->capture_default_str();
  command->add_option("--arm-after", options->arm_after_s,
                      "Arm it by command after so many seconds; it then climbs and flies squares");
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte sim --endpoint udpout://127.0.0.1:14550 --arm-after 10");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
