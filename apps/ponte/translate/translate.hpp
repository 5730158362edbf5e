#pragma once

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte translate`: a recording of MAVLink in, DLI messages out.
void add_translate(CLI::App& app);

}  // namespace ponte::app
