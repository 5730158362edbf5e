#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte sim`: a simulated vehicle that speaks MAVLink on any endpoint.
void add_sim(CLI::App& app);

}  // namespace ponte::app
