#include "vsm/link_log.hpp"

#include "ponte/transport/serial_ports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <variant>
#include <vector>

namespace ponte::app {
namespace {

std::string ports_here() {
  std::vector<std::string> devices;
  for (const auto& port : transport::serial_ports()) devices.push_back(port.device);
  return devices.empty() ? "no serial ports here" : fmt::format("ports here: {}", fmt::join(devices, ", "));
}

}  // namespace

void log_state(spdlog::logger& log, const transport::Endpoint& endpoint, transport::LinkState state,
               std::string_view reason) {
  const auto name = transport::to_text(endpoint);
  if (state != transport::LinkState::down)
    log.info("{} is {}", name, transport::name_of(state));
  else if (std::holds_alternative<transport::SerialEndpoint>(endpoint))
    log.warn("{} is down: {}; {}", name, reason, ports_here());
  else
    log.warn("{} is down: {}", name, reason);
}

std::string drops_in(const transport::LinkCounters& counters) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < transport::drop_reason_count; ++i)
    if (counters.dropped[i] > 0)
      parts.push_back(fmt::format("{} {}", counters.dropped[i], name_of(static_cast<transport::DropReason>(i))));
  return parts.empty() ? std::string{} : fmt::format("; dropped: {}", fmt::join(parts, ", "));
}

}  // namespace ponte::app
