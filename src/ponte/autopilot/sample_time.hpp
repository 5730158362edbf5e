#pragma once

#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// Turns an autopilot's time since boot into UTC, by what SYSTEM_TIME says of both. Until then, and after the autopilot
/// has booted again, the time of reception stands in.
class SampleClock {
 public:
  /// SYSTEM_TIME: `unix_us` is 0 or nonsense while the autopilot has no GPS time.
  void on_system_time(std::uint64_t unix_us, std::uint32_t boot_ms, WallTime received);

  /// The time of a sample stamped with milliseconds since boot.
  [[nodiscard]] WallTime from_boot_ms(std::uint32_t boot_ms, WallTime received);

  /// The time of a sample stamped with microseconds, either of UTC or since boot (the fields named time_usec). A stamp
  /// that lags behind the others counts for nothing: it is 0, or of 32 bits and wrapped, or of the last change.
  [[nodiscard]] WallTime from_usec(std::uint64_t microseconds, WallTime received) const;

  /// The time of a sample without a stamp: that of reception, by the autopilot's clock where that is known, so that all
  /// times of one vehicle agree.
  [[nodiscard]] WallTime from_reception(WallTime received) const { return received + ahead_; }

 private:
  void forget_calendar();

  std::optional<std::int64_t> unix_us_at_boot_;
  std::chrono::microseconds ahead_{};  ///< the autopilot's clock, of the one that stamps receptions
  std::uint32_t newest_boot_ms_{};
};

}  // namespace ponte::autopilot
