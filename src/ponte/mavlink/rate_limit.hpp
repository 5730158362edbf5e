#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace ponte::mavlink {

/// Lets so many messages per second through of each sender, evenly, and on average as many as that if there are more.
/// After a pause two may come together.
class RateLimit {
 public:
  /// Senders that are told apart at a time. While all of them are busy, further ones are never let through.
  static constexpr std::size_t sender_limit = 64;

  /// `pause` between two; nothing: none gets through.
  explicit RateLimit(std::optional<Duration> pause) : pause_{pause} {}

  /// Whether a message that is there now gets through.
  [[nodiscard]] bool admits(Timestamp now, SystemId system, ComponentId component);

 private:
  struct Sender {
    SystemId system{};
    ComponentId component{};
    Timestamp next{};
  };

  std::optional<Duration> pause_;
  std::array<Sender, sender_limit> senders_{};
  std::size_t size_{};
};

}  // namespace ponte::mavlink
