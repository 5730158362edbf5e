#pragma once

#include "ponte/autopilot/peer.hpp"
#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What one vehicle last said of its flight, for those who wait for an effect. All of it is asked since a time that
/// they give: what was said before a wish says nothing of what became of the wish.
class FlightWatch {
 public:
  explicit FlightWatch(const Peer& peer) : peer_{peer} {}

  /// True: it was news of the flight.
  bool on_message(Timestamp now, const mavlink::FrameView& frame);
  /// What was said before the vehicle started anew counts no more.
  void forget() { *this = FlightWatch{peer_}; }

  /// A HEARTBEAT with a valid mode has come.
  [[nodiscard]] bool is_heard(Timestamp since) const { return heartbeat_at_ && *heartbeat_at_ > since; }
  [[nodiscard]] bool has_mode(std::uint32_t custom_mode, Timestamp since) const;
  [[nodiscard]] bool has_other_mode(std::uint32_t custom_mode, Timestamp since) const;
  [[nodiscard]] bool is_armed(bool armed, Timestamp since) const;
  /// EXTENDED_SYS_STATE says so, or it is higher than where it was last seen disarmed by `off_the_ground`.
  [[nodiscard]] bool is_in_the_air(Timestamp since) const;

  struct Place {
    Radians latitude{};
    Radians longitude{};
    Metres altitude_msl{};
    Metres height{};  ///< above home
  };
  /// Nothing while it does not know where it is.
  [[nodiscard]] const std::optional<Place>& place() const { return place_; }

 private:
  static constexpr Metres off_the_ground{1};

  Peer peer_;
  std::optional<Timestamp> heartbeat_at_;
  std::uint32_t custom_mode_{};
  bool armed_{};
  std::optional<Timestamp> landed_state_at_;
  std::uint8_t landed_state_{};
  std::optional<Place> place_;
  Timestamp place_at_{};
  Metres ground_{};  // above home, where it last was disarmed
};

}  // namespace ponte::autopilot
