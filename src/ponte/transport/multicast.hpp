#pragma once

#include "ponte/core/result.hpp"
#include "ponte/transport/endpoint.hpp"

#include <string>

namespace ponte::transport {

/// Makes an open UDP socket of the group's family a member of the group, as the endpoint says, and sends what it sends
/// to groups accordingly. Must come before the socket is bound. The error is one line.
[[nodiscard]] Result<void, std::string> join_group(int socket, const MulticastEndpoint& endpoint);

/// The number of the interface that the endpoint names; 0 when it names none, or there is none of that name.
[[nodiscard]] unsigned interface_index(const MulticastEndpoint& endpoint);

}  // namespace ponte::transport
