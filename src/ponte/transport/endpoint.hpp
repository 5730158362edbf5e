#pragma once

#include "ponte/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

/// The outside world: endpoints, the loop and the links on it. Bytes are moved, not understood.
namespace ponte::transport {

/// A place on an IP network. The host is a numeric address (IPv6 without brackets) or, for places that we call, a name.
struct HostPort {
  std::string host;
  std::uint16_t port{};

  friend bool operator==(const HostPort&, const HostPort&) = default;
};

struct SerialEndpoint {
  std::string device;
  std::uint32_t baud = 57600;  ///< bits per second, 1 to 4,000,000

  friend bool operator==(const SerialEndpoint&, const SerialEndpoint&) = default;
};

/// Listens, and answers whoever talks. Port 0: the kernel chooses one.
struct UdpInEndpoint {
  HostPort local;

  friend bool operator==(const UdpInEndpoint&, const UdpInEndpoint&) = default;
};

struct UdpOutEndpoint {
  HostPort remote;

  friend bool operator==(const UdpOutEndpoint&, const UdpOutEndpoint&) = default;
};

/// Accepts connections. Port 0: the kernel chooses one.
struct TcpInEndpoint {
  HostPort local;

  friend bool operator==(const TcpInEndpoint&, const TcpInEndpoint&) = default;
};

struct TcpOutEndpoint {
  HostPort remote;

  friend bool operator==(const TcpOutEndpoint&, const TcpOutEndpoint&) = default;
};

struct MulticastEndpoint {
  HostPort group;            ///< port 0: the kernel chooses one
  std::string interface {};  ///< empty: the kernel chooses by its routes
  std::uint8_t ttl = 1;      ///< hops; 0 keeps datagrams on this machine
  bool loopback = true;      ///< whether programs on this machine, ourselves included, get what is sent

  friend bool operator==(const MulticastEndpoint&, const MulticastEndpoint&) = default;
};

/// A recording to replay.
struct FileEndpoint {
  std::string path;
  double speed = 1;  ///< 0.01 to 1000 times as fast as recorded; 0: as fast as possible

  friend bool operator==(const FileEndpoint&, const FileEndpoint&) = default;
};

/// A configured place.
using Endpoint = std::variant<SerialEndpoint, UdpInEndpoint, UdpOutEndpoint, TcpInEndpoint, TcpOutEndpoint,
                              MulticastEndpoint, FileEndpoint>;

/// The grammar that `parse_endpoint` follows, for people.
inline constexpr std::string_view endpoint_grammar =
    "serial:///dev/DEVICE[:BAUD]       a serial port; 57600 baud unless given\n"
    "udpin://ADDRESS:PORT              listens, and answers whoever talks\n"
    "udpout://HOST:PORT                sends to one place\n"
    "tcpin://ADDRESS:PORT              accepts connections\n"
    "tcpout://HOST:PORT                connects to one place\n"
    "udpmulticast://GROUP:PORT[?interface=NAME&ttl=N&loopback=0|1]\n"
    "file:///PATH[?speed=N]            replays a recording; speed 0: as fast as possible\n"
    "An IPv6 address stands in brackets: udpin://[::]:14550\n";

/// The part of a text that keeps it from being an endpoint.
struct EndpointError {
  std::string part;         ///< as written; empty where something is missing
  std::size_t position{};   ///< of the part's first byte, counted from 0
  std::string expectation;  ///< what should stand there, e.g. "a port from 1 to 65535"

  friend bool operator==(const EndpointError&, const EndpointError&) = default;
};

/// Reads an endpoint without looking whether the place exists. A number at the end of a serial device, behind a colon,
/// is a baud rate; other ends with a dot, as in /dev/serial/by-path, belong to the device's name.
[[nodiscard]] Result<Endpoint, EndpointError> parse_endpoint(std::string_view text);

/// The shortest text that `parse_endpoint` reads as `endpoint`; the baud rate is always there.
[[nodiscard]] std::string to_text(const Endpoint& endpoint);
/// "HOST:PORT", with brackets around IPv6.
[[nodiscard]] std::string to_text(const HostPort& place);
/// One line such as `"70000" at character 21: expected a port from 1 to 65535`; characters are counted from 1.
[[nodiscard]] std::string to_text(const EndpointError& error);

}  // namespace ponte::transport
