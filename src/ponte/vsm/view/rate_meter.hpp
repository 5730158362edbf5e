#pragma once

#include "ponte/core/time.hpp"

#include <chrono>
#include <cstdint>

namespace ponte::vsm::view {

/// How many messages of a kind there were, and how many a second lately. Three numbers instead of a window of times.
class RateMeter {
 public:
  /// The rate is that of a time between `span` and twice as long.
  static constexpr Duration span = std::chrono::milliseconds{2500};

  void on_message(Timestamp now) {
    if (count_ == 0) older_ = newer_ = {now, 1};
    ++count_;
    last_ = now;
    if (now - newer_.at < span) return;
    older_ = newer_;
    newer_ = {now, count_};
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] bool is_silent(Timestamp now) const { return now - last_ >= 2 * span; }
  /// Messages per second; 0 after a silence.
  [[nodiscard]] double hz(Timestamp now) const {
    if (is_silent(now) || now <= older_.at) return 0;
    return static_cast<double>(count_ - older_.count) / std::chrono::duration<double>(now - older_.at).count();
  }

 private:
  struct Mark {
    Timestamp at{};
    std::uint64_t count{};
  };

  Mark older_{};
  Mark newer_{};
  Timestamp last_{};
  std::uint64_t count_{};
};

}  // namespace ponte::vsm::view
