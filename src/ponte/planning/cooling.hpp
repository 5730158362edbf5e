#pragma once

#include <cstdint>

namespace ponte::planning {

/// The temperature of annealing without a deadline: it falls from `hottest` to `coldest`, by the same factor at each
/// step, again and again; each fall takes twice as many steps as the one before. So at whatever moment the caller
/// stops, a fall that took at least a quarter of all steps is complete.
class Cooling {
 public:
  Cooling(double hottest, double coldest, std::uint64_t first_steps);

  [[nodiscard]] double temperature() const { return temperature_; }
  /// One step further. True when a fall has just ended, and the next begins at the top.
  bool step();

 private:
  void begin_fall();

  double hottest_;
  double coldest_;
  std::uint64_t steps_;
  std::uint64_t left_{};
  double temperature_{};
  double factor_{};
};

}  // namespace ponte::planning
