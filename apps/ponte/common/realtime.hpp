#pragma once

#include <CLI/App.hpp>

#include <optional>

namespace ponte::app {

/// Adds `--realtime PRIORITY`.
void add_realtime_option(CLI::App& command, std::optional<int>& priority);

/// From now on the system runs this program before all others (SCHED_FIFO with that priority, 1 to 99) and keeps its
/// memory in RAM, so that neither another program nor a page fault comes between. Throws `Failure`, which says what is
/// missing, if the system does not permit it.
void enter_realtime(int priority);

}  // namespace ponte::app
