#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte inspect`: what is on this wire?
void add_inspect(CLI::App& app);

}  // namespace ponte::app
