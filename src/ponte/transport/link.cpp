#include "ponte/transport/link.hpp"

#include "ponte/transport/device_link.hpp"
#include "ponte/transport/serial_port.hpp"
#include "ponte/transport/tcp_link.hpp"
#include "ponte/transport/udp_link.hpp"

#include <utility>
#include <variant>

namespace ponte::transport {
namespace {

using Opened = Result<std::unique_ptr<Link>, OpenError>;

struct Opener {
  Loop& loop;
  LinkHandler& handler;
  const LinkOptions& options;

  Opened operator()(const SerialEndpoint& endpoint) const {
    const auto name = to_text(Endpoint{endpoint});
    Device device{name, endpoint.device, [endpoint] { return open_serial_port(endpoint.device, endpoint.baud); },
                  endpoint.device + " was unplugged"};
    if (options.reconnect) return make_device_link(loop, std::move(device), handler, options);

    // The one attempt is made here, and the link begins with what came of it.
    auto port = device.open();
    if (!port) return fail(OpenError{name, port.error()});
    device.open = [port = std::make_shared<FileDescriptor>(*std::move(port))] { return std::move(*port); };
    return make_device_link(loop, std::move(device), handler, options);
  }

  Opened operator()(const UdpInEndpoint& endpoint) const { return open_udp_in_link(loop, endpoint, handler, options); }
  Opened operator()(const UdpOutEndpoint& endpoint) const {
    return make_udp_out_link(loop, endpoint, handler, options);
  }
  Opened operator()(const TcpInEndpoint& endpoint) const { return open_tcp_in_link(loop, endpoint, handler, options); }
  Opened operator()(const TcpOutEndpoint& endpoint) const {
    return make_tcp_out_link(loop, endpoint, handler, options);
  }
  Opened operator()(const MulticastEndpoint& endpoint) const {
    return open_multicast_link(loop, endpoint, handler, options);
  }
  Opened operator()(const FileEndpoint& endpoint) const {
    return fail(OpenError{to_text(Endpoint{endpoint}), "a recording can be replayed, not talked with"});
  }
};

}  // namespace

std::string_view name_of(LinkState state) {
  switch (state) {
    case LinkState::connecting: return "connecting";
    case LinkState::up: return "up";
    case LinkState::down: return "down";
  }
  return {};
}

std::string_view name_of(DropReason reason) {
  switch (reason) {
    case DropReason::queue_full: return "queue_full";
    case DropReason::not_connected: return "not_connected";
    case DropReason::disconnected: return "disconnected";
    case DropReason::oversize: return "oversize";
    case DropReason::unreachable: return "unreachable";
    case DropReason::too_many_peers: return "too_many_peers";
    case DropReason::receive_overflow: return "receive_overflow";
  }
  return {};
}

std::string to_text(const OpenError& error) { return error.endpoint + ": " + error.reason; }

Result<std::unique_ptr<Link>, OpenError> open_link(Loop& loop, const Endpoint& endpoint, LinkHandler& handler,
                                                   const LinkOptions& options) {
  return std::visit(Opener{loop, handler, options}, endpoint);
}

}  // namespace ponte::transport
