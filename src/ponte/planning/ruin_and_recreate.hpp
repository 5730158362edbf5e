#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/cooling.hpp"
#include "ponte/planning/neighbours.hpp"
#include "ponte/planning/routes.hpp"
#include "ponte/planning/score.hpp"
#include "ponte/planning/solver.hpp"

namespace ponte::planning {

/// Takes strings of stops that lie near one another out of the routes, puts them back where they cost least, and keeps
/// the result when it is better, or not too much worse while the temperature is high. After Christiaens and Vanden
/// Berghe, "Slack induction by string removals for vehicle routing problems", Transportation Science 54(2), 2020. It
/// never reverses a route, so costs may differ by direction.
class RuinAndRecreate final : public Solver {
 public:
  RuinAndRecreate(const Problem& problem, std::uint64_t seed);

  void improve(std::uint64_t tries) override;
  [[nodiscard]] Plan best() const override { return best_; }

 private:
  struct Insertion {
    Node vehicle{Routes::nobody};
    Node behind{};
    double cost{};
  };
  void ruin();
  void remove_string(Node stop, Node longest);
  void recreate();
  void sort_absent();
  [[nodiscard]] Insertion best_insertion(Node stop);
  void consider(Node vehicle, Node behind, Node stop, Insertion& best);
  void judge();

  Legs legs_;
  Neighbours near_;
  Scoring scoring_;
  Random random_;
  Routes routes_;
  Score score_;
  Cooling cooling_;
  Plan best_;
  Score best_score_;
  std::vector<Node> absent_;            ///< stops that this try puts back
  std::vector<char> is_ruined_;         ///< for each vehicle, in this try
  std::uint32_t tries_until_blink_{1};  ///< one possible place for a stop in a hundred is overlooked
};

}  // namespace ponte::planning
