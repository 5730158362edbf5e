#include "ponte/sim/battery.hpp"

#include <algorithm>

namespace ponte::sim {

Battery::Battery(const BatteryConfig& config) : config_{config} {
  set_charge(config.capacity_ampere_hours);
  state_.volts = config.full_volts;
}

void Battery::drain(double amperes, double seconds) {
  state_.amperes = amperes;
  state_.consumed_ampere_hours += amperes * seconds / 3600;
  set_charge(state_.left_ampere_hours - amperes * seconds / 3600);
  const double at_rest = config_.empty_volts + (config_.full_volts - config_.empty_volts) * state_.remaining;
  state_.volts = at_rest - amperes * config_.resistance_ohms;
  state_.consumed_joules += state_.volts * amperes * seconds;
}

void Battery::lose_all_but(double share) {
  set_charge(std::min(state_.left_ampere_hours, share * config_.capacity_ampere_hours));
}

void Battery::set_charge(double ampere_hours) {
  state_.left_ampere_hours = std::max(0.0, ampere_hours);
  state_.remaining = state_.left_ampere_hours / config_.capacity_ampere_hours;
}

}  // namespace ponte::sim
