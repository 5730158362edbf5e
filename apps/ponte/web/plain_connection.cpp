#include "web/http_connection.hpp"

namespace ponte::app {

using namespace transport;

asio::awaitable<void> serve_plain(std::shared_ptr<ServerState> state, asio::ip::tcp::socket socket, bool is_refused) {
  return connection::answer_requests(std::move(state), boost::beast::tcp_stream{std::move(socket)}, is_refused);
}

}  // namespace ponte::app
