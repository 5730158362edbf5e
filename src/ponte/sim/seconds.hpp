#pragma once

#include "ponte/core/time.hpp"

#include <algorithm>

namespace ponte::sim {

/// So many seconds, as parameters of messages and settings tell them: none if it is negative or no number, and no more
/// than ten million.
[[nodiscard]] inline Duration seconds_from(double number) {
  constexpr double most = 1e7;
  if (!(number > 0)) return {};
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>{std::min(number, most)});
}

}  // namespace ponte::sim
