#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte vsm`: the Vehicle Specific Module.
void add_vsm(CLI::App& app);

}  // namespace ponte::app
