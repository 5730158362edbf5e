#pragma once

namespace ponte::sim {

/// What a battery is made of. The defaults are a pack of four lithium cells that keeps the copter up for about an hour.
struct BatteryConfig {
  double capacity_ampere_hours{20};
  double full_volts{16.8};
  double empty_volts{14.0};
  double resistance_ohms{0.01};
};

struct BatteryState {
  double volts{};  ///< at the terminals, under load
  double amperes{};
  double consumed_ampere_hours{};
  double consumed_joules{};
  double remaining{1};  ///< of its capacity, 1 to 0
  friend bool operator==(const BatteryState&, const BatteryState&) = default;
};

/// Gives current, and loses charge and voltage by it. An empty battery goes on giving: that nobody notices is for the
/// autopilot's failsafes to prevent.
class Battery {
 public:
  explicit Battery(const BatteryConfig& config);
  void drain(double amperes, double seconds);
  [[nodiscard]] const BatteryState& state() const { return state_; }

 private:
  BatteryConfig config_;
  BatteryState state_;
};

}  // namespace ponte::sim
