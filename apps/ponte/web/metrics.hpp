#pragma once

#include "ponte/vsm/view/bridge_view.hpp"

#include <string>

namespace ponte::app {

/// What the server has served.
struct ServerCounters {
  std::size_t connections{};      ///< at present
  std::size_t stream_clients{};   ///< at present
  std::uint64_t requests{};
  std::uint64_t streams_opened{};
  std::uint64_t telemetry_dropped{};  ///< for slow clients, see `ClientFeed::dropped`
};

/// The counters of the bridge and of its server in Prometheus' text format 0.0.4.
[[nodiscard]] std::string metrics_text(const vsm::view::BridgeView& view, const ServerCounters& server);

}  // namespace ponte::app
