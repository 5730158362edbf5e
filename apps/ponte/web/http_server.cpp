#include "web/http_server.hpp"

#include "common/failure.hpp"
#include "ponte/transport/addresses.hpp"
#include "web/connection.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>
#include <vector>

namespace ponte::app {
namespace {

using namespace transport;
using asio::ip::tcp;

tcp::acceptor listen_on(Loop& loop, const HostPort& place) {
  error_code error;
  const auto fail_if = [&](std::string_view what) {
    if (error) throw Failure{fmt::format("--http {}: {}: {}", to_text(place), what, error.message())};
  };
  const auto address = asio::ip::make_address(place.host, error);
  fail_if("expected a numeric address");
  const tcp::endpoint local{address, place.port};
  tcp::acceptor acceptor{loop.context()};
  acceptor.open(local.protocol(), error);
  fail_if("cannot be opened");
  acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
  if (local.protocol() == tcp::v6()) acceptor.set_option(asio::ip::v6_only{false}, error);
  acceptor.bind(local, error);
  fail_if("cannot listen there");
  acceptor.listen(tcp::acceptor::max_listen_connections, error);
  fail_if("cannot listen there");
  return acceptor;
}

std::optional<asio::ssl::context> tls_from(const HttpServerOptions& options) {
  if (options.certificate.empty()) return std::nullopt;
  asio::ssl::context context{asio::ssl::context::tls_server};
  context.set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_tlsv1 |
                      asio::ssl::context::no_tlsv1_1);
  error_code error;
  context.use_certificate_chain_file(options.certificate, error);
  if (error) throw Failure{fmt::format("--http-cert {}: {}", options.certificate, error.message())};
  context.use_private_key_file(options.key, asio::ssl::context::pem, error);
  if (error) throw Failure{fmt::format("--http-key {}: {}", options.key, error.message())};
  return context;
}

/// Counts a connection while it lives.
class Counted {
 public:
  explicit Counted(std::size_t& count) : count_{count} { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::size_t& count_;
};

asio::awaitable<void> serve(std::shared_ptr<ServerState> state, tcp::socket socket) {
  const auto before = state->counters.connections;
  if (before >= ServerState::connection_limit + ServerState::refusal_limit) co_return;
  const Counted counted{state->counters.connections};
  const bool is_refused = before >= ServerState::connection_limit;
  error_code error;
  socket.set_option(tcp::no_delay{true}, error);
  if (state->tls)
    co_await serve_tls(state, std::move(socket), is_refused);
  else
    co_await serve_plain(state, std::move(socket), is_refused);
}

}  // namespace

class HttpServer::Acceptor : public std::enable_shared_from_this<Acceptor> {
 public:
  Acceptor(Loop& loop, const HttpServerOptions& options, HttpSite& site)
      : acceptor_{listen_on(loop, options.address)},
        state_{std::make_shared<ServerState>(ServerState{.loop = loop, .site = &site, .tls = tls_from(options)})} {}

  asio::awaitable<void> accept_until_closed() {
    const auto self = shared_from_this();
    while (state_->site != nullptr) {
      error_code error;
      auto token = asio::redirect_error(asio::use_awaitable, error);
      tcp::socket socket{state_->loop.context()};
      co_await acceptor_.async_accept(socket, token);
      if (error == asio::error::operation_aborted) co_return;
      if (!error) {
        spawn(state_->loop, serve(state_, std::move(socket)));
        continue;
      }
      // No descriptors are left, or the like: that passes, but not at once.
      asio::steady_timer pause{state_->loop.context(), std::chrono::milliseconds{100}};
      co_await pause.async_wait(token);
    }
  }

  void close() {
    state_->site = nullptr;
    error_code ignored;
    acceptor_.close(ignored);
  }

  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  [[nodiscard]] ServerState& state() { return *state_; }

 private:
  tcp::acceptor acceptor_;
  std::shared_ptr<ServerState> state_;
};

HttpServer::HttpServer(Loop& loop, const HttpServerOptions& options, HttpSite& site)
    : acceptor_{std::make_shared<Acceptor>(loop, options, site)} {
  spawn(loop, acceptor_->accept_until_closed());
}

HttpServer::~HttpServer() { acceptor_->close(); }

std::uint16_t HttpServer::port() const { return acceptor_->port(); }

void HttpServer::on_tick(Timestamp now) {
  const std::vector<StreamClient*> clients{acceptor_->state().clients.begin(), acceptor_->state().clients.end()};
  for (auto* client : clients) client->on_tick(now);
}

ServerCounters HttpServer::counters() const {
  auto counters = acceptor_->state().counters;
  counters.stream_clients = acceptor_->state().clients.size();
  for (const auto* client : acceptor_->state().clients) counters.telemetry_dropped += client->dropped();
  return counters;
}

}  // namespace ponte::app
