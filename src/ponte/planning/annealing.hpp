#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/cooling.hpp"
#include "ponte/planning/routes.hpp"
#include "ponte/planning/score.hpp"
#include "ponte/planning/solver.hpp"

namespace ponte::planning {

/// Simulated annealing as textbooks tell it, the method of Behnck et al., "A modified simulated annealing algorithm for
/// SUAVs path planning", IFAC-PapersOnLine 48(10), 2015, whose details are not published: a stop moves to a place that
/// chance names, two stops change places, or a part of a route turns round; a worse plan is accepted by chance; the
/// temperature falls by a constant factor, and rises again when it is low. Here to be compared with.
class Annealing final : public Solver {
 public:
  Annealing(const Problem& problem, std::uint64_t seed);

  void improve(std::uint64_t tries) override;
  [[nodiscard]] Plan best() const override { return best_; }

 private:
  void insert_anywhere(Node stop);
  void exchange(Node a, Node b);
  void turn_round(Node first);
  void judge();

  Legs legs_;
  Random random_;
  Routes routes_;
  Scoring scoring_;
  Score score_;
  Cooling cooling_;
  Plan best_;
  Score best_score_;
};

}  // namespace ponte::planning
