#pragma once

#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/voice.hpp"
#include "ponte/core/time.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What is known of a vehicle's clock, all of one exchange.
struct ClockReading {
  Duration offset{};      ///< the vehicle's time (since its boot, mostly) less ours
  Duration round_trip{};  ///< of the exchange: the offset is wrong by half of it at the most
  friend bool operator==(const ClockReading&, const ClockReading&) = default;
};

/// Asks a vehicle for its time by TIMESYNC, and so knows its clock and how long a message takes. The offset is that at
/// the middle between question and answer, of the fastest of the last exchanges, since delays only make it worse. A
/// vehicle whose clock cannot be what it was has started anew, and is measured afresh.
class TimeSync {
 public:
  static constexpr std::size_t window = 16;
  static constexpr Duration interval = std::chrono::seconds{2};
  static constexpr Duration interval_at_first = std::chrono::milliseconds{200};  ///< until there are some readings
  static constexpr std::size_t readings_at_first = 5;
  static constexpr Duration longest_round_trip = std::chrono::seconds{5};
  /// Two cheap crystals drift apart by less than this in the time of a window.
  static constexpr Duration drift = std::chrono::milliseconds{10};

  explicit TimeSync(const Peer& peer) : peer_{peer} {}

  /// Any frame with the right checksum; those of others, and answers to others, are passed over.
  void on_message(Timestamp now, const mavlink::FrameView& frame);
  void on_tick(Timestamp now, Voice& voice);
  /// When `on_tick` next has something to do.
  [[nodiscard]] Timestamp next_deadline() const { return next_question_; }
  /// The vehicle has started anew: nothing is known.
  void on_reboot() { forget(); }

  /// The best of the last exchanges.
  [[nodiscard]] std::optional<ClockReading> best() const;
  /// Of the last exchange, and smoothed over those before it: SRTT = 7/8 SRTT + 1/8 of the new one, as in RFC 6298.
  [[nodiscard]] std::optional<Duration> round_trip() const;
  /// What the vehicle's clock shows at our time.
  [[nodiscard]] std::optional<Duration> vehicle_time(Timestamp now) const;

  [[nodiscard]] std::uint64_t asked() const { return asked_; }
  [[nodiscard]] std::uint64_t answered() const { return answered_; }

 private:
  void forget();
  void keep(const ClockReading& reading);

  Peer peer_;
  Timestamp next_question_{};
  std::array<std::int64_t, 8> questions_{};  // the newest: ts1, our time in ns
  std::array<ClockReading, window> readings_{};
  std::size_t size_{};
  std::size_t next_reading_{};
  std::optional<Duration> round_trip_;
  std::uint64_t asked_{};
  std::uint64_t answered_{};
};

}  // namespace ponte::autopilot
