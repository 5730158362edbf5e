#pragma once

#include "ponte/sim/config.hpp"
#include "ponte/sim/flight_context.hpp"
#include "ponte/sim/guided_flight.hpp"
#include "ponte/sim/mission_flight.hpp"
#include "ponte/sim/return_flight.hpp"

#include <cstdint>
#include <optional>

namespace ponte::sim {

/// Where in a flight the vehicle is.
enum class LandedState : std::uint8_t { on_ground, in_air, taking_off, landing };

/// What the autopilot wants of its aircraft in each mode. It has a pilot who never touches the sticks: where he would
/// steer, the aircraft keeps its altitude and goes where the wind takes it.
class Flight {
 public:
  Flight(VehicleKind kind, const FlightSettings& settings, bool flies_square, const SquareConfig& square);

  /// As the parameters have them now.
  void set_settings(const FlightSettings& settings) { settings_ = settings; }
  [[nodiscard]] const FlightSettings& settings() const { return settings_; }
  [[nodiscard]] VehicleKind kind() const { return kind_; }

  /// Where the aircraft stands; set again each time it is armed.
  void set_home(const Position& home) { home_ = home; }
  [[nodiscard]] const Position& home() const { return home_; }

  // All that follows happens at `now`, since the start of the autopilot, and tells what happened.

  /// False: not possible now, and the mode stays. A mode without a position, where it needs one, is not entered.
  [[nodiscard]] bool enter(FlightMode mode, Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  /// Begins its mode anew: one that keeps a place gives up whatever it was going to.
  void restart(Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  [[nodiscard]] FlightMode mode() const { return mode_; }
  /// Whether the aircraft knows where it is. Without, it lands where it is, and does not return.
  void set_has_position(bool has_position) { has_position_ = has_position; }

  /// The aircraft has just been armed. To fly the square it goes to GUIDED by itself.
  void on_armed(Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  /// The aircraft has just been disarmed: the next mission begins at its first item.
  void on_disarmed();
  /// To a height above home. False: not in a mode for it (ArduPilot: GUIDED), not armed, not on the ground, or not a
  /// height that it climbs to.
  [[nodiscard]] bool take_off(Metres height, Duration now, Airframe& airframe, Outbox<FlightFact>& facts);

  /// The mission on board, as it is stored, has changed; valid until the next call.
  void set_mission(std::span<const MissionItem> items) { mission_.set_items(items, kind_.personality); }
  [[nodiscard]] const MissionFlight& mission() const { return mission_; }
  /// MISSION_START: enters the mission's mode, and lets it begin on the ground. False: not possible now.
  [[nodiscard]] bool start_mission(Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  /// Goes on with this item of the mission, in the mission's mode at once. False: there is none.
  [[nodiscard]] bool set_current_item(std::uint16_t item, Duration now, Airframe& airframe, Outbox<FlightFact>& facts);

  /// Stays where it is on its way to an item, and flies there after all. False: the mission is not on its way.
  [[nodiscard]] bool pause_mission(Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  [[nodiscard]] bool continue_mission(Duration now, Airframe& airframe, Outbox<FlightFact>& facts);

  /// A setpoint. ArduPilot takes it in GUIDED only, and in the air; PX4 remembers that it came, and flies it in
  /// OFFBOARD. False: not taken.
  [[nodiscard]] bool guide(const GuidedTarget& target, Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  /// DO_REPOSITION: changes the mode to that in which a target is flown and kept (GUIDED, AUTO.LOITER). False: not in
  /// the air, or not possible now.
  [[nodiscard]] bool reposition(const GuidedTarget& target, Duration now, Airframe& airframe,
                                Outbox<FlightFact>& facts);
  /// Round a place, at the radius of the target, in the mode for it.
  [[nodiscard]] bool orbit(const GuidedTarget& target, Duration now, Airframe& airframe, Outbox<FlightFact>& facts);
  /// DO_CHANGE_SPEED: of what is flown from now on.
  void change_speed(MetresPerSecond speed, Duration now, Airframe& airframe, Outbox<FlightFact>& facts);

  /// What to do next, before each step of the aircraft. Disarms what stands on the ground for no purpose.
  void step(Duration now, Airframe& airframe, Outbox<FlightFact>& facts);

  [[nodiscard]] LandedState landed_state(const AirframeState& state) const;
  /// Where it is going; nothing on the ground, while it lands, and in modes without a target.
  [[nodiscard]] std::optional<Position> target(const Airframe& airframe) const;

 private:
  /// What is being done within the mode.
  enum class Leg : std::uint8_t { none, take_off, square, guided, mission, home, land };

  [[nodiscard]] FlightContext context(Duration now, Airframe& airframe, Outbox<FlightFact>& facts) const {
    return {now, kind_, settings_, home_, airframe, facts};
  }
  [[nodiscard]] bool may_enter(FlightMode mode, const FlightContext& flight) const;
  void begin(const FlightContext& flight);
  void begin_mission(const FlightContext& flight);
  void climb(Metres height, const FlightContext& flight);
  [[nodiscard]] bool lead(const GuidedTarget& target, FlightMode mode, const FlightContext& flight);
  void fly(const FlightContext& flight);
  void fly_mission(const FlightContext& flight);
  void fly_square(const FlightContext& flight);
  void land_here(const FlightContext& flight);
  void on_taken_off(const FlightContext& flight);
  void wait_on_ground(const FlightContext& flight);
  void give_up_take_off(const FlightContext& flight);
  void crash(const FlightContext& flight);
  void on_ground_left_or_reached(const FlightContext& flight);
  void disarm(const FlightContext& flight);
  void change_mode(FlightMode mode, const FlightContext& flight);

  VehicleKind kind_;
  FlightSettings settings_;
  bool flies_square_;
  SquareConfig square_;
  Metres height_;  // above home, of take-off and square
  Position home_{};
  bool has_position_{};
  bool lands_blindly_{};  // without a position
  FlightMode mode_{FlightMode::stabilize};
  Leg leg_{Leg::none};
  MissionFlight mission_;
  GuidedFlight guided_;
  ReturnFlight return_;
  std::optional<MetresPerSecond> speed_{};
  bool mission_may_begin_{};  // on the ground: it was told to
  bool was_airborne_{};
  bool has_landed_{};  // after a flight, as opposed to not having begun one
  std::uint8_t corner_{};
  std::optional<Duration> tries_since_{};  // to take off
  Duration idle_since_{};                  // armed, on the ground, with nothing to do
};

}  // namespace ponte::sim
