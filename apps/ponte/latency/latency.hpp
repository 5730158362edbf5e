#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte latency`: how much later does an attitude come when it comes through the DLI?
void add_latency(CLI::App& app);

}  // namespace ponte::app
