#pragma once

#include "ponte/transport/link.hpp"

#include <memory>

namespace ponte::transport {

[[nodiscard]] std::unique_ptr<Link> make_tcp_out_link(Loop& loop, const TcpOutEndpoint& endpoint, LinkHandler& handler,
                                                      const LinkOptions& options);

[[nodiscard]] Result<std::unique_ptr<Link>, OpenError> open_tcp_in_link(Loop& loop, const TcpInEndpoint& endpoint,
                                                                        LinkHandler& handler,
                                                                        const LinkOptions& options);

}  // namespace ponte::transport
