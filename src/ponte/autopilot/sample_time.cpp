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

void SampleClock::on_system_time(std::uint64_t unix_us, std::uint32_t boot_ms) {
  newest_boot_ms_ = boot_ms;
  unix_us_at_boot_.reset();
  if (is_calendar_time(unix_us))
    unix_us_at_boot_ = static_cast<std::int64_t>(unix_us) - static_cast<std::int64_t>(boot_ms) * 1000;
}

WallTime SampleClock::from_boot_ms(std::uint32_t boot_ms, WallTime received) {
  if (std::uint64_t{boot_ms} + largest_disorder_ms < newest_boot_ms_) unix_us_at_boot_.reset();
  newest_boot_ms_ = unix_us_at_boot_ ? std::max(newest_boot_ms_, boot_ms) : boot_ms;
  if (!unix_us_at_boot_) return received;
  return wall_time_from_unix_us(*unix_us_at_boot_ + static_cast<std::int64_t>(boot_ms) * 1000);
}

WallTime SampleClock::from_usec(std::uint64_t microseconds, WallTime received) {
  if (is_calendar_time(microseconds)) return wall_time_from_unix_us(static_cast<std::int64_t>(microseconds));
  if (microseconds >= earliest_unix_us) return received;
  return from_boot_ms(static_cast<std::uint32_t>(std::min<std::uint64_t>(microseconds / 1000, UINT32_MAX)), received);
}

}  // namespace ponte::autopilot
