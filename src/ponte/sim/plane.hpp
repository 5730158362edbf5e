#pragma once

#include "ponte/sim/airframe.hpp"

namespace ponte::sim {

/// What a plane is able to do.
struct PlaneConfig {
  MetresPerSecond least_airspeed{12};  ///< it leaves the ground above it
  MetresPerSecond cruise_airspeed{22};
  MetresPerSecond most_airspeed{30};
  MetresPerSecondSquared acceleration{4};
  MetresPerSecond climb_rate{5};
  MetresPerSecond descent_rate{4};
  Radians bank{radians_from_degrees(45)};
  RadiansPerSecond roll_rate{1.2};
  Metres loiter_radius{60};  ///< until its handling says another
  BatteryConfig battery{};
};

/// A point mass on wings: it turns by banking, flies on with the wind, and never stands still in the air. It needs no
/// runway but its heading: from the ground it runs ahead until it flies, and after landing it rolls to a stop.
class Plane final : public Airframe {
 public:
  /// It stands disarmed on the ground, which has this altitude everywhere.
  Plane(const PlaneConfig& config, const Position& place, Radians heading);

  void arm() override;
  void disarm() override;
  void handle(const Handling& handling) override;

  void climb_to(Metres altitude_msl) override;
  /// Along the line from here. Once past it, it circles.
  void fly_to(const Position& target, MetresPerSecond airspeed) override;
  void circle(const Position& centre, Metres radius, MetresPerSecond airspeed) override;
  void move(const NorthEastDown& velocity) override;
  void hold() override;
  void drift() override;
  /// On a straight slope from here, and into the direction from here; too steep a slope makes it land beyond.
  void land(const std::optional<Position>& place) override;
  void sink() override;
  void face(const Facing& facing) override;
  void lose_charge(double all_but) override { battery_.lose_all_but(all_but); }

  void step(const Conditions& conditions) override;

  [[nodiscard]] const AirframeState& state() const override { return state_; }
  [[nodiscard]] Position known_position() const override { return displaced(state_.position, position_error_); }
  [[nodiscard]] const Position& target() const override { return target_; }

 private:
  enum class Goal : unsigned char { rest, take_off, reach, circle, drift, land, sink };
  /// What the flight controller asks of wings and engine.
  struct Demand {
    double bank{};      // rad
    double climb{};     // m/s
    double airspeed{};  // m/s
  };

  void begin(Goal goal);
  [[nodiscard]] double height() const { return state_.position.altitude_msl.value - ground_; }
  [[nodiscard]] double course() const;

  // plane_guidance.cpp
  [[nodiscard]] Demand demand(bool motor_runs);
  [[nodiscard]] double bank_for(double course_wanted, double turn_rate) const;
  [[nodiscard]] double bank_along_line() const;
  [[nodiscard]] double bank_round_circle() const;
  [[nodiscard]] double climb_to_target() const;
  [[nodiscard]] double climb_on_slope() const;

  void fly(const Demand& demand);
  void roll_on_ground(bool motor_runs);
  void touch_down();
  void use_energy(bool motor_runs);

  PlaneConfig config_;
  Handling handling_;
  double ground_;  // m above mean sea level
  Battery battery_;
  AirframeState state_;
  NorthEastDown position_error_{};
  Goal goal_{Goal::rest};
  Position target_;
  Position from_;  // where the line to the target begins
  double radius_{};
  double airspeed_wanted_{};
  double airspeed_{};      // m/s
  double climb_{};         // m/s
  double ground_speed_{};  // m/s, on the wheels
};

}  // namespace ponte::sim
