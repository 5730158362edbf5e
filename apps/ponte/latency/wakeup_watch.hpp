#pragma once

#include "ponte/transport/loop.hpp"
#include "ponte/vsm/latency_study.hpp"

#include <chrono>
#include <vector>

namespace ponte::app {

/// Sees how late the loop wakes up for a periodic timer, from now on.
class WakeupWatch {
 public:
  static constexpr Duration period = std::chrono::milliseconds{10};

  explicit WakeupWatch(transport::Loop& loop)
      : due_{loop.now() + period}, timer_{loop, [this](Timestamp now) { on_wakeup(now); }} {
    late_us_.reserve(kept);
    timer_.set(due_);
  }

  /// How late each was, in microseconds; of a long run the beginning.
  [[nodiscard]] const std::vector<double>& late_us() const { return late_us_; }

 private:
  static constexpr std::size_t kept = 100'000;

  void on_wakeup(Timestamp now) {
    if (late_us_.size() < kept) late_us_.push_back(vsm::microseconds(now - due_));
    while (due_ <= now) due_ += period;
    timer_.set(due_);
  }

  Timestamp due_;
  std::vector<double> late_us_;
  transport::Timer timer_;
};

}  // namespace ponte::app
