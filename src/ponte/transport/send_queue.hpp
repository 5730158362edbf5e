#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/transport/link.hpp"

#include <cstddef>
#include <vector>

namespace ponte::transport {

/// Messages on their way into a stream. When it is full the oldest one that has not begun to leave gives way; one that
/// has begun never does, as half a message would spoil the stream. Memory is reused.
class SendQueue {
 public:
  explicit SendQueue(QueueLimits limits);

  /// Appends a message that is not larger than the queue. Of the first, `sent` bytes may already have left, though not
  /// all. Returns how many messages were dropped: older ones, or itself if it does not fit beside one that has begun.
  [[nodiscard]] std::size_t push(Bytes message, std::size_t sent = 0);
  /// What is left of the oldest message; empty when there is none.
  [[nodiscard]] Bytes front() const;
  /// That many bytes of `front()` have left. Returns whether that was the end of the message.
  bool advance(std::size_t sent);
  /// Forgets everything and returns how many messages that were.
  std::size_t clear();

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] std::vector<std::byte>& slot(std::size_t index) { return slots_[(first_ + index) % slots_.size()]; }
  [[nodiscard]] bool has_room_for(std::size_t bytes) const;
  void pop();

  QueueLimits limits_;
  std::vector<std::vector<std::byte>> slots_;
  std::size_t first_{};
  std::size_t size_{};
  std::size_t bytes_{};  ///< of whole messages
  std::size_t sent_{};   ///< of the oldest message
};

}  // namespace ponte::transport
