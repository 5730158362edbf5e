#pragma once

#include "ponte/core/random.hpp"
#include "ponte/planning/cooling.hpp"
#include "ponte/planning/neighbours.hpp"
#include "ponte/planning/solver.hpp"
#include "ponte/planning/tour.hpp"

namespace ponte::planning {

/// The shortest round trip of one vehicle whose legs cost the same in both directions: chained Lin-Kernighan search. It
/// exchanges two neighbouring pieces of the tour, mends it with Lin-Kernighan moves around the cuts, and goes back when
/// that made it longer. After Applegate, Cook and Rohe, "Chained Lin-Kernighan for large traveling salesman problems",
/// INFORMS Journal on Computing 15(1), 2003.
class TourSearch final : public Solver {
 public:
  /// Whether it can solve this problem: one vehicle with unlimited endurance that may visit every stop, at least eight
  /// stops, ways everywhere, and legs that cost the same in both directions.
  [[nodiscard]] static bool fits(const Problem& problem);

  /// `problem` has to fit.
  TourSearch(const Problem& problem, std::uint64_t seed);

  void improve(std::uint64_t tries) override;
  [[nodiscard]] Plan best() const override;

 private:
  using City = Tour::City;
  struct Move {
    City to{};     ///< what becomes the neighbour of the loose end
    City end{};    ///< the new loose end
    Ticks gain{};  ///< so far, with the tour still open
  };

  [[nodiscard]] Ticks distance(City a, City b) const { return distances_[std::size_t{a} * cities_ + b]; }
  void enqueue(City city);

  [[nodiscard]] Ticks typical_leg() const;
  [[nodiscard]] Ticks kick();
  [[nodiscard]] Ticks mend();
  [[nodiscard]] Ticks improve_city(City city);
  [[nodiscard]] Ticks deepen(City fixed, City end, Ticks gain, std::size_t depth);
  std::size_t find_moves(City fixed, City end, Ticks gain, std::span<Move> moves) const;

  City stops_;
  City cities_;  ///< the stops, the start, and the end when leaving costs another price than coming home
  std::vector<Ticks> distances_;
  Neighbours near_;
  Random random_;
  Tour tour_;
  Cooling cooling_;
  std::vector<City> queue_;  ///< cities around which the tour has changed
  std::vector<char> is_queued_;
  Ticks length_{};  ///< compared with the first tour
  Tour best_;
  Ticks best_length_{};
};

}  // namespace ponte::planning
