#pragma once

#include "ponte/planning/problem.hpp"

#include <cstdint>
#include <span>

namespace ponte::planning {

/// A cost of 2^-20 of the unit of the problem.
using Ticks = std::int64_t;

/// Infinite costs, which say that there is no way, become `no_way`: more than any route may cost, and eight thousand of
/// it still fit into 63 bits.
[[nodiscard]] Ticks ticks(double cost);
inline constexpr Ticks no_way = Ticks{1} << 50U;

/// Stops, and after them one home for each vehicle, which stands for its start and its ends.
using Node = std::uint32_t;

/// The legs of a problem as the solvers want them: whole ticks, the visit at the end of a leg included, and both ends
/// of a vehicle's route in one node. What has no way costs more than any route may.
class Legs {
 public:
  explicit Legs(const Problem& problem);

  [[nodiscard]] Node stops() const { return static_cast<Node>(stops_.size()); }
  [[nodiscard]] Node vehicles() const { return static_cast<Node>(vehicles_.size()); }
  [[nodiscard]] Node home(Node vehicle) const { return stops() + vehicle; }
  /// What the route of this vehicle may cost.
  [[nodiscard]] Ticks limit(Node vehicle) const { return vehicles_[vehicle].limit; }
  [[nodiscard]] bool may_visit(Node vehicle, Node stop) const {
    return stops_[stop].quality_needed <= vehicles_[vehicle].quality;
  }
  /// In ticks too.
  [[nodiscard]] Ticks priority(Node stop) const { return stops_[stop].priority; }

  /// From node to node with this vehicle; of homes only its own.
  [[nodiscard]] Ticks operator()(Node vehicle, Node from, Node to) const {
    const auto& v = vehicles_[vehicle];
    if (from >= stops()) return to >= stops() ? 0 : v.from_start[to];
    if (to >= stops()) return v.to_end[from];
    return classes_[v.costs][std::size_t{from} * stops() + to];
  }
  /// The way between two stops, without the visit: in the cheaper direction for the cheapest class of vehicles.
  [[nodiscard]] Ticks distance(Node a, Node b) const;

 private:
  struct StopFacts {
    Ticks service{};
    Ticks priority{};
    double quality_needed{};
  };
  struct VehicleFacts {
    std::size_t costs{};
    Ticks limit{};
    double quality{};
    std::vector<Ticks> from_start;
    std::vector<Ticks> to_end;
  };

  std::vector<StopFacts> stops_;
  std::vector<VehicleFacts> vehicles_;
  std::vector<std::vector<Ticks>> classes_;
};

}  // namespace ponte::planning
