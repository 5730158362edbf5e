#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/legs.hpp"
#include "ponte/planning/neighbours.hpp"
#include "ponte/planning/pass_problem.hpp"
#include "ponte/planning/solver.hpp"

#include <tuple>

namespace ponte::planning {

/// Makes a plan better under the true costs of its passes: a short run of stops moves, a part of a route turns round,
/// or two stops change places, as chance names them, and what does not make the plan worse is kept.
class PassSearch final : public Solver {
 public:
  /// Begins with a plan for `problem.problem`. Routes that turn out to be beyond an endurance, or to have no way, lose
  /// the stops of least priority until they hold.
  PassSearch(PassProblem problem, Plan plan, std::uint64_t seed);

  void improve(std::uint64_t tries) override;
  [[nodiscard]] Plan best() const override { return plan_; }

 private:
  using Route = std::vector<std::size_t>;
  using Score = std::tuple<Ticks, double, double>;  ///< priority left out, then by the objective

  struct Spot {
    std::size_t vehicle{};  ///< as many as there are: nobody's
    std::size_t index{};    ///< in its route
  };
  [[nodiscard]] const Vehicle& vehicle(std::size_t index) const { return problem_.problem.vehicles[index]; }
  [[nodiscard]] bool holds(std::size_t vehicle, const Route& route, double cost) const;
  void shorten(std::size_t vehicle);
  [[nodiscard]] Spot spot_of(std::size_t stop) const;
  [[nodiscard]] std::size_t any_stop();
  void move_run();
  void turn_round();
  void exchange();
  void judge(std::vector<std::pair<std::size_t, Route>> changes);
  [[nodiscard]] Score score(const Plan& plan, const std::vector<double>& costs) const;

  PassProblem problem_;
  Neighbours near_;
  Random random_;
  Plan plan_;
  std::vector<double> costs_;  ///< of each route
  Score score_;
};

}  // namespace ponte::planning
