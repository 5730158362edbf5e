#include "ponte/transport/tcp_link.hpp"

#include "ponte/transport/addresses.hpp"
#include "ponte/transport/shared_link.hpp"
#include "ponte/transport/stream_link.hpp"

#include <netinet/tcp.h>

#include <map>
#include <utility>

namespace ponte::transport {
namespace {

using asio::ip::tcp;

template <int Level, int Name>
using IntegerOption = asio::detail::socket_option::integer<Level, Name>;

/// No waiting for more to send, little piled up in the system, where we could not drop it any more, and the end of a
/// peer noticed when its machine or the network dies silently. What fails does no harm.
void tune(tcp::socket& socket) {
  static constexpr int unsent_bytes_max = 32 * 1024;
  static constexpr int probe_s = 5;
  static constexpr int probes = 3;
  static constexpr int unanswered_ms_max = 20'000;
  error_code ignored;
  socket.set_option(tcp::no_delay{true}, ignored);
  socket.set_option(asio::socket_base::keep_alive{true}, ignored);
  socket.set_option(IntegerOption<IPPROTO_TCP, TCP_KEEPIDLE>{probe_s}, ignored);
  socket.set_option(IntegerOption<IPPROTO_TCP, TCP_KEEPINTVL>{probe_s}, ignored);
  socket.set_option(IntegerOption<IPPROTO_TCP, TCP_KEEPCNT>{probes}, ignored);
  socket.set_option(IntegerOption<IPPROTO_TCP, TCP_USER_TIMEOUT>{unanswered_ms_max}, ignored);
  socket.set_option(IntegerOption<IPPROTO_TCP, TCP_NOTSENT_LOWAT>{unsent_bytes_max}, ignored);
}

class TcpOutLink final : public StreamLink {
 public:
  TcpOutLink(Loop& loop, const TcpOutEndpoint& endpoint, LinkHandler& handler, const LinkOptions& options)
      : StreamLink{loop, to_text(Endpoint{endpoint}), handler, options},
        remote_{endpoint.remote},
        socket_{loop.context()} {}

 private:
  asio::awaitable<Opened> open() override {
    const auto addresses = co_await resolve(remote_.host);
    if (!addresses) co_return fail(addresses.error());
    error_code error;
    for (const auto& address : *addresses) {
      if (closed()) break;
      const tcp::endpoint place{address, remote_.port};
      error = co_await connect(place);
      if (error) continue;
      tune(socket_);
      co_return OpenedStream{FileDescriptor{socket_.release()}, StreamKind::socket, text_of(place)};
    }
    co_return fail(to_text(remote_) + ": " + error.message());
  }

  asio::awaitable<error_code> connect(tcp::endpoint place) {
    socket_.close();
    auto timed_out = false;
    Timer limit{loop_, [&](Timestamp) {
                  timed_out = true;
                  socket_.close();
                }};
    limit.set(loop_.now() + options_.connect_limit);
    error_code error;
    auto token = asio::redirect_error(asio::use_awaitable, error);
    co_await socket_.async_connect(place, token);
    // The socket may have been closed when it had connected already.
    if (timed_out || (!error && !socket_.is_open())) co_return asio::error::timed_out;
    // A socket that looks for a listener on this machine can meet itself, when the kernel gives it the port it calls.
    if (!error && socket_.local_endpoint(error) == place) co_return asio::error::connection_refused;
    co_return error;
  }

  [[nodiscard]] std::string describe_end(const std::string& reason) const override {
    return to_text(remote_) + ": " + reason;
  }

  void close_all() override {
    StreamLink::close_all();
    error_code ignored;
    socket_.close(ignored);
  }

  HostPort remote_;
  tcp::socket socket_;  ///< while it connects
};

class TcpInLink final : public SharedLink, public std::enable_shared_from_this<TcpInLink> {
 public:
  TcpInLink(Loop& loop, const TcpInEndpoint& endpoint, tcp::acceptor acceptor, LinkHandler& handler,
            const LinkOptions& options)
      : SharedLink{loop, to_text(Endpoint{endpoint}), handler, options},
        acceptor_{std::move(acceptor)},
        local_{acceptor_.local_endpoint()},
        pause_{loop.context()} {}

  void start() override { spawn(loop_, accept(shared_from_this())); }

  void send(Bytes message) override {
    if (peers_.empty()) drop(DropReason::not_connected);
    for (const auto& [id, peer] : peers_) peer.connection->send(message);
  }

  void send_to(PeerId id, Bytes message) override {
    const auto peer = peers_.find(id);
    if (peer == peers_.end()) {
      drop(DropReason::not_connected);
    } else {
      peer->second.connection->send(message);
    }
  }

  [[nodiscard]] std::string peer_name(PeerId id) const override {
    const auto peer = peers_.find(id);
    return peer == peers_.end() ? std::string{} : peer->second.name;
  }

  [[nodiscard]] std::uint16_t local_port() const override { return local_.port(); }

 private:
  struct Peer {
    std::shared_ptr<StreamConnection> connection;
    std::string name;
  };

  static asio::awaitable<void> accept(std::shared_ptr<TcpInLink> self) {
    self->tell_state(LinkState::up, "listening on " + text_of(self->local_));
    while (!self->closed()) {
      error_code error;
      auto token = asio::redirect_error(asio::use_awaitable, error);
      tcp::socket socket{self->loop_.context()};
      co_await self->acceptor_.async_accept(socket, token);
      if (self->closed()) break;
      if (!error) {
        self->take(std::move(socket));
        continue;
      }
      // The caller has gone already, or the system is short of something: others may still get through.
      self->pause_.expires_after(self->options_.retry_first);
      co_await self->pause_.async_wait(token);
    }
  }

  void take(tcp::socket socket) {
    error_code error;
    const auto place = socket.remote_endpoint(error);
    if (error) return;
    if (peers_.size() >= options_.peers) return drop(DropReason::too_many_peers);
    tune(socket);
    FileDescriptor descriptor{socket.release()};
    auto connection =
        std::make_shared<StreamConnection>(loop_, std::move(descriptor), StreamKind::socket, options_.queue, counters_);
    const auto id = next_peer_id();
    peers_.emplace(id, Peer{std::move(connection), text_of(place)});
    spawn(loop_, serve(shared_from_this(), id));
  }

  static asio::awaitable<void> serve(std::shared_ptr<TcpInLink> self, PeerId id) {
    if (self->closed()) co_return;
    const auto peer = self->peers_.at(id);
    self->tell_peer(id, PeerChange::joined, peer.name);
    StreamConnection::OnBytes on_bytes = [&handler = self->handler_, id](Timestamp now, Bytes bytes) {
      handler.on_bytes(now, bytes, id);
    };
    co_await peer.connection->read_until_closed(std::move(on_bytes));
    self->peers_.erase(id);
    self->tell_peer(id, PeerChange::left, peer.name);
  }

  void close_all() override {
    error_code ignored;
    acceptor_.close(ignored);
    pause_.cancel();
    for (const auto& [id, peer] : peers_) peer.connection->close();
  }

  tcp::acceptor acceptor_;
  tcp::endpoint local_;
  asio::steady_timer pause_;  ///< after a failure to accept
  std::map<PeerId, Peer> peers_;
};

}  // namespace

std::unique_ptr<Link> make_tcp_out_link(Loop& loop, const TcpOutEndpoint& endpoint, LinkHandler& handler,
                                        const LinkOptions& options) {
  return std::make_unique<LinkHandle>(std::make_shared<TcpOutLink>(loop, endpoint, handler, options));
}

Result<std::unique_ptr<Link>, OpenError> open_tcp_in_link(Loop& loop, const TcpInEndpoint& endpoint,
                                                          LinkHandler& handler, const LinkOptions& options) {
  error_code error;
  const auto refuse = [&] { return fail(OpenError{to_text(Endpoint{endpoint}), error.message()}); };
  const auto address = asio::ip::make_address(endpoint.local.host, error);
  if (error) return refuse();
  const tcp::endpoint local{address, endpoint.local.port};
  tcp::acceptor acceptor{loop.context()};
  acceptor.open(local.protocol(), error);
  if (error) return refuse();
  acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
  if (local.protocol() == tcp::v6()) acceptor.set_option(asio::ip::v6_only{false}, error);
  acceptor.bind(local, error);
  if (error) return refuse();
  acceptor.listen(tcp::acceptor::max_listen_connections, error);
  if (error) return refuse();
  return std::make_unique<LinkHandle>(
      std::make_shared<TcpInLink>(loop, endpoint, std::move(acceptor), handler, options));
}

}  // namespace ponte::transport
