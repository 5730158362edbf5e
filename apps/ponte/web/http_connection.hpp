#pragma once

#include "web/beast_request.hpp"
#include "web/connection.hpp"
#include "web/router.hpp"
#include "web/web_socket.hpp"

#include <boost/beast/core/tcp_stream.hpp>

#include <array>
#include <chrono>
#include <optional>
#include <utility>

/// HTTP on any stream of Asio. Instantiated once for plain and once for encrypted connections, in sources of their own:
/// it takes a compiler long.
namespace ponte::app::connection {

using namespace transport;
using namespace std::chrono_literals;
namespace beast = boost::beast;
namespace http = beast::http;

inline constexpr std::uint32_t header_size_max = 8192;
inline constexpr std::uint64_t body_size_max = 4096;
inline constexpr auto request_limit = 30s;  ///< until a request has come, the pause before it included
inline constexpr auto answer_limit = 10s;
inline constexpr auto farewell_limit = 1s;

/// The answer to what could not be read as a request; nothing if there is nobody to answer.
inline std::optional<HttpResponse> answer_to(const error_code& error) {
  if (error == http::error::header_limit)
    return problem(431, "too_large", "the head of a request may have 8192 bytes");
  if (error == http::error::body_limit) return problem(413, "too_large", "the body of a request may have 4096 bytes");
  const bool is_bad = error.category() == http::make_error_code(http::error::bad_method).category() &&
                      error != http::error::end_of_stream && error != http::error::partial_message;
  if (is_bad) return problem(400, "bad_request", error.message());
  return std::nullopt;
}

template <class Stream>
asio::awaitable<error_code> write(Stream& stream, const HttpResponse& response, bool keep_alive, bool is_head) {
  http::response<http::span_body<const char>> message;
  message.version(11);
  message.result(response.status);
  message.keep_alive(keep_alive);
  for (const auto& [name, value] : response.headers) message.set(name, value);
  const auto text = response.text();
  if (response.body) message.set(http::field::content_type, response.type);
  if (response.status != 204 && response.status != 304) message.content_length(text.size());
  if (!is_head) message.body() = {text.data(), text.size()};
  error_code error;
  auto token = asio::redirect_error(asio::use_awaitable, error);
  beast::get_lowest_layer(stream).expires_after(answer_limit);
  co_await http::async_write(stream, message, token);
  co_return error;
}

/// Lets the peer read what was sent to the end before the connection is gone.
template <class Stream>
asio::awaitable<void> say_goodbye(Stream& stream) {
  auto& socket = beast::get_lowest_layer(stream);
  error_code error;
  auto token = asio::redirect_error(asio::use_awaitable, error);
  socket.expires_after(farewell_limit);
  if constexpr (requires { stream.async_shutdown(token); }) co_await stream.async_shutdown(token);
  error_code ignored;
  socket.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  std::array<char, 4096> rest;
  error = {};
  while (!error) co_await socket.async_read_some(asio::buffer(rest), token);
}

/// What a request gets, if it does not become a WebSocket.
inline HttpResponse answer(ServerState& state, const HttpRequest& request, bool is_refused) {
  if (is_refused) return problem(503, "busy", "there are too many connections");
  ++state.counters.requests;
  return state.site->handle(state.loop.now(), request);
}

/// Answers requests until the connection ends, or one of them becomes a WebSocket, which is served then.
template <class Stream>
asio::awaitable<void> answer_requests(std::shared_ptr<ServerState> state, Stream stream, bool is_refused) {
  beast::flat_buffer buffer;
  bool goes_on = true;
  while (goes_on) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(header_size_max);
    parser.body_limit(body_size_max);
    error_code error;
    auto token = asio::redirect_error(asio::use_awaitable, error);
    beast::get_lowest_layer(stream).expires_after(request_limit);
    co_await http::async_read(stream, buffer, parser, token);
    if (state->site == nullptr) co_return;
    if (error) {
      if (const auto response = answer_to(error)) co_await write(stream, *response, false, false);
      break;
    }
    const auto request = request_from(parser.get());
    const bool is_stream = beast::websocket::is_upgrade(parser.get()) && request.path == Router::stream_path;
    HttpResponse response;
    if (is_stream && !is_refused) {
      auto feed = state->site->admit(request);
      if (feed) {
        auto socket = std::make_shared<WebSocket<Stream>>(state, std::move(stream), std::move(*feed));
        co_await socket->run(parser.release());
        co_return;
      }
      response = std::move(feed.error());
    } else {
      response = answer(*state, request, is_refused);
    }
    goes_on = parser.get().keep_alive() && !is_refused;
    if (co_await write(stream, response, goes_on, request.method == "HEAD")) break;
  }
  co_await say_goodbye(stream);
}

}  // namespace ponte::app::connection
