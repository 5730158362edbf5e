#pragma once

#include "ponte/core/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

/// Time stamps of Edition 3 and Edition A (time): milliseconds of UTC since 2000-01-01T00:00:00Z in 40 bits, which
/// begin again at 0 on 2034-11-03. A stamp tells when the data were captured or confirmed, not when they were sent.
namespace ponte::dli {

inline constexpr WallTime dli_epoch{std::chrono::sys_days{std::chrono::year{2000} / 1 / 1}};
inline constexpr std::uint64_t time_stamp_count = std::uint64_t{1} << 40U;

/// The time stamp of `time`, microseconds cut off; nothing before 2000.
[[nodiscard]] constexpr std::optional<std::uint64_t> time_stamp_from(WallTime time) {
  if (time < dli_epoch) return std::nullopt;
  const auto since = std::chrono::floor<std::chrono::milliseconds>(time - dli_epoch);
  return static_cast<std::uint64_t>(since.count()) % time_stamp_count;
}

/// The time that `stamp` means, in the era of 2^40 ms that brings it nearest to `near`: normally the present. Only the
/// low 40 bits of the stamp count. The result is never before 2000.
[[nodiscard]] constexpr WallTime wall_time_from(std::uint64_t stamp, WallTime near) {
  constexpr auto era = static_cast<std::int64_t>(time_stamp_count);
  const auto low = static_cast<std::int64_t>(stamp % time_stamp_count);
  const auto present = std::chrono::floor<std::chrono::milliseconds>(near - dli_epoch).count();
  const auto eras = present <= low ? 0 : (present - low + era / 2) / era;
  return dli_epoch + std::chrono::milliseconds{low + eras * era};
}

}  // namespace ponte::dli
