#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/transport/asio.hpp"
#include "ponte/transport/file_descriptor.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/send_queue.hpp"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace ponte::transport {

enum class StreamKind { socket, terminal };

/// One live stream of bytes, to one peer, over a descriptor that it owns. Is shared with its own operations.
class StreamConnection : public std::enable_shared_from_this<StreamConnection> {
 public:
  /// `counters` has to live until `close`.
  StreamConnection(Loop& loop, FileDescriptor descriptor, StreamKind kind, QueueLimits limits, LinkCounters& counters);

  using OnBytes = std::function<void(Timestamp now, Bytes bytes)>;
  /// Hands out what arrives until the stream ends, and returns why it did. The caller keeps the connection alive.
  asio::awaitable<std::string> read_until_closed(OnBytes on_bytes);

  /// Sends at once what the system takes and queues the rest.
  void send(Bytes message);
  void close() { close("closed"); }

 private:
  void close(std::string reason);
  void write_queue();
  void wait_until_writable();
  /// How many bytes the system took; nothing when the stream has ended, which it then does for us too.
  std::optional<std::size_t> write_some(Bytes bytes);
  void count_sent_message() { ++counters_.messages_out; }

  Loop& loop_;
  asio::posix::stream_descriptor descriptor_;
  StreamKind kind_;
  QueueLimits limits_;
  LinkCounters& counters_;
  SendQueue queue_;
  std::string end_;
  std::array<std::byte, 16'384> buffer_{};
};

}  // namespace ponte::transport
