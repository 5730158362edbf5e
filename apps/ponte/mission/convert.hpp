#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte mission convert`: from any format of missions or points to any other.
void add_mission_convert(CLI::App& mission);

}  // namespace ponte::app
