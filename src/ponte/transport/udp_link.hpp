#pragma once

#include "ponte/transport/link.hpp"

#include <memory>

namespace ponte::transport {

[[nodiscard]] Result<std::unique_ptr<Link>, OpenError> open_udp_in_link(Loop& loop, const UdpInEndpoint& endpoint,
                                                                        LinkHandler& handler,
                                                                        const LinkOptions& options);

/// A place given as an address can be sent to at once, before the loop runs.
[[nodiscard]] std::unique_ptr<Link> make_udp_out_link(Loop& loop, const UdpOutEndpoint& endpoint, LinkHandler& handler,
                                                      const LinkOptions& options);

[[nodiscard]] Result<std::unique_ptr<Link>, OpenError> open_multicast_link(Loop& loop,
                                                                           const MulticastEndpoint& endpoint,
                                                                           LinkHandler& handler,
                                                                           const LinkOptions& options);

}  // namespace ponte::transport
