#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/transport/link.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <stdexcept>

/// Both ends of what is measured over loopback UDP, and the peer that it is measured beside.
namespace ponte::bench {

/// A blocking UDP socket on loopback.
class Socket {
 public:
  Socket() : number_{socket(AF_INET, SOCK_DGRAM, 0)} {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    const timeval patience{.tv_sec = 10, .tv_usec = 0};
    if (number_ < 0 || bind(number_, reinterpret_cast<const sockaddr*>(&place), size) != 0 ||
        getsockname(number_, reinterpret_cast<sockaddr*>(&place), &size) != 0 ||
        setsockopt(number_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0)
      throw std::runtime_error{"no UDP socket on loopback"};
    port_ = ntohs(place.sin_port);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { close(number_); }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int number() const { return number_; }
  void send(Bytes bytes, std::uint16_t port) const {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port = htons(port);
    sendto(number_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&place), sizeof place);
  }
  std::size_t receive(MutableBytes out) const {
    const auto size = recv(number_, out.data(), out.size(), 0);
    if (size < 0) throw std::runtime_error{"an answer did not come within ten seconds"};
    return static_cast<std::size_t>(size);
  }

 private:
  int number_;
  std::uint16_t port_{};
};

/// Passes datagrams on as they are.
class Relay final : public transport::LinkHandler {
 public:
  Relay(transport::Loop& loop, std::uint16_t from, std::uint16_t to) {
    in_ = *transport::open_link(loop, transport::UdpInEndpoint{{"127.0.0.1", from}}, *this);
    out_ = *transport::open_link(loop, transport::UdpOutEndpoint{{"127.0.0.1", to}}, *this);
  }
  void on_bytes(Timestamp, Bytes bytes, transport::PeerId) override { out_->send(bytes); }
  void on_datagram(Timestamp, Bytes bytes, transport::PeerId) override { out_->send(bytes); }
  void on_state(Timestamp, transport::LinkState, std::string_view) override {}

 private:
  std::unique_ptr<transport::Link> in_;
  std::unique_ptr<transport::Link> out_;
};

/// Ports that nobody uses.
template <std::size_t Count>
std::array<std::uint16_t, Count> free_ports() {
  const std::array<Socket, Count> sockets;
  std::array<std::uint16_t, Count> ports{};
  for (std::size_t i = 0; i < Count; ++i) ports[i] = sockets[i].port();
  return ports;
}

}  // namespace ponte::bench
