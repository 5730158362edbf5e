#include "ponte/sim/battery.hpp"

#include <algorithm>

namespace ponte::sim {

Battery::Battery(const BatteryConfig& config) : config_{config} { state_.volts = config.full_volts; }

void Battery::drain(double amperes, double seconds) {
  state_.amperes = amperes;
  state_.consumed_ampere_hours += amperes * seconds / 3600;
  state_.remaining = std::max(0.0, 1 - state_.consumed_ampere_hours / config_.capacity_ampere_hours);
  const double at_rest = config_.empty_volts + (config_.full_volts - config_.empty_volts) * state_.remaining;
  state_.volts = at_rest - amperes * config_.resistance_ohms;
  state_.consumed_joules += state_.volts * amperes * seconds;
}

}  // namespace ponte::sim
