#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte demo`: both languages side by side, live.
void add_demo(CLI::App& app);

}  // namespace ponte::app
