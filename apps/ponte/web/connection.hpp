#pragma once

#include "ponte/transport/asio.hpp"
#include "web/http_server.hpp"

#include <boost/asio/ssl/context.hpp>

#include <memory>
#include <optional>
#include <set>

namespace ponte::app {

/// A WebSocket as the server sees it.
class StreamClient {
 public:
  virtual ~StreamClient() = default;
  virtual void on_tick(Timestamp now) = 0;
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;
};

/// What the connections of a server share, as long as there is one of them.
struct ServerState {
  static constexpr std::size_t connection_limit = 64;
  /// So many more are told that there are too many; the rest is cut off.
  static constexpr std::size_t refusal_limit = 16;

  transport::Loop& loop;
  HttpSite* site;  ///< nothing once the server has ended
  std::optional<transport::asio::ssl::context> tls{};
  ServerCounters counters{};
  std::set<StreamClient*> clients{};
};

/// Serve one connection to its end; `is_refused` tells it only that there are too many.
[[nodiscard]] transport::asio::awaitable<void> serve_plain(std::shared_ptr<ServerState> state,
                                                           transport::asio::ip::tcp::socket socket, bool is_refused);
[[nodiscard]] transport::asio::awaitable<void> serve_tls(std::shared_ptr<ServerState> state,
                                                         transport::asio::ip::tcp::socket socket, bool is_refused);

}  // namespace ponte::app
