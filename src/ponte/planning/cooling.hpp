#pragma once

#include <cmath>
#include <cstdint>

namespace ponte::planning {

/// The temperature of annealing without a deadline: it falls from `hottest` through so many halvings, again and again,
/// and each fall takes twice as many steps as the one before. So at whatever moment the caller stops, a fall that took
/// at least a quarter of all steps is complete. Between two halvings the temperature falls in a straight line, for a
/// power's last bit differs between libraries.
class Cooling {
 public:
  /// A temperature of 0 takes no worse plan at all. `first_steps` is above 0.
  Cooling(double hottest, int halvings, std::uint64_t first_steps)
      : hottest_{hottest}, halvings_{halvings}, steps_{first_steps} {}

  [[nodiscard]] double temperature() const {
    const auto fallen = halvings_ * (static_cast<double>(step_) / static_cast<double>(steps_));
    const auto halvings = static_cast<int>(fallen);
    return std::ldexp(hottest_, -halvings) * (1 - (fallen - halvings) / 2);
  }

  void step() {
    if (++step_ < steps_) return;
    step_ = 0;
    steps_ *= 2;
  }

 private:
  double hottest_;
  int halvings_;
  std::uint64_t steps_;
  std::uint64_t step_{};
};

}  // namespace ponte::planning
