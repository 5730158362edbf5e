#pragma once

#include "ponte/core/time.hpp"
#include "ponte/sim/geodesy.hpp"
#include "ponte/sim/personality.hpp"

#include <cstdint>
#include <optional>

namespace ponte::sim {

/// What an autopilot knows of where it is: by satellites, and for a while without them, worse and worse.
class Navigation {
 public:
  /// It knows its position so long after its start at the earliest. The seed says to where its belief drifts.
  Navigation(Personality personality, Duration position_after, std::uint64_t seed);

  /// Each step, with the time since the start of the autopilot.
  void step(Duration since_boot, bool hears_satellites);

  /// It trusts its position.
  [[nodiscard]] bool has_position() const { return has_position_; }
  /// It knew its position once, whether or not it still does.
  [[nodiscard]] bool ever_had_position() const { return had_position_; }
  /// Metres from where it is to where it believes to be.
  [[nodiscard]] const NorthEastDown& error() const { return error_; }

 private:
  Duration position_after_;
  Duration trusts_itself_for_;
  double drift_direction_;
  std::optional<Duration> silent_since_{};  // the satellites
  Duration heard_since_{};
  bool has_position_{};
  bool had_position_{};
  NorthEastDown error_{};
};

}  // namespace ponte::sim
