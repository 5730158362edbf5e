#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace ponte {

/// Text of at most `Capacity` bytes, held in place. What is longer is cut; unused bytes are zero.
template <std::size_t Capacity>
class Text {
 public:
  static constexpr std::size_t capacity = Capacity;

  constexpr Text() = default;
  constexpr Text(std::string_view text)  // NOLINT: a text literal is a text
  {
    std::copy_n(text.begin(), std::min(text.size(), Capacity), chars_.begin());
  }

  /// Up to the first NUL, or all of it.
  [[nodiscard]] constexpr std::string_view view() const {
    return {chars_.data(), static_cast<std::size_t>(std::find(chars_.begin(), chars_.end(), '\0') - chars_.begin())};
  }
  [[nodiscard]] constexpr bool empty() const { return chars_[0] == '\0'; }
  /// Every byte, as on the wire.
  [[nodiscard]] constexpr std::array<char, Capacity>& chars() { return chars_; }
  [[nodiscard]] constexpr const std::array<char, Capacity>& chars() const { return chars_; }

  friend constexpr bool operator==(const Text&, const Text&) = default;

 private:
  std::array<char, Capacity> chars_{};
};

}  // namespace ponte
