#pragma once

#include "ponte/planning/problem.hpp"

#include <cstdint>
#include <memory>

namespace ponte::planning {

/// Makes a plan better and better. Knows no clock: the caller decides how often it may try, and may stop at any time.
/// The same problem, seed and number of tries give the same plan on every machine.
class Solver {
 public:
  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  virtual ~Solver() = default;

  /// Tries this many changes.
  virtual void improve(std::uint64_t tries) = 0;
  /// The best plan so far; it holds every constraint from the first moment on.
  [[nodiscard]] virtual Plan best() const = 0;
};

enum class Method {
  best,       ///< what Ponte does best: a tour search where the problem is one plain tour, else ruin and recreate
  annealing,  ///< simulated annealing after Behnck et al.
};

/// A solver for a problem that `check` accepts; the solver keeps a copy of what it needs.
[[nodiscard]] std::unique_ptr<Solver> make_solver(const Problem& problem, Method method, std::uint64_t seed);

}  // namespace ponte::planning
