#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace ponte::app {

/// How many messages of one kind came, when, and the last of them.
struct Tally {
  std::uint64_t count{};
  std::optional<WallTime> first{};
  std::optional<WallTime> last{};
  std::vector<std::byte> last_bytes{};

  void add(std::optional<WallTime> time, Bytes bytes) {
    ++count;
    if (!first) first = time;
    last = time;
    last_bytes.assign(bytes.begin(), bytes.end());
  }
  /// Messages per second; nothing when all came at one time.
  [[nodiscard]] std::optional<double> rate() const {
    if (!first || !last || *last <= *first) return std::nullopt;
    return static_cast<double>(count - 1) / std::chrono::duration<double>(*last - *first).count();
  }
};

}  // namespace ponte::app
