#pragma once

namespace ponte::sim {

/// What a battery is made of. The defaults are a pack of three lithium cells that keeps the copter up for about an
/// hour, and that ArduPilot calls low at the voltage of its defaults.
struct BatteryConfig {
  double capacity_ampere_hours{20};
  double full_volts{12.6};
  double empty_volts{10.1};
  double resistance_ohms{0.01};
};

struct BatteryState {
  double volts{};  ///< at the terminals, under load
  double amperes{};
  double consumed_ampere_hours{};
  double consumed_joules{};
  double left_ampere_hours{};
  double remaining{1};  ///< of its capacity, 1 to 0
  friend bool operator==(const BatteryState&, const BatteryState&) = default;
};

/// Gives current, and loses charge and voltage by it. An empty battery goes on giving: that nobody notices is for the
/// autopilot's failsafes to prevent.
class Battery {
 public:
  explicit Battery(const BatteryConfig& config);
  void drain(double amperes, double seconds);
  /// Loses all but this share of its capacity at once, unless it has less: a cell has died.
  void lose_all_but(double share);
  [[nodiscard]] const BatteryState& state() const { return state_; }

 private:
  void set_charge(double ampere_hours);

  BatteryConfig config_;
  BatteryState state_;
};

}  // namespace ponte::sim
