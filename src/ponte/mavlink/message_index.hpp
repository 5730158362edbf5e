#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ponte::mavlink {

/// Finds the messages of a dialect by id, the low ids in constant time. It is small enough to be part of each parser.
/// The dialect must outlive it.
class MessageIndex {
 public:
  explicit MessageIndex(const Dialect& dialect);

  /// The message in this frame, or nothing.
  [[nodiscard]] const MessageInfo* find(const FrameView& frame) const {
    return frame.version == Version::v0_9 ? find_message(*dialect_, frame) : find(frame.message);
  }

  /// The message of MAVLink 1 and 2 with this id, or nothing.
  [[nodiscard]] const MessageInfo* find(MessageId id) const {
    if (id.value >= low_ids) return dialect_->find(id);
    const auto word = present_[id.value / 64];
    const auto bit = std::uint64_t{1} << (id.value % 64);
    if ((word & bit) == 0) return nullptr;
    return dialect_->messages[before_[id.value / 64] + count_ones(word & (bit - 1))];
  }

 private:
  static constexpr std::size_t low_ids = 384;

  // std::popcount is a slow library call on processors that are not known to count bits by themselves.
  static constexpr std::size_t count_ones(std::uint64_t word) {
    word -= (word >> 1U) & 0x5555'5555'5555'5555;
    word = (word & 0x3333'3333'3333'3333) + ((word >> 2U) & 0x3333'3333'3333'3333);
    word = (word + (word >> 4U)) & 0x0F0F'0F0F'0F0F'0F0F;
    return static_cast<std::size_t>((word * 0x0101'0101'0101'0101) >> 56U);
  }

  // A bit for each low id that exists. As the messages are sorted by id, counting the bits before one gives its place.
  const Dialect* dialect_;
  std::array<std::uint64_t, low_ids / 64> present_{};
  std::array<std::uint16_t, low_ids / 64> before_{};
};

}  // namespace ponte::mavlink
