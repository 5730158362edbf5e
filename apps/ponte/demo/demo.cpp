#include "demo/demo.hpp"

#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/local_station.hpp"
#include "common/log.hpp"
#include "common/terminal.hpp"
#include "common/vsm_options.hpp"
#include "demo/screen.hpp"
#include "demo/two_sides.hpp"
#include "sim/live_vehicle.hpp"
#include "vsm/live_vsm.hpp"
#include "web/bridge_server.hpp"
#include "web/http_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>

namespace ponte::app {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_period = 100ms;
constexpr auto arm_after = 10s;
constexpr double headless_s = 20;
constexpr const char* usual_page = "127.0.0.1:8586";
constexpr const char* any_page = "127.0.0.1:0";

struct Options {
  std::string vehicle;
  std::vector<std::string> dli;
  bool headless{};
  std::optional<double> seconds;
  bool no_browser{};
  HttpOptions http;
  VsmOptions vsm;
  LogOptions log;
};

/// A simulated copter that waits for the VSM on a port of its own.
class DemoVehicle {
 public:
  explicit DemoVehicle(transport::Loop& loop) : vehicle_{loop, {.power_on = transport::Loop::wall()}, 1} {
    auto opened = transport::open_link(loop, transport::UdpInEndpoint{{"127.0.0.1", 0}}, vehicle_);
    if (!opened) throw Failure{transport::to_text(opened.error())};
    place_ = transport::UdpOutEndpoint{{"127.0.0.1", (*opened)->local_port()}};
    vehicle_.attach(std::move(*opened));
    vehicle_.arm_after(arm_after);
  }
  [[nodiscard]] const transport::Endpoint& place() const { return place_; }

 private:
  LiveVehicle vehicle_;
  transport::Endpoint place_;
};

/// The window, drawn anew ten times a second, and its keys.
class Window {
 public:
  Window(transport::Loop& loop, LiveVsm& vsm, const TwoSides& sides, std::string vehicle, std::string page)
      : loop_{loop},
        vsm_{vsm},
        sides_{sides},
        vehicle_{std::move(vehicle)},
        page_{std::move(page)},
        timer_{loop, [this](Timestamp now) {
                 turn();
                 timer_.set(now + redraw_period);
               }} {
    timer_.set(loop.now());
  }

 private:
  void turn() {
    while (const auto key = terminal_.key()) {
      if (*key == 'c') vsm_.convert(!vsm_.converts());
      if (*key == 'q') loop_.stop();
    }
    terminal_.draw(demo_screen(sides_, {vehicle_, page_, vsm_.converts()}));
  }

  transport::Loop& loop_;
  LiveVsm& vsm_;
  const TwoSides& sides_;
  std::string vehicle_;
  std::string page_;
  Terminal terminal_;
  transport::Timer timer_;
};

/// Why the two sides do not prove the bridge; empty when they do.
std::string_view objection(const DemoCounts& counts) {
  if (counts.frames == 0) return "no MAVLink frame was received";
  if (counts.attitudes == 0) return "the vehicle has sent no ATTITUDE";
  if (counts.messages == 0) return "the station has heard nothing";
  if (counts.compared == 0) return "the station has heard no attitude";
  if (counts.different > 0) return "the two sides differ";
  return {};
}

/// The bridge page, on its usual port unless somebody has taken it or another address is wanted.
std::unique_ptr<BridgeServer> serve(transport::Loop& loop, LiveVsm& vsm, const Options& options, const Log& log) {
  auto http = options.http;
  if (!http.address.empty()) return std::make_unique<BridgeServer>(loop, vsm, *bridge_server_options_from(http), log);
  http.address = usual_page;
  try {
    return std::make_unique<BridgeServer>(loop, vsm, *bridge_server_options_from(http), log);
  } catch (const Failure&) {
    http.address = any_page;
    return std::make_unique<BridgeServer>(loop, vsm, *bridge_server_options_from(http), log);
  }
}

/// Shows the page in the desktop's browser, if there is a desktop.
void open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  const char* const command[] = {"xdg-open", url.c_str(), nullptr};
  pid_t child{};
  posix_spawn_file_actions_t silence;
  posix_spawn_file_actions_init(&silence);
  posix_spawn_file_actions_addopen(&silence, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&silence, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  (void)posix_spawnp(&child, command[0], &silence, nullptr, const_cast<char* const*>(command), environ);
  posix_spawn_file_actions_destroy(&silence);
}

void run(const Options& options) {
  if (!options.headless && !Terminal::is_there())
    throw Failure{"ponte demo: this is no terminal; --headless runs without one"};
  vsm::BridgeConfig config;
  config.telemetry = telemetry_config_from(options.vsm);
  config.rates = vsm::TelemetryRates{};
  TwoSides sides{config.telemetry.profile};

  transport::Loop loop;
  auto log_options = options.log;
  if (!options.headless) log_options.quiet = true;  // lines of a log would tear the window
  const auto log = make_log(log_options);
  LiveVsm vsm{loop, config, log};
  vsm.observe_crossings([&](const Crossing& crossing) { sides.on_crossing(crossing); });
  const LocalStation station{loop, [&](Bytes datagram) { sides.on_datagram(datagram); }};
  vsm.add_dli(station.place());
  for (const auto& text : options.dli) vsm.add_dli(endpoint_from("--dli", text));
  std::optional<DemoVehicle> simulated;
  if (options.vehicle.empty()) simulated.emplace(loop);
  const auto vehicle = simulated ? simulated->place() : endpoint_from("--vehicle", options.vehicle);
  vsm.add_vehicle(vehicle);
  const auto server = serve(loop, vsm, options, log);
  const auto page = server->url();
  log->info("the bridge page is at {}", page);
  if (!options.headless && !options.no_browser) open_browser(page);
  loop.on_signal([&](int) { loop.stop(); });

  {
    std::optional<Window> window;
    if (!options.headless) window.emplace(loop, vsm, sides, transport::to_text(vehicle), page);
    const auto seconds = options.headless ? options.seconds.value_or(headless_s) : options.seconds;
    if (seconds)
      loop.run_for(std::chrono::duration_cast<Duration>(std::chrono::duration<double>{*seconds}));
    else
      loop.run();
  }
  fmt::print("{}", demo_summary(sides.counts()));
  if (!options.headless) return;
  if (const auto reason = objection(sides.counts()); !reason.empty())
    throw Failure{fmt::format("ponte demo: {}", reason)};
  fmt::print("both sides were seen and agree within one unit of the binary angle\n");
}

}  // namespace

void add_demo(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "demo", "Both languages side by side, live, with nothing attached; in the terminal and as a page");
  command->add_option("--vehicle", options->vehicle,
                      "A vehicle instead of the simulated one, e.g. serial:///dev/ttyACM0:57600");
  command->add_option("--dli", options->dli, "Ground stations that shall hear the VSM too");
  command->add_flag("--headless", options->headless,
                    "Without a window; ends well only if both sides were seen and agree");
  command->add_option("--seconds", options->seconds, "How long; without a window 20 unless given")
      ->check(CLI::Range(0.1, 1e6));
  command->add_flag("--no-browser", options->no_browser, "Do not open the bridge page in a browser");
  add_http_options(*command, options->http);
  add_vsm_options(*command, options->vsm);
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte demo --headless --seconds 20");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
