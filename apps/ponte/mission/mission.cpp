#include "mission/mission.hpp"

#include "mission/convert.hpp"
#include "mission/plan.hpp"

#include <CLI/CLI.hpp>

namespace ponte::app {

void add_mission(CLI::App& app) {
  auto* command = app.add_subcommand("mission", "Missions and points of interest");
  command->require_subcommand(1);
  add_mission_convert(*command);
  add_mission_plan(*command);
}

}  // namespace ponte::app
