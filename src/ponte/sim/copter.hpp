#pragma once

#include "ponte/sim/airframe.hpp"

namespace ponte::sim {

/// What a copter is able to do.
struct CopterConfig {
  MetresPerSecond speed{30};
  MetresPerSecond climb_rate{8};
  MetresPerSecond descent_rate{4};
  MetresPerSecondSquared acceleration{2.5};
  MetresPerSecondSquared vertical_acceleration{1.5};
  RadiansPerSecond turn_rate{1.0};
  Radians lean{radians_from_degrees(30)};  ///< at most: what the wind demands beyond it is not resisted
  BatteryConfig battery{};
};

/// A point mass under rotors that tilt with the body, held back by the air that streams past it.
class Copter final : public Airframe {
 public:
  /// It stands disarmed on the ground, which has this altitude everywhere.
  Copter(const CopterConfig& config, const Position& place, Radians heading);

  void arm() override;
  void disarm() override;
  void handle(const Handling& handling) override;

  void climb_to(Metres altitude_msl) override;
  void fly_to(const Position& target, MetresPerSecond speed) override;
  void circle(const Position& centre, Metres radius, MetresPerSecond speed) override;
  void move(const NorthEastDown& velocity) override;
  void hold() override;
  void drift() override;
  void land(const std::optional<Position>& place) override;
  void sink() override;
  void face(const Facing& facing) override;
  void lose_charge(double all_but) override { battery_.lose_all_but(all_but); }

  void step(const Conditions& conditions) override;

  [[nodiscard]] const AirframeState& state() const override { return state_; }
  [[nodiscard]] Position known_position() const override { return displaced(state_.position, position_error_); }
  [[nodiscard]] const Position& target() const override { return target_; }

 private:
  enum class Goal : unsigned char { rest, reach, circle, move, drift, land, sink };
  /// What the flight controller asks of the rotors, over ground.
  struct Demand {
    NorthEastDown velocity{};      // m/s
    NorthEastDown acceleration{};  // m/s^2, beside that which corrects the velocity
  };

  void begin(Goal goal);
  void stop_at(Metres altitude_msl);
  [[nodiscard]] bool holds_place() const { return goal_ != Goal::drift && goal_ != Goal::sink; }
  [[nodiscard]] Demand demand(const NorthEastDown& offset);
  [[nodiscard]] NorthEastDown allowed(const NorthEastDown& velocity) const;
  [[nodiscard]] Demand on_circle(const NorthEastDown& offset) const;
  [[nodiscard]] double wanted_sink_rate(const NorthEastDown& offset);
  [[nodiscard]] double reaching_sink_rate(double offset_down) const;
  void accelerate(const Demand& demand, bool motors_run);
  void turn(const NorthEastDown& offset);
  void tilt(const Attitude& before);
  void touch_down();
  void use_energy();

  CopterConfig config_;
  Handling handling_{};
  double ground_;  // m above mean sea level
  Battery battery_;
  AirframeState state_;
  NorthEastDown position_error_{};
  NorthEastDown thrust_{};  // m/s^2, beside that which carries the weight
  Goal goal_{Goal::rest};
  Position target_;
  NorthEastDown velocity_wanted_{};
  double radius_{};  // m, clockwise if positive
  double speed_limit_{};
  bool takes_off_{};
  bool sinks_{};  // it stands above the place where it lands
  Facing facing_{};
  double heading_wanted_{};
  double turn_rate_{};
};

}  // namespace ponte::sim
