#pragma once

#include "ponte/planning/routes.hpp"

namespace ponte::planning {

/// How good a state of the routes is.
struct Score {
  Ticks unvisited_priority{};
  Ticks longest{};
  Ticks total{};
  /// What annealing compares, in ticks: the total, or a mean of the costs of all routes that the long ones govern.
  double smooth{};
};

/// Scores routes by the objective of a problem.
class Scoring {
 public:
  explicit Scoring(Objective objective) : objective_{objective} {}

  [[nodiscard]] Score score(const Legs& legs, const Routes& routes) const;
  /// What matters in the end: first priority, then the objective, then the total.
  [[nodiscard]] bool is_better(const Score& a, const Score& b) const;

  /// What a route of this cost adds to the score, in a measure whose differences tell good insertions from bad ones.
  [[nodiscard]] double weight(Ticks cost) const;

 private:
  Objective objective_;
public:
  double scale_{0x1p-30};
};

}  // namespace ponte::planning
