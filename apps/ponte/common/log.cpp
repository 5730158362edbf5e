#include "common/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>

namespace ponte::app {

Log make_log(const std::string& level) {
  auto log = std::make_shared<spdlog::logger>("ponte", std::make_shared<spdlog::sinks::stderr_color_sink_st>());
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e %^%l%$ %v");
  log->set_level(spdlog::level::from_str(level));
  return log;
}

}  // namespace ponte::app
