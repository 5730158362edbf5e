#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte mission plan`: points of interest in, one mission for each vehicle out.
void add_mission_plan(CLI::App& mission);

}  // namespace ponte::app
