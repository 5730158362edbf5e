#include "ponte/transport/multicast.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <system_error>

namespace ponte::transport {
namespace {

template <class T>
bool set(int socket, int level, int option, const T& value) {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

/// Zero for an IPv4 group.
in6_addr ipv6_of(const MulticastEndpoint& endpoint) {
  in6_addr group{};
  ::inet_pton(AF_INET6, endpoint.group.host.c_str(), &group);
  return group;
}

bool join_ipv4(int socket, in_addr group, unsigned interface, const MulticastEndpoint& endpoint) {
  const ip_mreqn membership{.imr_multiaddr = group, .imr_address = {}, .imr_ifindex = static_cast<int>(interface)};
  // Not what others on this machine have joined on other interfaces.
  return set(socket, IPPROTO_IP, IP_MULTICAST_ALL, 0) && set(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership) &&
         (interface == 0 || set(socket, IPPROTO_IP, IP_MULTICAST_IF, membership)) &&
         set(socket, IPPROTO_IP, IP_MULTICAST_TTL, int{endpoint.ttl}) &&
         set(socket, IPPROTO_IP, IP_MULTICAST_LOOP, int{endpoint.loopback});
}

bool join_ipv6(int socket, const in6_addr& group, unsigned interface, const MulticastEndpoint& endpoint) {
  const ipv6_mreq membership{.ipv6mr_multiaddr = group, .ipv6mr_interface = interface};
  return set(socket, IPPROTO_IPV6, IPV6_MULTICAST_ALL, 0) &&
         set(socket, IPPROTO_IPV6, IPV6_ADD_MEMBERSHIP, membership) &&
         (interface == 0 || set(socket, IPPROTO_IPV6, IPV6_MULTICAST_IF, static_cast<int>(interface))) &&
         set(socket, IPPROTO_IPV6, IPV6_MULTICAST_HOPS, int{endpoint.ttl}) &&
         set(socket, IPPROTO_IPV6, IPV6_MULTICAST_LOOP, int{endpoint.loopback});
}

bool join(int socket, unsigned interface, const MulticastEndpoint& endpoint) {
  // Several programs on one machine may be members.
  if (!set(socket, SOL_SOCKET, SO_REUSEADDR, 1)) return false;
  in_addr ipv4{};
  if (::inet_pton(AF_INET, endpoint.group.host.c_str(), &ipv4) == 1)
    return join_ipv4(socket, ipv4, interface, endpoint);
  return join_ipv6(socket, ipv6_of(endpoint), interface, endpoint);
}

/// Such a group is another one on each interface.
bool needs_interface(const MulticastEndpoint& endpoint) {
  const auto group = ipv6_of(endpoint);
  return IN6_IS_ADDR_MC_LINKLOCAL(&group) || IN6_IS_ADDR_MC_NODELOCAL(&group);
}

}  // namespace

unsigned interface_index(const MulticastEndpoint& endpoint) {
  return endpoint.interface.empty() ? 0 : ::if_nametoindex(endpoint.interface.c_str());
}

Result<void, std::string> join_group(int socket, const MulticastEndpoint& endpoint) {
  const auto interface = interface_index(endpoint);
  if (interface == 0 && !endpoint.interface.empty())
    return fail(fmt::format("there is no network interface {}", endpoint.interface));
  if (interface == 0 && needs_interface(endpoint))
    return fail(
        fmt::format("{} is on every link another group; name the interface, ?interface=NAME", endpoint.group.host));
  if (join(socket, interface, endpoint)) return {};
  const auto reason = std::system_category().message(errno);
  if (interface == 0 && errno == ENODEV)
    return fail(
        fmt::format("no route to {}; name the interface, ?interface=lo for this machine alone", endpoint.group.host));
  return fail(fmt::format("cannot join {}: {}", endpoint.group.host, reason));
}

}  // namespace ponte::transport
