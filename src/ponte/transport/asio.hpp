#pragma once

// The only place where Asio is included from, so that it stays in the few sources that need it.

#include "ponte/transport/loop.hpp"

#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <exception>
#include <utility>

namespace ponte::transport {

namespace asio = boost::asio;
using error_code = boost::system::error_code;

/// Runs a coroutine on the loop, beginning after the present event. An exception in it leaves `Loop::run`.
inline void spawn(Loop& loop, asio::awaitable<void> coroutine) {
  auto& context = loop.context();
  asio::post(context, [&context, coroutine = std::move(coroutine)]() mutable {
    asio::co_spawn(context, std::move(coroutine), [](const std::exception_ptr& exception) {
      if (exception) std::rethrow_exception(exception);
    });
  });
}

}  // namespace ponte::transport
