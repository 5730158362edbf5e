#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte ports`: serial ports that look like autopilots.
void add_ports(CLI::App& app);

}  // namespace ponte::app
