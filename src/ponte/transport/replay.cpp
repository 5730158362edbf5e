#include "ponte/transport/replay.hpp"

#include "ponte/core/assert.hpp"

#include <cstdint>
#include <utility>

namespace ponte::transport {
namespace {

constexpr double slowest = 0.01;
constexpr std::uint64_t longest_gap_us = 3'600'000'000;

/// How long to wait from one record to the next. A damaged recording may tell any two times.
Duration pace(WallTime from, WallTime to, double speed) {
  if (speed == 0 || to < from) return {};
  const auto gap_us = static_cast<std::uint64_t>(unix_us(to)) - static_cast<std::uint64_t>(unix_us(from));
  if (gap_us > longest_gap_us) return {};
  return Duration{static_cast<Duration::rep>(static_cast<double>(gap_us) * 1000 / speed)};
}

}  // namespace

/// Shared with a turn in progress, in which the handler may destroy the replay.
struct Replay::State : std::enable_shared_from_this<Replay::State> {
  State(Loop& its_loop, ReplaySource its_source, double its_speed, LinkHandler& its_handler)
      : loop{its_loop}, source{std::move(its_source)}, speed{its_speed}, handler{its_handler} {
    PONTE_ASSERT(speed == 0 || speed >= slowest);
  }

  void begin() {
    due = loop.now();
    timer.set(due);
  }

  void go_on() {
    if (!is_up && !open()) return;
    static constexpr int burst = 64;  // then others on the loop get their turn
    for (auto i = 0; i < burst && next && due <= loop.now(); ++i) {
      time = next->time;
      handler.on_datagram(loop.now(), next->bytes, peer);
      if (is_closed) return;
      fetch();
    }
    if (next) {
      timer.set(due);
    } else {
      end();
    }
  }

  /// Returns whether the handler kept the replay.
  bool open() {
    is_up = true;
    handler.on_state(loop.now(), LinkState::up, "replaying");
    if (is_closed) return false;
    handler.on_peer(loop.now(), peer, PeerChange::joined, "recording");
    if (is_closed) return false;
    next = source();
    return true;
  }

  void fetch() {
    next = source();
    if (next) due += pace(time, next->time, speed);
  }

  void end() {
    handler.on_peer(loop.now(), peer, PeerChange::left, "recording");
    if (!is_closed) handler.on_state(loop.now(), LinkState::down, "end of file");
  }

  Loop& loop;
  ReplaySource source;
  double speed;
  LinkHandler& handler;
  std::optional<ReplayRecord> next{};
  Timestamp due{};  ///< of `next`
  WallTime time{};  ///< of the record before
  bool is_up{};
  bool is_closed{};
  Timer timer{loop, [this](Timestamp) { shared_from_this()->go_on(); }};
};

Replay::Replay(Loop& loop, ReplaySource source, double speed, LinkHandler& handler)
    : state_{std::make_shared<State>(loop, std::move(source), speed, handler)} {
  state_->begin();
}

Replay::~Replay() {
  state_->is_closed = true;
  state_->timer.clear();
}

WallTime Replay::record_time() const { return state_->time; }

}  // namespace ponte::transport
