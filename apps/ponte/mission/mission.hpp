#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte mission`: what is done with missions and points of interest, each a subcommand of it.
void add_mission(CLI::App& app);

}  // namespace ponte::app
