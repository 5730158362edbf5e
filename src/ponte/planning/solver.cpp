#include "ponte/planning/solver.hpp"

#include "ponte/planning/annealing.hpp"
#include "ponte/planning/ruin_and_recreate.hpp"
#include "ponte/planning/tour_search.hpp"

namespace ponte::planning {

std::unique_ptr<Solver> make_solver(const Problem& problem, Method method, std::uint64_t seed) {
  if (method == Method::annealing) return std::make_unique<Annealing>(problem, seed);
  if (TourSearch::fits(problem)) return std::make_unique<TourSearch>(problem, seed);
  return std::make_unique<RuinAndRecreate>(problem, seed);
}

}  // namespace ponte::planning
