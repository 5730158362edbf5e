#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte vehicle`: leads one vehicle from the command line, an action at a time.
void add_vehicle(CLI::App& app);

}  // namespace ponte::app
