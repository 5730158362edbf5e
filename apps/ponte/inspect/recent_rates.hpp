#pragma once

#include "inspect/tally.hpp"

#include <deque>
#include <map>

namespace ponte::app {

/// Rates of the last few seconds, from counts that are noted once a second.
class RecentRates {
 public:
  /// Begins the notes of a second.
  void next_second() {
    if (notes_.size() == seconds) notes_.pop_front();
    notes_.emplace_back();
  }
  void note(const Tally& tally) { notes_.back()[&tally] = tally.count; }

  /// Messages per second since the oldest note; nothing while there is none.
  [[nodiscard]] std::optional<double> of(const Tally& tally) const {
    if (notes_.empty()) return std::nullopt;
    const auto found = notes_.front().find(&tally);
    const auto before = found == notes_.front().end() ? 0 : found->second;
    return static_cast<double>(tally.count - before) / static_cast<double>(notes_.size());
  }

 private:
  static constexpr std::size_t seconds = 5;

  std::deque<std::map<const Tally*, std::uint64_t>> notes_;
};

}  // namespace ponte::app
