#include "vehicle/vehicle.hpp"

#include "vehicle/actions.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace ponte::app {

void add_vehicle(CLI::App& app) {
  struct Options {
    OperatorOptions station;
    Action action;
  };
  auto options = std::make_shared<Options>();
  auto& station = options->station;
  station.log.level = "warn";
  auto* command = app.add_subcommand("vehicle", "Leads one vehicle, an action at a time");
  command->add_option("ENDPOINT", station.endpoint, "Where the vehicle is, e.g. serial:///dev/ttyACM0:57600")
      ->required();
  command->add_option("--system", station.system, "System id of the vehicle, instead of the first that is heard")
      ->check(CLI::Range(1U, 255U));
  command
      ->add_option("--own-system", station.own_system,
                   "Our system id. ArduPilot looks after 255 (MAV_GCS_SYSID): it would miss us when we have gone")
      ->check(CLI::Range(1U, 255U))
      ->capture_default_str();
  command
      ->add_option("--patience", station.patience_s,
                   "Seconds for the vehicle to be heard, and to tell what has to be known of it")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command->add_flag("--json", station.json, "What becomes of it, as lines of JSON");
  add_mavlink_options(*command, station.mavlink, "Version on the wire until the vehicle has shown its own");
  add_log_options(*command, station.log);
  add_status_action(*command, options->action);
  add_flight_actions(*command, options->action);
  add_guided_actions(*command, options->action);
  add_gimbal_actions(*command, options->action);
  add_mission_actions(*command, options->action);
  add_parameter_actions(*command, options->action);
  add_file_actions(*command, options->action);
  add_command_action(*command, options->action);
  command->require_subcommand(1);
  command->footer("Example:\n  ponte vehicle udpin://127.0.0.1:14550 takeoff 20");
  command->callback([options] {
    Operator own{options->station};
    options->action(own);
  });
}

}  // namespace ponte::app
