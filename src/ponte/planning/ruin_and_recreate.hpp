#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/cooling.hpp"
#include "ponte/planning/neighbours.hpp"
#include "ponte/planning/routes.hpp"
#include "ponte/planning/score.hpp"
#include "ponte/planning/solver.hpp"

#include <optional>

namespace ponte::planning {

/// Solves every problem. Takes strings of stops that lie near one another out of the routes, puts them back where they
/// cost least, and keeps the result when it is better, or not too much worse while the temperature is high. It never
/// reverses a route, so costs may differ by direction. After Christiaens and Vanden Berghe, "Slack induction by string
/// removals for vehicle routing problems", Transportation Science 54(2), 2020.
class RuinAndRecreate final : public Solver {
 public:
  RuinAndRecreate(const Problem& problem, std::uint64_t seed);

  void improve(std::uint64_t tries) override;
  [[nodiscard]] Plan best() const override { return best_; }

 private:
  struct Insertion {
    Node vehicle{};
    Node behind{};
    double cost{};
  };
  void ruin();
  void remove_string(Node stop, Node longest);
  void recreate();
  void sort_absent();
  [[nodiscard]] std::optional<Insertion> best_insertion(Node stop);
  void judge();

  Legs legs_;
  Neighbours near_;
  Random random_;
  Routes routes_;
  Scoring scoring_;
  Score score_;
  Cooling cooling_;
  Plan best_;
  Score best_score_;
  std::vector<Node> absent_;               ///< the stops that this try puts back
  std::vector<char> is_absent_;            ///< for each stop
  std::vector<Ticks> from_nearest_start_;  ///< for each stop
  std::uint32_t until_blink_{1};           ///< one place for a stop in about a hundred is overlooked
};

}  // namespace ponte::planning
