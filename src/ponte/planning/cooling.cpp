#include "ponte/planning/cooling.hpp"

#include <cmath>

namespace ponte::planning {

Cooling::Cooling(double hottest, double coldest, std::uint64_t first_steps)
    : hottest_{hottest}, coldest_{coldest}, steps_{first_steps} {
  begin_fall();
}

void Cooling::begin_fall() {
  left_ = steps_;
  temperature_ = hottest_;
  factor_ = std::pow(coldest_ / hottest_, 1.0 / static_cast<double>(steps_));
}

bool Cooling::step() {
  temperature_ *= factor_;
  if (--left_ > 0) return false;
  steps_ *= 2;
  begin_fall();
  return true;
}

}  // namespace ponte::planning
