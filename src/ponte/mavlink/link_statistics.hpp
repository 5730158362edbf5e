#pragma once

#include "ponte/mavlink/message_info.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ponte::mavlink {

/// What one sender's sequence numbers tell about one link.
struct SenderStatistics {
  SystemId system{};
  ComponentId component{};
  std::uint8_t last_sequence{};  ///< the newest
  std::uint64_t received{};      ///< every frame, duplicates and late ones included
  std::uint64_t missed{};        ///< sum of the gaps in the sequence numbers, modulo 256
  std::uint64_t late{};          ///< arrived behind a newer one: they are in `missed` as well
  std::uint64_t duplicates{};    ///< arrived before already
  std::uint32_t recent{1};       ///< bit n: the frame n before the newest has been received

  [[nodiscard]] std::uint64_t lost() const { return missed - late; }
};

/// Counts what gets lost on one link, for each sender on it, from the 8-bit sequence numbers. Behind routers and on
/// merged links the numbers have gaps that are no losses, so use one object per link and name the link with the result.
///
/// A number up to 31 before the newest is taken for a late or repeated frame, any other step for a gap: 224 losses in a
/// row, or a restart of the sender, may therefore look like late frames for a moment.
///
/// Senders beyond the capacity are only counted together, so that invented ids make nothing grow.
class LinkStatistics {
 public:
  static constexpr std::size_t capacity = 64;

  void on_frame(SystemId system, ComponentId component, std::uint8_t sequence);

  /// Sorted by system, then component. Valid until the next frame.
  [[nodiscard]] std::span<const SenderStatistics> senders() const { return std::span{senders_}.first(size_); }
  /// Frames of senders that found no place.
  [[nodiscard]] std::uint64_t frames_not_counted() const { return frames_not_counted_; }

 private:
  std::array<SenderStatistics, capacity> senders_{};
  std::size_t size_{};
  std::uint64_t frames_not_counted_{};
};

}  // namespace ponte::mavlink
