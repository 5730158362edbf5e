#include "web/http_connection.hpp"

#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/websocket/ssl.hpp>

namespace ponte::app {

using namespace transport;

asio::awaitable<void> serve_tls(std::shared_ptr<ServerState> state, asio::ip::tcp::socket socket, bool is_refused) {
  asio::ssl::stream<boost::beast::tcp_stream> stream{std::move(socket), *state->tls};
  error_code error;
  auto token = asio::redirect_error(asio::use_awaitable, error);
  boost::beast::get_lowest_layer(stream).expires_after(connection::answer_limit);
  co_await stream.async_handshake(asio::ssl::stream_base::server, token);
  if (!error) co_await connection::answer_requests(std::move(state), std::move(stream), is_refused);
}

}  // namespace ponte::app
