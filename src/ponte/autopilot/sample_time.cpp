#include "ponte/autopilot/sample_time.hpp"

#include <algorithm>

namespace ponte::autopilot {
namespace {

/// 2000-01-01 and 2100-01-01 UTC: what lies outside is no calendar time.
constexpr std::uint64_t earliest_unix_us = 946'684'800'000'000;
constexpr std::uint64_t latest_unix_us = 4'102'444'800'000'000;

/// Messages overtake one another by less than this; a larger step back is a reboot.
constexpr std::uint32_t largest_disorder_ms = 1000;

bool is_calendar_time(std::uint64_t unix_us) { return unix_us >= earliest_unix_us && unix_us < latest_unix_us; }

}  // namespace

void SampleClock::on_system_time(std::uint64_t unix_us, std::uint32_t boot_ms, WallTime received) {
  newest_boot_ms_ = boot_ms;
  forget_calendar();
  if (!is_calendar_time(unix_us)) return;
  const auto now_us = static_cast<std::int64_t>(unix_us);
  unix_us_at_boot_ = now_us - static_cast<std::int64_t>(boot_ms) * 1000;
  ahead_ = wall_time_from_unix_us(now_us) - received;
}

WallTime SampleClock::from_boot_ms(std::uint32_t boot_ms, WallTime received) {
  const bool has_rebooted = std::uint64_t{boot_ms} + largest_disorder_ms < newest_boot_ms_;
  if (has_rebooted) forget_calendar();
  newest_boot_ms_ = has_rebooted ? boot_ms : std::max(newest_boot_ms_, boot_ms);
  if (!unix_us_at_boot_) return received;
  return wall_time_from_unix_us(*unix_us_at_boot_ + static_cast<std::int64_t>(boot_ms) * 1000);
}

WallTime SampleClock::from_usec(std::uint64_t microseconds, WallTime received) const {
  if (is_calendar_time(microseconds)) return wall_time_from_unix_us(static_cast<std::int64_t>(microseconds));
  const bool lags = microseconds / 1000 + largest_disorder_ms < newest_boot_ms_;
  if (!unix_us_at_boot_ || lags || microseconds >= earliest_unix_us) return from_reception(received);
  return wall_time_from_unix_us(*unix_us_at_boot_ + static_cast<std::int64_t>(microseconds));
}

void SampleClock::forget_calendar() {
  unix_us_at_boot_.reset();
  ahead_ = {};
}

}  // namespace ponte::autopilot
