#pragma once

#include <spdlog/spdlog.h>
#include <CLI/App.hpp>

#include <memory>
#include <string>

namespace ponte::app {

using Log = std::shared_ptr<spdlog::logger>;

/// What a command line says of the lines on stderr.
struct LogOptions {
  std::string level{"info"};
  bool quiet{};
};

void add_log_options(CLI::App& command, LogOptions& options);

/// Lines on stderr, one per change of state; with `quiet` only errors.
[[nodiscard]] Log make_log(const LogOptions& options);

}  // namespace ponte::app
