#pragma once

#include "ponte/core/bytes.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace ponte::autopilot {

/// A file that comes in pieces, in any order, some of them not at all at first.
class ReceivedFile {
 public:
  /// A run of bytes that is missing before a later piece.
  struct Gap {
    std::size_t begin{};
    std::size_t end{};
    friend bool operator==(const Gap&, const Gap&) = default;
  };
  static constexpr std::size_t most_gaps = 4096;

  explicit ReceivedFile(std::size_t size_limit) : size_limit_{size_limit} {}

  void clear();
  /// False if the file would be larger than its limit, or have too many gaps.
  [[nodiscard]] bool add(std::size_t offset, Bytes piece);

  /// As far as the furthest piece reaches; zeros where one is missing.
  [[nodiscard]] const std::vector<std::byte>& content() const { return content_; }
  [[nodiscard]] std::optional<Gap> first_gap() const;

 private:
  std::size_t size_limit_;
  std::vector<std::byte> content_;
  std::vector<Gap> gaps_;  ///< in order
};

}  // namespace ponte::autopilot
