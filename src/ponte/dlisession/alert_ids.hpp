#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ponte::dlisession {

/// Numbers alerts by their text class, so that a repeated text is the same alert: the numbers in a text do not count.
/// The first instance carries the negative of the id, later ones the id (Edition 2 table of #1100, carried over).
class AlertIds {
 public:
  /// How many classes are remembered; the oldest is forgotten first, and would begin anew.
  static constexpr std::size_t capacity = 256;

  [[nodiscard]] std::int32_t id_for(std::string_view text);

 private:
  std::array<std::int32_t, capacity> seen_{};
  std::size_t next_{};
};

}  // namespace ponte::dlisession
