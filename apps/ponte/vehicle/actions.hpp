#pragma once

#include "vehicle/operator.hpp"

#include <CLI/App.hpp>

#include <functional>

namespace ponte::app {

/// What the command line wants done, once the vehicle is heard. Throws `Failure`.
using Action = std::function<void(Operator& station)>;

// Each adds the subcommands of its subject; one that is chosen puts into `chosen` what is to be done.

void add_status_action(CLI::App& command, Action& chosen);
void add_flight_actions(CLI::App& command, Action& chosen);
void add_guided_actions(CLI::App& command, Action& chosen);
void add_gimbal_actions(CLI::App& command, Action& chosen);
void add_command_action(CLI::App& command, Action& chosen);

/// A subcommand that takes no values.
void add_simple_action(CLI::App& command, Action& chosen, const char* name, const char* description, const Action& act);

}  // namespace ponte::app
