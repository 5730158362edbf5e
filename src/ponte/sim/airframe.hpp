#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"
#include "ponte/sim/attitude.hpp"
#include "ponte/sim/battery.hpp"
#include "ponte/sim/geodesy.hpp"
#include "ponte/sim/handling.hpp"

#include <cstdint>
#include <optional>

namespace ponte::sim {

enum class AirframeType : std::uint8_t { copter, plane };

/// Everything that is true of an aircraft at one moment.
struct AirframeState {
  Position position{};
  NorthEastDown velocity{};      ///< m/s over ground
  NorthEastDown acceleration{};  ///< m/s^2, of the velocity: without gravity
  NorthEastDown wind{};          ///< m/s, where the air goes
  Attitude attitude{};
  BodyVector rates{};  ///< rad/s
  bool armed{};
  bool airborne{};
  bool crashed{};     ///< it came down harder than it stands
  double throttle{};  ///< 0 to 1
  BatteryState battery{};
  friend bool operator==(const AirframeState&, const AirframeState&) = default;
};

/// What an accelerometer feels (m/s^2): acceleration and the push against gravity, along the body's axes.
[[nodiscard]] BodyVector specific_force(const AirframeState& state);

/// Where the nose of a copter points.
struct Facing {
  std::optional<Radians> heading{};
  std::optional<RadiansPerSecond> turn_rate{};  ///< clockwise; a heading comes before it
};

/// What is done to an aircraft during one step.
struct Conditions {
  NorthEastDown wind{};            ///< m/s, where the air goes
  NorthEastDown position_error{};  ///< m: where it believes to be, seen from where it is
  bool motors_run{true};
};

/// The body of an aircraft with its flight controller, over flat ground. It goes where it is told, within its limits;
/// who tells it and why is not its business. Places that it is told are steered for by its own belief of where it is.
class Airframe {
 public:
  static constexpr Duration step_length = std::chrono::milliseconds{20};

  virtual ~Airframe() = default;

  virtual void arm() = 0;
  virtual void disarm() = 0;  ///< in the air, it comes down without its motors

  /// From now on, whatever it is doing.
  virtual void handle(const Handling& handling) = 0;

  // Armed only; each of them replaces the one before.
  /// To this altitude over the same place. From the ground, this is to take off.
  virtual void climb_to(Metres altitude_msl) = 0;
  /// To a place, and stays there: a copter stands, a plane circles.
  virtual void fly_to(const Position& target, MetresPerSecond speed) = 0;
  /// Round a place, clockwise seen from above if the radius is positive.
  virtual void circle(const Position& centre, Metres radius, MetresPerSecond speed) = 0;
  /// With this velocity (m/s over ground), until told otherwise. Only copters do; a plane holds.
  virtual void move(const NorthEastDown& velocity) = 0;
  /// Stays here.
  virtual void hold() = 0;
  /// Lies level, keeps its altitude, and goes where the wind takes it: all that can be done without a position.
  virtual void drift() = 0;
  /// Lands at this place, or, without one, where it is soonest.
  virtual void land(const std::optional<Position>& place) = 0;
  /// Lands wherever the wind takes it.
  virtual void sink() = 0;
  /// Turns the nose instead of letting it follow the course, until the next of the orders above. Only copters do.
  virtual void face(const Facing& facing) = 0;

  /// The battery loses all but this share of its capacity at once, unless it has less.
  virtual void lose_charge(double all_but) = 0;

  /// Lets `step_length` go by.
  virtual void step(const Conditions& conditions) = 0;

  [[nodiscard]] virtual const AirframeState& state() const = 0;
  /// Where it believes to be.
  [[nodiscard]] virtual Position known_position() const = 0;
  /// Where it is going, as it was told. While it lands the altitude means nothing.
  [[nodiscard]] virtual const Position& target() const = 0;
};

}  // namespace ponte::sim
