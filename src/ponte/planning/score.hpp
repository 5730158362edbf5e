#pragma once

#include "ponte/planning/routes.hpp"

namespace ponte::planning {

/// How good a state of the routes is.
struct Score {
  Ticks unvisited_priority{};
  Ticks longest{};
  Ticks total{};
  /// One number for annealing, in ticks: the total, or a mean of all routes that the longest governs, and the unvisited
  /// stops turned into ticks.
  double smooth{};
};

/// Scores routes by the objective of a problem.
class Scoring {
 public:
  Scoring(Objective objective, const Legs& legs);

  [[nodiscard]] Score score(const Legs& legs, const Routes& routes) const;
  /// What matters in the end: first priority, then the objective, then the total.
  [[nodiscard]] bool is_better(const Score& a, const Score& b) const;
  /// The share that a route of this cost has in the score; a good insertion adds little to it.
  [[nodiscard]] double share(Ticks cost) const;

 private:
  Objective objective_;
  double scale_{};  ///< of the costs, for powers of them have to stay finite
  double ticks_per_priority_{};
};

}  // namespace ponte::planning
