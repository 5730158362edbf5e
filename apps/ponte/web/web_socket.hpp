#pragma once

#include "web/beast_request.hpp"
#include "web/connection.hpp"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <memory>
#include <string_view>
#include <utility>

namespace ponte::app {

/// One WebSocket: reads what its client wants to see, and sends what its feed has, one message at a time. The feed makes
/// a message when the one before has gone out, so nothing queues up here.
template <class Stream>
class WebSocket final : public StreamClient, public std::enable_shared_from_this<WebSocket<Stream>> {
 public:
  WebSocket(std::shared_ptr<ServerState> state, Stream stream, std::unique_ptr<vsm::view::ClientFeed> feed)
      : state_{std::move(state)}, feed_{std::move(feed)}, socket_{std::move(stream)} {
    namespace websocket = boost::beast::websocket;
    // A ping every 5 s; a client that does not answer because it reads nothing is cut off after 10 s.
    socket_.set_option(websocket::stream_base::timeout{.handshake_timeout = std::chrono::seconds{10},
                                                       .idle_timeout = std::chrono::seconds{10},
                                                       .keep_alive_pings = true});
    socket_.read_message_max(vsm::view::ClientFeed::message_size_max);
    socket_.auto_fragment(false);
    boost::beast::get_lowest_layer(socket_).expires_never();
  }
  ~WebSocket() override { state_->counters.telemetry_dropped += feed_->dropped(); }

  transport::asio::awaitable<void> run(BeastRequest request) {
    const auto self = this->shared_from_this();
    transport::error_code error;
    auto token = transport::asio::redirect_error(transport::asio::use_awaitable, error);
    co_await socket_.async_accept(request, token);
    if (error || state_->site == nullptr) co_return;
    ++state_->counters.streams_opened;
    state_->clients.insert(this);
    send_next();
    co_await read_messages();
    is_closing_ = true;
    state_->clients.erase(this);
  }

  void on_tick(Timestamp now) override {
    feed_->on_tick(now);
    send_next();
  }
  [[nodiscard]] std::uint64_t dropped() const override { return feed_->dropped(); }

 private:
  transport::asio::awaitable<void> read_messages() {
    boost::beast::flat_buffer buffer;
    transport::error_code error;
    auto token = transport::asio::redirect_error(transport::asio::use_awaitable, error);
    while (true) {
      co_await socket_.async_read(buffer, token);
      if (error || state_->site == nullptr) co_return;
      const std::string_view text{static_cast<const char*>(buffer.data().data()), buffer.size()};
      if (!feed_->on_message(state_->loop.now(), text)) break;
      buffer.consume(buffer.size());
      send_next();
    }
    is_closing_ = true;
    const boost::beast::websocket::close_reason reason{boost::beast::websocket::close_code::policy_error};
    co_await socket_.async_close(reason, token);
  }

  void send_next() {
    if (is_sending_ || is_closing_ || state_->site == nullptr) return;
    if (feed_->has_lost_events()) return cut_off();
    text_ = feed_->take(state_->loop.now());
    if (!text_) return;
    is_sending_ = true;
    auto on_sent = [self = this->shared_from_this()](transport::error_code error, std::size_t) {
      self->is_sending_ = false;
      if (!error) self->send_next();
    };
    socket_.async_write(transport::asio::buffer(*text_), std::move(on_sent));
  }

  /// Ends the reading, and so the connection. The client comes back and sees by the numbers what it has missed.
  void cut_off() {
    is_closing_ = true;
    boost::beast::get_lowest_layer(socket_).close();
  }

  std::shared_ptr<ServerState> state_;
  std::unique_ptr<vsm::view::ClientFeed> feed_;
  boost::beast::websocket::stream<Stream, false> socket_;  // without compression
  vsm::view::SharedText text_;  ///< on its way
  bool is_sending_{};
  bool is_closing_{};
};

}  // namespace ponte::app
