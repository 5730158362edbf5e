#pragma once

#include "ponte/core/outbox.hpp"
#include "ponte/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <variant>

namespace ponte::sim {

/// What the autopilot says to whoever listens, by STATUSTEXT.
struct Notice {
  std::uint8_t severity{};  ///< MAV_SEVERITY
  Text<100> text{};         ///< may be longer than one STATUSTEXT
  friend bool operator==(const Notice&, const Notice&) = default;
};

/// This item of the mission is done: MISSION_ITEM_REACHED.
struct ItemReached {
  std::uint16_t item{};
  friend bool operator==(const ItemReached&, const ItemReached&) = default;
};

/// What a flight has to tell, in the order in which it happened.
using FlightFact = std::variant<Notice, ItemReached>;

/// Formats without allocation; what is too long is cut.
template <class... Args>
[[nodiscard]] Notice notice(std::uint8_t severity, fmt::format_string<Args...> format, Args&&... args) {
  Notice result{.severity = severity};
  auto& chars = result.text.chars();
  fmt::format_to_n(chars.data(), chars.size(), format, std::forward<Args>(args)...);
  return result;
}

}  // namespace ponte::sim
