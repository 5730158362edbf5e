#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte route`: passes MAVLink on between endpoints.
void add_route(CLI::App& app);

}  // namespace ponte::app
