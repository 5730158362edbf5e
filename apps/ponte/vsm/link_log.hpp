#pragma once

#include "common/log.hpp"
#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/link.hpp"

#include <string>

namespace ponte::app {

/// A change of a link's state: one line, which for a serial port that is not there names the ports that are.
void log_state(spdlog::logger& log, const transport::Endpoint& endpoint, transport::LinkState state,
               std::string_view reason);

/// "; dropped: 3 queue full, 1 unreachable", or nothing.
[[nodiscard]] std::string drops_in(const transport::LinkCounters& counters);

}  // namespace ponte::app
