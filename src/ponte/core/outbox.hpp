#pragma once

#include "ponte/core/assert.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ponte {

/// What an engine wants done, oldest first, in memory that is allocated once. When it is full the oldest entry gives
/// way and is counted: right for telemetry, where the newest is worth most.
template <class T>
class Outbox {
 public:
  explicit Outbox(std::size_t capacity) : entries_(capacity) { PONTE_ASSERT(capacity > 0); }

  void push(const T& entry) {
    if (size_ == entries_.size()) {
      first_ = (first_ + 1) % entries_.size();
      --size_;
      ++overwritten_;
    }
    entries_[(first_ + size_) % entries_.size()] = entry;
    ++size_;
  }

  /// Hands out the entries, oldest first, and is empty afterwards.
  template <class Sink>
  void drain(Sink&& sink) {
    for (; size_ > 0; --size_) {
      sink(entries_[first_]);
      first_ = (first_ + 1) % entries_.size();
    }
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Entries that were lost because nobody took them out in time.
  [[nodiscard]] std::uint64_t overwritten() const { return overwritten_; }

 private:
  std::vector<T> entries_;
  std::size_t first_{};
  std::size_t size_{};
  std::uint64_t overwritten_{};
};

}  // namespace ponte
