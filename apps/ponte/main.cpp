#include "common/failure.hpp"
#include "demo/demo.hpp"
#include "inspect/inspect.hpp"
#include "latency/latency.hpp"
#include "mission/mission.hpp"
#include "ports/ports.hpp"
#include "route/route.hpp"
#include "sim/sim.hpp"
#include "translate/translate.hpp"
#include "vehicle/vehicle.hpp"
#include "vsm/vsm.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>

namespace {

constexpr int done = 0;
constexpr int job_failed = 1;
constexpr int bad_usage = 2;

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Lets MAVLink vehicles and STANAG 4586 ground stations work together", "ponte"};
  app.set_version_flag("--version", PONTE_VERSION);
  app.set_config("--config", "", "Read options from a TOML file, [vsm] for those of vsm");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.fallthrough();
  app.require_subcommand(1);
  ponte::app::add_demo(app);
  ponte::app::add_inspect(app);
  ponte::app::add_latency(app);
  ponte::app::add_mission(app);
  ponte::app::add_ports(app);
  ponte::app::add_route(app);
  ponte::app::add_sim(app);
  ponte::app::add_translate(app);
  ponte::app::add_vehicle(app);
  ponte::app::add_vsm(app);
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return bad_usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ConfigError& error) {
    fmt::print(stderr, "ponte: --config: {}; expected [SUBCOMMAND] sections with the names of its options\n",
               error.what());
    return bad_usage;
  } catch (const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    fmt::print(stderr, "ponte: {}\nTry: ponte {}--help\n", error.what(),
               chosen.empty() ? "" : chosen.front()->get_name() + " ");
    return bad_usage;
  } catch (const ponte::app::UsageError& error) {
    fmt::print(stderr, "ponte: {}\n", error.what());
    return bad_usage;
  } catch (const ponte::app::Failure& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return job_failed;
  }
  if (std::fflush(stdout) != 0) {
    fmt::print(stderr, "ponte: stdout cannot be written\n");
    return job_failed;
  }
  return done;
}
