#pragma once

#include "ponte/core/time.hpp"

#include <algorithm>
#include <optional>

namespace ponte::autopilot {

/// How long to wait for an answer before asking again: by the round trips that were measured, as in RFC 6298; doubled
/// when it ran out, at most twice, until one is measured again. So a fast link does not idle, and a slow one is not
/// flooded.
class Patience {
 public:
  struct Limits {
    Duration first{std::chrono::milliseconds{500}};  ///< before anything is measured; MAVSDK's timer
    Duration least{std::chrono::milliseconds{100}};
    Duration most{std::chrono::milliseconds{1500}};  ///< but for what ran out; the timer that the protocol recommends
  };

  explicit Patience(const Limits& limits) : limits_{limits}, base_{limits.first} {}

  /// From a message that was sent once to its answer. What was sent twice measures nothing: nobody knows which of them
  /// was answered. The other side repeats itself too, and then takes a while longer: so a much shorter time than before
  /// is believed at once, and a much longer one counts for less.
  void measured(Duration round_trip) {
    if (!mean_ || 2 * round_trip < *mean_) {
      mean_ = round_trip;
      deviation_ = round_trip / 2;
    } else {
      const auto believed = std::min(round_trip, 2 * *mean_ + limits_.least);
      deviation_ = (3 * deviation_ + std::chrono::abs(*mean_ - believed)) / 4;
      mean_ = (7 * *mean_ + believed) / 8;
    }
    base_ = std::clamp(*mean_ + 4 * deviation_, limits_.least, limits_.most);
    factor_ = 1;
  }
  void ran_out() { factor_ = std::min(2 * factor_, 4); }

  [[nodiscard]] Duration current() const { return std::min(factor_ * base_, 2 * limits_.most); }
  /// The mean round trip; a repeated request that comes sooner was sent before our answer arrived.
  [[nodiscard]] Duration round_trip() const { return mean_.value_or(limits_.least); }

 private:
  Limits limits_;
  Duration base_;
  int factor_{1};
  std::optional<Duration> mean_;
  Duration deviation_{};
};

}  // namespace ponte::autopilot
