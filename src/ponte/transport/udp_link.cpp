#include "ponte/transport/udp_link.hpp"

#include "ponte/transport/addresses.hpp"
#include "ponte/transport/multicast.hpp"
#include "ponte/transport/peer_table.hpp"
#include "ponte/transport/receive_datagram.hpp"
#include "ponte/transport/shared_link.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>

namespace ponte::transport {
namespace {

using asio::ip::udp;

DropReason reason_of(int error) {
  switch (error) {
    case EAGAIN:
    case ENOBUFS:
    case ENOMEM: return DropReason::queue_full;
    case EMSGSIZE: return DropReason::oversize;
    default: return DropReason::unreachable;
  }
}

/// A flood should find room until the loop comes round. The system may grant less.
void tune(udp::socket& socket) {
  static constexpr int receive_buffer_bytes = 4 * 1024 * 1024;
  error_code ignored;
  socket.set_option(udp::socket::receive_buffer_size{receive_buffer_bytes}, ignored);
  report_overflow(socket.native_handle());
}

/// A UDP socket. The system's send buffer is the only queue: a datagram leaves at once or not at all.
class UdpLink : public SharedLink, public std::enable_shared_from_this<UdpLink> {
 public:
  UdpLink(Loop& loop, std::string name, LinkHandler& handler, const LinkOptions& options, udp::socket socket)
      : SharedLink{loop, std::move(name), handler, options}, socket_{std::move(socket)} {}

  [[nodiscard]] std::uint16_t local_port() const override {
    error_code error;
    const auto local = socket_.local_endpoint(error);
    return error ? std::uint16_t{0} : local.port();
  }

 protected:
  virtual void on_datagram(Timestamp now, Bytes bytes, const udp::endpoint& sender) = 0;

  // Waiting and receiving are two steps, so that the time is taken right behind the system call, however much else is
  // ready to run on the loop. After a burst the others get their turn.
  asio::awaitable<void> receive_until_closed() {
    static constexpr int burst = 64;
    while (!closed()) {
      error_code error;
      auto token = asio::redirect_error(asio::use_awaitable, error);
      co_await socket_.async_wait(udp::socket::wait_read, token);
      if (closed()) break;
      if (error) throw boost::system::system_error{error, std::string{name()}};
      for (auto i = 0; i < burst && !closed() && receive_one(); ++i) continue;
    }
  }

  /// To `place`, or to where the socket is connected.
  void transmit(Bytes message, const udp::endpoint* place) {
    auto size = send_now(message, place);
    if (size < 0 && errno == ECONNREFUSED) {
      // That was about an earlier datagram, which nobody there wanted. This one has not been sent.
      drop(DropReason::unreachable);
      size = send_now(message, place);
    }
    if (size < 0) return drop(reason_of(errno));
    counters_.bytes_out += message.size();
    ++counters_.messages_out;
  }

  void deliver(Timestamp now, Bytes bytes, PeerId peer) {
    counters_.bytes_in += bytes.size();
    ++counters_.datagrams_in;
    handler_.on_datagram(now, bytes, peer);
  }

  void close_all() override {
    error_code ignored;
    socket_.close(ignored);
  }

  udp::socket socket_;

 private:
  ssize_t send_now(Bytes message, const udp::endpoint* place) {
    return ::sendto(socket_.native_handle(), message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                    place == nullptr ? nullptr : place->data(),
                    place == nullptr ? 0 : static_cast<socklen_t>(place->size()));
  }

  /// Returns whether it makes sense to look for another.
  bool receive_one() {
    udp::endpoint sender;
    const auto received =
        receive_datagram(socket_.native_handle(), buffer_, sender.data(), static_cast<socklen_t>(sender.capacity()));
    const auto now = loop_.now();
    if (received.error == EAGAIN) return false;
    if (received.error != 0) {
      drop(DropReason::unreachable);  // the answer to something that we sent
      return true;
    }
    if (received.overflow)
      drop(DropReason::receive_overflow, *received.overflow - std::exchange(overflow_, *received.overflow));
    sender.resize(received.address_size);
    on_datagram(now, Bytes{buffer_}.first(received.size), sender);
    return true;
  }

  std::uint32_t overflow_{};
  std::array<std::byte, 65'536> buffer_{};
};

/// Hears whoever talks. Answers them, or talks to a group.
class UdpListener final : public UdpLink {
 public:
  UdpListener(Loop& loop, std::string name, LinkHandler& handler, const LinkOptions& options, udp::socket socket,
              std::optional<udp::endpoint> group)
      : UdpLink{loop, std::move(name), handler, options, std::move(socket)},
        group_{std::move(group)},
        peers_{options.peers, options.peer_silence} {}

  void start() override { spawn(loop_, run(std::static_pointer_cast<UdpListener>(shared_from_this()))); }

  void send(Bytes message) override {
    if (group_) return transmit(message, &*group_);
    if (peers_.all().empty()) return drop(DropReason::not_connected);
    for (const auto& peer : peers_.all()) transmit(message, &peer.address);
  }

  void send_to(PeerId id, Bytes message) override {
    if (group_) return transmit(message, &*group_);
    const auto* const peer = peers_.find(id);
    if (peer == nullptr) return drop(DropReason::not_connected);
    transmit(message, &peer->address);
  }

  [[nodiscard]] std::string peer_name(PeerId id) const override {
    const auto* const peer = peers_.find(id);
    return peer == nullptr ? std::string{} : text_of(peer->address);
  }

 private:
  static asio::awaitable<void> run(std::shared_ptr<UdpListener> self) {
    if (self->closed()) co_return;
    self->tell_state(LinkState::up, "listening on " + text_of(self->socket_.local_endpoint()));
    co_await self->receive_until_closed();
  }

  void on_datagram(Timestamp now, Bytes bytes, const udp::endpoint& sender) override {
    const auto* peer = peers_.hear(now, sender);
    if (peer == nullptr) {
      if (peers_.full()) return drop(DropReason::too_many_peers);
      peer = &peers_.add(now, next_peer_id(), sender);
      silence_.set(peers_.next_deadline());
      tell_peer(peer->id, PeerChange::joined, text_of(sender));
      if (closed()) return;
    }
    deliver(now, bytes, peer->id);
  }

  void forget_the_silent(Timestamp now) {
    for (const auto& peer : peers_.take_silent(now)) {
      tell_peer(peer.id, PeerChange::left, text_of(peer.address));
      if (closed()) return;
    }
    silence_.set(peers_.next_deadline());
  }

  void close_all() override {
    silence_.clear();
    UdpLink::close_all();
  }

  std::optional<udp::endpoint> group_;
  PeerTable<udp::endpoint> peers_;
  Timer silence_{loop_, [this](Timestamp now) { forget_the_silent(now); }};
};

/// Talks with one place alone: the socket is connected, so the system keeps all others out.
class UdpOutLink final : public UdpLink {
 public:
  UdpOutLink(Loop& loop, const UdpOutEndpoint& endpoint, LinkHandler& handler, const LinkOptions& options)
      : UdpLink{loop, to_text(Endpoint{endpoint}), handler, options, udp::socket{loop.context()}},
        remote_{endpoint.remote},
        pause_{loop.context()} {}

  void start() override {
    error_code error;
    const auto address = asio::ip::make_address(remote_.host, error);
    if (!error) is_connected_ = !connect({address, remote_.port});
    spawn(loop_, run(std::static_pointer_cast<UdpOutLink>(shared_from_this())));
  }

  void send(Bytes message) override {
    if (!is_connected_) return drop(DropReason::not_connected);
    transmit(message, nullptr);
  }

  void send_to(PeerId id, Bytes message) override {
    if (id != peer_) return drop(DropReason::not_connected);
    send(message);
  }

  [[nodiscard]] std::string peer_name(PeerId id) const override {
    return is_connected_ && id == peer_ ? text_of(place_) : std::string{};
  }

 private:
  static asio::awaitable<void> run(std::shared_ptr<UdpOutLink> self) {
    if (!self->is_connected_) co_await self->connect_until_connected();
    if (self->closed() || !self->is_connected_) co_return;
    self->tell_state(LinkState::up, "sending to " + text_of(self->place_));
    self->tell_peer(self->peer_, PeerChange::joined, text_of(self->place_));
    co_await self->receive_until_closed();
  }

  asio::awaitable<void> connect_until_connected() {
    tell_state(LinkState::connecting, "looking for " + remote_.host);
    auto delay = options_.retry_first;
    while (!closed()) {
      const auto addresses = co_await resolve(remote_.host);
      if (closed()) break;
      auto reason = addresses ? std::string{} : addresses.error();
      for (const auto& address : addresses.value_or(std::vector<asio::ip::address>{})) {
        const auto error = connect({address, remote_.port});
        is_connected_ = !error;
        if (is_connected_) co_return;
        reason = to_text(remote_) + ": " + error.message();
      }
      tell_state(LinkState::down, reason);
      if (closed() || !options_.reconnect) break;

      error_code error;
      auto token = asio::redirect_error(asio::use_awaitable, error);
      pause_.expires_after(delay);
      co_await pause_.async_wait(token);
      delay = std::min(delay * 2, options_.retry_longest);
    }
  }

  void on_datagram(Timestamp now, Bytes bytes, const udp::endpoint&) override { deliver(now, bytes, peer_); }

  error_code connect(const udp::endpoint& place) {
    error_code error;
    socket_.close(error);
    socket_.open(place.protocol(), error);
    if (error) return error;
    tune(socket_);
    socket_.set_option(udp::socket::broadcast{true}, error);
    place_ = place;
    socket_.connect(place, error);
    return error;
  }

  void close_all() override {
    pause_.cancel();
    UdpLink::close_all();
  }

  HostPort remote_;
  udp::endpoint place_{};
  PeerId peer_ = next_peer_id();
  bool is_connected_{};
  asio::steady_timer pause_;  ///< between attempts
};

/// Binds an open socket to where it listens.
error_code bind(udp::socket& socket, const udp::endpoint& local) {
  error_code error;
  if (local.protocol() == udp::v6()) socket.set_option(asio::ip::v6_only{false}, error);
  socket.bind(local, error);
  return error;
}

}  // namespace

Result<std::unique_ptr<Link>, OpenError> open_udp_in_link(Loop& loop, const UdpInEndpoint& endpoint,
                                                          LinkHandler& handler, const LinkOptions& options) {
  const auto name = to_text(Endpoint{endpoint});
  error_code error;
  const auto refuse = [&] { return fail(OpenError{name, error.message()}); };
  const auto address = asio::ip::make_address(endpoint.local.host, error);
  if (error) return refuse();
  udp::socket socket{loop.context()};
  socket.open(address.is_v4() ? udp::v4() : udp::v6(), error);
  if (error) return refuse();
  tune(socket);
  error = bind(socket, {address, endpoint.local.port});
  if (error) return refuse();
  return std::make_unique<LinkHandle>(
      std::make_shared<UdpListener>(loop, name, handler, options, std::move(socket), std::nullopt));
}

std::unique_ptr<Link> make_udp_out_link(Loop& loop, const UdpOutEndpoint& endpoint, LinkHandler& handler,
                                        const LinkOptions& options) {
  return std::make_unique<LinkHandle>(std::make_shared<UdpOutLink>(loop, endpoint, handler, options));
}

Result<std::unique_ptr<Link>, OpenError> open_multicast_link(Loop& loop, const MulticastEndpoint& endpoint,
                                                             LinkHandler& handler, const LinkOptions& options) {
  const auto name = to_text(Endpoint{endpoint});
  error_code error;
  const auto refuse = [&] { return fail(OpenError{name, error.message()}); };
  auto address = asio::ip::make_address(endpoint.group.host, error);
  if (error) return refuse();
  udp::socket socket{loop.context()};
  socket.open(address.is_v4() ? udp::v4() : udp::v6(), error);
  if (error) return refuse();
  tune(socket);
  if (const auto joined = join_group(socket.native_handle(), endpoint); !joined)
    return fail(OpenError{name, joined.error()});
  if (address.is_v6()) {
    auto scoped = address.to_v6();
    scoped.scope_id(interface_index(endpoint));
    address = scoped;
  }
  // Bound to the group, the socket hears nothing that was meant for somebody else on that port.
  error = bind(socket, {address, endpoint.group.port});
  if (error) return refuse();
  const auto group = socket.local_endpoint();
  return std::make_unique<LinkHandle>(
      std::make_shared<UdpListener>(loop, name, handler, options, std::move(socket), group));
}

}  // namespace ponte::transport
