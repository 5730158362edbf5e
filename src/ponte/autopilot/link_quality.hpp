#pragma once

#include "ponte/autopilot/peer.hpp"
#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What a telemetry radio says of itself and of the one at the other end (RADIO_STATUS), in the units of the device; on
/// the usual ones (SiK) 2 steps are 1 dB. What it does not know is absent.
struct RadioReading {
  std::optional<std::uint8_t> signal{};         ///< received here
  std::optional<std::uint8_t> remote_signal{};  ///< received there
  std::optional<std::uint8_t> noise{};
  std::optional<std::uint8_t> remote_noise{};
  std::uint8_t free_buffer{};         ///< percent of the transmitter's
  std::uint16_t receive_errors{};     ///< since the radio was switched on
  std::uint16_t corrected_packets{};  ///< likewise
  Timestamp heard{};

  /// Signal above noise at the weaker end, in steps of the device; nothing unless both ends are known.
  [[nodiscard]] std::optional<int> margin() const;
  friend bool operator==(const RadioReading&, const RadioReading&) = default;
};

/// How good the link from one vehicle is, by the gaps in the sequence numbers of its frames during the last `window`.
///
/// In it, `received` frames came that were neither late nor repeated, and the numbers had gaps of `missed` altogether,
/// less what came late after all. loss = missed / (received + missed).
///
/// Behind a router that passes on a part, or where two links are merged, gaps are no losses: use one for each link.
class LinkQuality {
 public:
  static constexpr Duration window = std::chrono::seconds{10};
  /// A number so far behind the newest is late or repeated; any other step is a gap, or a start anew.
  static constexpr unsigned late_limit = 32;

  explicit LinkQuality(const Peer& peer) : peer_{peer} {}

  /// Any frame with the right checksum that came over the link, those of radios too.
  void on_message(Timestamp now, const mavlink::FrameView& frame);
  /// The vehicle has started anew, and its sequence numbers with it.
  void on_reboot() { sequence_.reset(); }

  /// 0 to 100; nothing while no frame has come during the window.
  [[nodiscard]] std::optional<Percent> loss(Timestamp now) const;
  /// Per second, averaged over the window.
  [[nodiscard]] double frames_per_second(Timestamp now) const;
  /// What a radio on the link said last, during the window.
  [[nodiscard]] std::optional<RadioReading> radio(Timestamp now) const;

 private:
  /// Of one second.
  struct Bucket {
    std::int64_t second{-1};
    std::int32_t received{};
    std::int32_t missed{};
  };
  static constexpr std::size_t bucket_count = 10;

  Bucket& bucket_at(Timestamp now);
  [[nodiscard]] Bucket sum(Timestamp now) const;
  void count(Timestamp now, std::uint8_t sequence);

  Peer peer_;
  std::optional<std::uint8_t> sequence_;  // the newest
  std::uint32_t recent_{};                // bit n: the frame n before the newest has come
  std::array<Bucket, bucket_count> buckets_{};
  std::optional<RadioReading> radio_;
};

}  // namespace ponte::autopilot
