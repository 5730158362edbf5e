#include "common/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <CLI/CLI.hpp>

namespace ponte::app {

void add_log_options(CLI::App& command, LogOptions& options) {
  auto* level = command.add_option("--log-level", options.level, "Lines on stderr")
                    ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
                    ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "Nothing on stderr but errors")->excludes(level);
}

Log make_log(const LogOptions& options) {
  auto log = std::make_shared<spdlog::logger>("ponte", std::make_shared<spdlog::sinks::stderr_color_sink_st>());
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e %^%l%$ %v");
  log->set_level(options.quiet ? spdlog::level::err : spdlog::level::from_str(options.level));
  return log;
}

}  // namespace ponte::app
