#pragma once

#include "ponte/sim/config.hpp"
#include "ponte/sim/copter.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace ponte::sim {

/// The modes of ArduCopter that are flown here, by their HEARTBEAT.custom_mode.
enum class FlightMode : std::uint8_t { stabilize = 0, automatic = 3, guided = 4, loiter = 5, rtl = 6, land = 9 };

/// The mode with this number, or nothing.
[[nodiscard]] std::optional<FlightMode> flight_mode(std::uint32_t custom_mode);
/// As ArduCopter calls it: "RTL".
[[nodiscard]] std::string_view name_of(FlightMode mode);

/// Where in a flight the vehicle is.
enum class LandedState : std::uint8_t { on_ground, in_air, taking_off, landing };

/// What the autopilot wants of the copter in each mode. It has a pilot who never touches the sticks: STABILIZE and
/// LOITER hold the place.
class Flight {
 public:
  Flight(bool flies_square, const SquareConfig& square)
      : flies_square_{flies_square}, square_{square}, height_{square.height} {}

  /// Where the copter stands; set again each time it is armed.
  void set_home(const Position& home) { home_ = home; }
  [[nodiscard]] const Position& home() const { return home_; }

  /// False: not possible now, and the mode stays. Whether there is a position is for the caller to know.
  [[nodiscard]] bool enter(FlightMode mode, Copter& copter);
  [[nodiscard]] FlightMode mode() const { return mode_; }

  /// The copter has just been armed. To fly the square it goes to GUIDED by itself.
  void on_armed(Copter& copter);
  /// To a height above home, which becomes that of the square. False: not in GUIDED, not armed, not on the ground, or
  /// not a height that it climbs to.
  [[nodiscard]] bool take_off(Metres height, Copter& copter);

  /// What to do next, before each step of the copter. Disarms what stands on the ground for no purpose.
  void step(Copter& copter);

  [[nodiscard]] LandedState landed_state(const CopterState& state) const;
  /// Where it is going; nothing on the ground, while it lands, and in modes without a target.
  [[nodiscard]] std::optional<Position> target(const Copter& copter) const;

 private:
  /// What is being done within the mode.
  enum class Leg : std::uint8_t { none, take_off, square, rise, cross, descend };

  void wait_on_ground(Copter& copter);
  void fly_square(Copter& copter);
  void rise(Copter& copter);
  void cross(Copter& copter);

  bool flies_square_;
  SquareConfig square_;
  Metres height_;  // above home, of take-off and square
  Position home_{};
  FlightMode mode_{FlightMode::stabilize};
  Leg leg_{Leg::none};
  std::uint8_t corner_{};
  Metres return_altitude_{};
  std::uint32_t idle_steps_{};  // armed, on the ground, with nothing to do
};

}  // namespace ponte::sim
