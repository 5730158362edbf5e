#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/time.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace ponte::transport {

/// What was received at a time.
struct ReplayRecord {
  WallTime time{};
  Bytes bytes{};  ///< valid until the source is asked for the next
};

/// Returns the next record, nothing at the end; is not asked again then.
using ReplaySource = std::function<std::optional<ReplayRecord>()>;

/// Gives a recording to a handler as if it happened now: `up`, one peer, a datagram per record at the pace of the
/// recording, the peer leaves, `down` with the reason "end of file".
///
/// The pace is that of the times from record to record. Where they step back, or ahead by more than an hour, a clock
/// was set or a flight ended: the next record follows at once.
class Replay {
 public:
  /// The only peer.
  static constexpr PeerId peer{1};

  /// Begins when the loop next runs. At speed 2 it takes half the time, 0.01 is the slowest; at speed 0 records follow
  /// each other as fast as they are handled, while the loop stays attentive to others. The loop and the handler outlive
  /// the replay, which a handler may destroy.
  Replay(Loop& loop, ReplaySource source, double speed, LinkHandler& handler);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// When the present record, or the latest, was recorded; the epoch before the first.
  [[nodiscard]] WallTime record_time() const;

 private:
  struct State;

  std::shared_ptr<State> state_;
};

}  // namespace ponte::transport
