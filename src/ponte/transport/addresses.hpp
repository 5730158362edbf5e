#pragma once

#include "ponte/core/result.hpp"
#include "ponte/transport/asio.hpp"
#include "ponte/transport/endpoint.hpp"

#include <string>
#include <vector>

namespace ponte::transport {

/// The addresses of a host that is named, or given as an address; there is at least one. IPv4 comes first: of the
/// programs that say `localhost`, most listen there. The error is one line that names the host.
[[nodiscard]] asio::awaitable<Result<std::vector<asio::ip::address>, std::string>> resolve(std::string host);

/// "ADDRESS:PORT" of a TCP or UDP endpoint of Asio; an IPv4 address that came in through an IPv6 socket looks like one.
template <class AsioEndpoint>
[[nodiscard]] std::string text_of(const AsioEndpoint& place) {
  auto address = place.address();
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
  return to_text(HostPort{address.to_string(), place.port()});
}

}  // namespace ponte::transport
