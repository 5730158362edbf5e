#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"
#include "ponte/sim/attitude.hpp"
#include "ponte/sim/battery.hpp"
#include "ponte/sim/geodesy.hpp"

namespace ponte::sim {

/// What a copter is able to do.
struct CopterConfig {
  MetresPerSecond climb_rate{2.5};
  MetresPerSecond descent_rate{1.5};
  MetresPerSecond landing_rate{0.5};  ///< over the last ten metres
  MetresPerSecondSquared acceleration{2.5};
  MetresPerSecondSquared vertical_acceleration{1.5};
  RadiansPerSecond turn_rate{1.0};
  BatteryConfig battery{};
};

/// Everything that is true of a copter at one moment.
struct CopterState {
  Position position{};
  NorthEastDown velocity{};      ///< m/s over ground
  NorthEastDown acceleration{};  ///< m/s^2, of the velocity: without gravity
  Attitude attitude{};
  BodyVector rates{};  ///< rad/s
  bool armed{};
  bool airborne{};
  double throttle{};  ///< 0 to 1
  BatteryState battery{};
  friend bool operator==(const CopterState&, const CopterState&) = default;
};

/// What an accelerometer feels (m/s^2): acceleration and the push against gravity, along the body's axes.
[[nodiscard]] BodyVector specific_force(const CopterState& state);

/// A point mass under rotors that tilt with the body, in still air over flat ground. It goes where it is told, within
/// its limits; who tells it and why is not its business.
class Copter {
 public:
  static constexpr Duration step_length = std::chrono::milliseconds{20};

  /// It stands disarmed on the ground, which has this altitude everywhere.
  Copter(const CopterConfig& config, const Position& place, Radians heading);

  void arm();
  void disarm();  ///< on the ground only

  // Armed only; each of them replaces the one before.
  /// Stops over ground and goes to this altitude. From the ground, this is to take off.
  void climb_to(Metres altitude_msl);
  void fly_to(const Position& target, MetresPerSecond speed);
  /// Stops here.
  void hold();
  /// Stops over ground, then sinks until it stands.
  void land();

  /// Lets `step_length` go by.
  void step();

  [[nodiscard]] const CopterState& state() const { return state_; }
  /// Where it is going. While it lands the altitude means nothing.
  [[nodiscard]] const Position& target() const { return target_; }

 private:
  enum class Goal : unsigned char { rest, reach, land };

  void stop_at(Metres altitude_msl);
  [[nodiscard]] NorthEastDown wanted_velocity(const NorthEastDown& offset) const;
  [[nodiscard]] double wanted_sink_rate(double offset_down) const;
  void accelerate(const NorthEastDown& wanted);
  void turn(const NorthEastDown& offset);
  void tilt(const Attitude& before);
  void touch_down();
  void use_energy();

  CopterConfig config_;
  double ground_;  // m above mean sea level
  Battery battery_;
  CopterState state_;
  Goal goal_{Goal::rest};
  Position target_;
  double speed_limit_{};
  double heading_wanted_{};
  double turn_rate_{};
};

}  // namespace ponte::sim
