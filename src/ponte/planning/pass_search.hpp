#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/cooling.hpp"
#include "ponte/planning/legs.hpp"
#include "ponte/planning/neighbours.hpp"
#include "ponte/planning/pass_problem.hpp"
#include "ponte/planning/solver.hpp"

namespace ponte::planning {

/// Makes a plan better under the true costs of its passes: a short run of stops moves, a part of a route turns round,
/// or two stops change places, as chance names them, and what does not make the plan worse is kept.
class PassSearch final : public Solver {
 public:
  /// Begins with a plan for `problem.problem`. Routes that turn out to be beyond an endurance, or to have no way, lose
  /// the stops of least priority until they hold.
  PassSearch(PassProblem problem, Plan plan, std::uint64_t seed);

  void improve(std::uint64_t tries) override;
  [[nodiscard]] Plan best() const override { return best_; }

 private:
  using Route = std::vector<std::size_t>;
  struct Score {
    Ticks unvisited_priority{};
    double longest{};
    double total{};
  };

  struct Spot {
    std::size_t vehicle{};  ///< as many as there are: nobody's
    std::size_t index{};    ///< in its route
  };
  [[nodiscard]] const Vehicle& vehicle(std::size_t index) const { return problem_.problem.vehicles[index]; }
  [[nodiscard]] bool holds(std::size_t vehicle, const Route& route, double cost) const;
  [[nodiscard]] Plan shortened(Plan plan) const;
  void shorten(std::size_t vehicle, Route& route) const;
  [[nodiscard]] std::vector<double> costs_of(const Plan& plan) const;
  [[nodiscard]] Spot spot_of(std::size_t stop) const;
  [[nodiscard]] std::size_t any_stop();
  void move_run();
  void turn_round();
  void exchange();
  void judge(std::vector<std::pair<std::size_t, Route>> changes);
  [[nodiscard]] Score score(const Plan& plan, const std::vector<double>& costs) const;
  [[nodiscard]] double smooth(const Score& score) const;
  [[nodiscard]] bool is_better(const Score& a, const Score& b) const;

  PassProblem problem_;
  Neighbours near_;
  Random random_;
  Plan plan_;
  std::vector<double> costs_;  ///< of each route
  Score score_;
  Cooling cooling_;
  Plan best_;
  Score best_score_;
};

}  // namespace ponte::planning
