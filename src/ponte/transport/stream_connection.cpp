#include "ponte/transport/stream_connection.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ponte::transport {
namespace {

bool is_would_block(int error) { return error == EAGAIN || error == EWOULDBLOCK; }

}  // namespace

StreamConnection::StreamConnection(Loop& loop, FileDescriptor descriptor, StreamKind kind, QueueLimits limits,
                                   LinkCounters& counters)
    : loop_{loop},
      descriptor_{loop.context(), descriptor.release()},
      kind_{kind},
      limits_{limits},
      counters_{counters},
      queue_{limits} {
  descriptor_.native_non_blocking(true);
}

// Waiting and reading are two steps, so that the time is taken right behind the system call, however much else is ready
// to run on the loop.
asio::awaitable<std::string> StreamConnection::read_until_closed(OnBytes on_bytes) {
  while (descriptor_.is_open()) {
    error_code error;
    auto token = asio::redirect_error(asio::use_awaitable, error);
    co_await descriptor_.async_wait(asio::posix::stream_descriptor::wait_read, token);
    if (!descriptor_.is_open()) break;
    if (error) {
      close(error.message());
      break;
    }

    const auto size = ::read(descriptor_.native_handle(), buffer_.data(), buffer_.size());
    const auto now = loop_.now();
    if (size > 0) {
      counters_.bytes_in += static_cast<std::size_t>(size);
      on_bytes(now, Bytes{buffer_}.first(static_cast<std::size_t>(size)));
    } else if (size == 0) {
      close("the other side closed it");
    } else if (!is_would_block(errno) && errno != EINTR) {
      close(std::system_category().message(errno));
    }
  }
  co_return end_;
}

void StreamConnection::send(Bytes message) {
  if (message.empty()) return;
  if (!descriptor_.is_open()) {
    ++counters_.dropped_by(DropReason::not_connected);
    return;
  }
  if (message.size() > limits_.bytes) {
    ++counters_.dropped_by(DropReason::oversize);
    return;
  }
  if (!queue_.empty()) {
    counters_.dropped_by(DropReason::queue_full) += queue_.push(message);
    return;
  }
  const auto sent = write_some(message);
  if (!sent) {
    ++counters_.dropped_by(DropReason::disconnected);
  } else if (*sent == message.size()) {
    count_sent_message();
  } else {
    counters_.dropped_by(DropReason::queue_full) += queue_.push(message, *sent);
    wait_until_writable();
  }
}

void StreamConnection::wait_until_writable() {
  auto on_writable = [self = shared_from_this()](error_code) { self->write_queue(); };
  descriptor_.async_wait(asio::posix::stream_descriptor::wait_write, std::move(on_writable));
}

void StreamConnection::write_queue() {
  while (!queue_.empty()) {
    const auto sent = write_some(queue_.front());
    if (!sent) return;
    if (*sent == 0) return wait_until_writable();
    if (queue_.advance(*sent)) count_sent_message();
  }
}

std::optional<std::size_t> StreamConnection::write_some(Bytes bytes) {
  const auto descriptor = descriptor_.native_handle();
  // write() to a socket whose peer has gone would raise SIGPIPE.
  const auto size = kind_ == StreamKind::socket ? ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                                : ::write(descriptor, bytes.data(), bytes.size());
  if (size < 0 && (is_would_block(errno) || errno == EINTR)) return 0;
  if (size < 0) {
    close(std::system_category().message(errno));
    return {};
  }
  counters_.bytes_out += static_cast<std::size_t>(size);
  return static_cast<std::size_t>(size);
}

void StreamConnection::close(std::string reason) {
  if (!descriptor_.is_open()) return;
  end_ = std::move(reason);
  counters_.dropped_by(DropReason::disconnected) += queue_.clear();
  error_code ignored;
  descriptor_.close(ignored);
}

}  // namespace ponte::transport
