#include "ponte/transport/send_queue.hpp"

#include "ponte/core/assert.hpp"

#include <utility>

namespace ponte::transport {

SendQueue::SendQueue(QueueLimits limits) : limits_{limits}, slots_(limits.messages) {
  PONTE_ASSERT(limits.messages > 0);
}

bool SendQueue::has_room_for(std::size_t bytes) const {
  return size_ < limits_.messages && bytes <= limits_.bytes - bytes_;
}

std::size_t SendQueue::push(Bytes message, std::size_t sent) {
  PONTE_ASSERT(sent < message.size());
  PONTE_ASSERT(sent == 0 || empty());
  PONTE_ASSERT(message.size() <= limits_.bytes);
  const auto has_begun = sent_ > 0;
  if (has_begun && (limits_.messages == 1 || message.size() > limits_.bytes - slot(0).size())) return 1;

  std::size_t dropped = 0;
  while (!has_room_for(message.size())) {
    if (has_begun) std::swap(slot(0), slot(1));
    pop();
    ++dropped;
  }
  slot(size_).assign(message.begin(), message.end());
  ++size_;
  bytes_ += message.size();
  if (sent > 0) sent_ = sent;
  return dropped;
}

Bytes SendQueue::front() const { return empty() ? Bytes{} : Bytes{slots_[first_]}.subspan(sent_); }

bool SendQueue::advance(std::size_t sent) {
  sent_ += sent;
  if (sent_ < slot(0).size()) return false;
  sent_ = 0;
  pop();
  return true;
}

std::size_t SendQueue::clear() {
  bytes_ = sent_ = 0;
  return std::exchange(size_, 0);
}

void SendQueue::pop() {
  bytes_ -= slot(0).size();
  first_ = (first_ + 1) % slots_.size();
  --size_;
}

}  // namespace ponte::transport
