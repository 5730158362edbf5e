#pragma once

#include <spdlog/spdlog.h>

#include <memory>
#include <string>

namespace ponte::app {

using Log = std::shared_ptr<spdlog::logger>;

inline constexpr const char* log_levels[] = {"trace", "debug", "info", "warn", "error", "off"};

/// Lines on stderr, one per change of state. `level`: one of `log_levels`.
[[nodiscard]] Log make_log(const std::string& level);

}  // namespace ponte::app
