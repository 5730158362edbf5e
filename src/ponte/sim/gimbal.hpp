#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"
#include "ponte/sim/attitude.hpp"
#include "ponte/sim/geodesy.hpp"
#include "ponte/sim/speaker.hpp"

#include <cstdint>
#include <optional>

namespace ponte::sim {

/// Where a gimbal points. Pitch counts from the horizon, yaw from the nose.
struct GimbalState {
  bool is_fitted{};
  Radians pitch{};
  Radians yaw{};
  Radians heading{};  ///< of the vehicle that carries it
  RadiansPerSecond pitch_rate{};
  RadiansPerSecond yaw_rate{};
  std::uint16_t flags{};   ///< GIMBAL_DEVICE_FLAGS
  Requester controller{};  ///< who has primary control; 0/0: nobody
};

/// A stabilised gimbal with two axes behind the autopilot, its device 1, which turns as fast as it can to where it is
/// told to point. Whoever has control: it obeys everybody, as ArduPilot's manager does.
class Gimbal {
 public:
  static constexpr Radians lowest{-1.5707963267948966};
  static constexpr Radians highest{0.5235987755982988};
  static constexpr Radians farthest{3.141592653589793};  ///< to either side

  explicit Gimbal(bool is_fitted) { state_.is_fitted = is_fitted; }

  /// Angles and rates, each left as it is if it is not a number; an angle comes before a rate. The flags are
  /// GIMBAL_MANAGER_FLAGS: retract and neutral point ahead, a locked yaw counts from north.
  void point(float pitch, float yaw, float pitch_rate, float yaw_rate, std::uint32_t flags);
  /// At a place, from now on; nothing: ahead.
  void look_at(const std::optional<Position>& place);
  /// DO_GIMBAL_MANAGER_CONFIGURE: who has primary control: an id, -1 leaves it, -2 takes it for the sender, -3 gives it
  /// up if the sender has it.
  void configure(float system, float component, Requester sender);

  /// Once in each step. `place` is where the mission wants it to look.
  void step(const Position& position, const Attitude& vehicle, const std::optional<Position>& place);

  [[nodiscard]] const GimbalState& state() const { return state_; }

 private:
  GimbalState state_;
  std::optional<Position> place_{};
  Radians wanted_pitch_{};
  Radians wanted_yaw_{};  // from the nose, or from north
  bool yaw_is_locked_{};
  double pitch_rate_{};  // rad/s
  double yaw_rate_{};
};

}  // namespace ponte::sim
