#pragma once

#include <chrono>
#include <cstdint>

namespace ponte {

using Duration = std::chrono::nanoseconds;

/// Tags only: the engines are given the time and never ask these for it.
struct MonotonicClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MonotonicClock>;
};

/// Time since the program, or a replay, began. For time-outs and rates; says nothing about the calendar.
using Timestamp = std::chrono::time_point<MonotonicClock>;

/// Calendar time: microseconds of UTC since 1970-01-01, leap seconds not counted. Never compares with a `Timestamp`.
using WallTime = std::chrono::sys_time<std::chrono::microseconds>;

[[nodiscard]] constexpr WallTime wall_time_from_unix_us(std::int64_t microseconds) {
  return WallTime{std::chrono::microseconds{microseconds}};
}

[[nodiscard]] constexpr std::int64_t unix_us(WallTime time) { return time.time_since_epoch().count(); }
[[nodiscard]] constexpr std::int64_t unix_ms(WallTime time) {
  return std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

}  // namespace ponte
