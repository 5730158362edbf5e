#pragma once

#include "ponte/core/result.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Points of interest in, ordered routes out.
namespace ponte::planning {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Costs are counted in whole ticks of 2^-20, so that sums are exact and the same on every machine; this is the highest
/// finite one, 17 years of seconds.
inline constexpr double highest_cost = 0x1p29;
inline constexpr double lowest_priority = 0x1p-10;
inline constexpr double highest_priority = 0x1p20;

/// What each leg costs, usually in seconds. Both directions of a leg may differ, as wind makes them. An infinite cost
/// says that there is no way.
class CostMatrix {
 public:
  explicit CostMatrix(std::size_t places) : places_{places}, costs_(places * places) {}

  [[nodiscard]] std::size_t places() const { return places_; }
  [[nodiscard]] double& operator()(std::size_t from, std::size_t to) { return costs_[from * places_ + to]; }
  [[nodiscard]] double operator()(std::size_t from, std::size_t to) const { return costs_[from * places_ + to]; }

 private:
  std::size_t places_;
  std::vector<double> costs_;
};

/// A place that wants one visit.
struct Stop {
  double service{};         ///< how long the visit takes, in the unit of the costs
  double priority{1};       ///< what it is worth to visit it, from `lowest_priority` to `highest_priority`
  double quality_needed{};  ///< only a vehicle whose sensor is at least as good may visit it
};

struct Vehicle {
  std::size_t costs{};            ///< which of `Problem::costs` holds for it
  std::size_t start{};            ///< the place where it begins
  std::vector<std::size_t> ends;  ///< it ends at the cheapest of these places; at its last stop when there are none
  double endurance{unlimited};    ///< what its whole route may cost, visits included
  double quality{};               ///< of its sensor
};

/// What is made small, after as little priority as possible stays unvisited.
enum class Objective {
  total,    ///< the sum of the costs of all routes
  longest,  ///< the cost of the costliest route, then the sum
};

/// Stop number i is place number i; the places after the stops are starts and ends of routes.
struct Problem {
  std::vector<Stop> stops;
  std::vector<Vehicle> vehicles;
  std::vector<CostMatrix> costs;  ///< one for each class of vehicles
  Objective objective{Objective::total};
};

/// Refuses, in words, what is no problem to solve: no vehicle, a place that does not exist, a negative or NaN number, a
/// cost or an endurance of more than `highest_cost`.
[[nodiscard]] Result<void, std::string> check(const Problem& problem);

/// The stops of each vehicle in the order of their visits; a stop that is in no route stays unvisited.
struct Plan {
  std::vector<std::vector<std::size_t>> routes;
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// What one vehicle's route costs, its way to the cheapest end included; nothing when it has no stops, infinite when
/// there is no way.
[[nodiscard]] double route_cost(const Problem& problem, const Vehicle& vehicle, const std::vector<std::size_t>& route);

/// From this stop to the cheapest of the vehicle's ends; nothing when its route ends at its last stop.
[[nodiscard]] double cost_to_end(const CostMatrix& costs, const Vehicle& vehicle, std::size_t stop);

/// Where the route ends: one of the vehicle's ends, or its last stop.
[[nodiscard]] std::size_t route_end(const Problem& problem, const Vehicle& vehicle,
                                    const std::vector<std::size_t>& route);

struct PlanFigures {
  double unvisited_priority{};
  double longest{};
  double total{};
};
[[nodiscard]] PlanFigures figures(const Problem& problem, const Plan& plan);

/// Why a stop is in no route.
enum class UnvisitedReason {
  no_sensor,   ///< no vehicle's sensor is good enough
  no_way,      ///< no vehicle with such a sensor can fly there and on to an end
  too_far,     ///< the visit alone is beyond the endurance of each of them
  outweighed,  ///< their endurance is spent on other stops
};

struct Unvisited {
  std::size_t stop{};
  UnvisitedReason reason{};
  double cost_alone{unlimited};  ///< of the cheapest route that visits only this stop, by a vehicle with such a sensor
};

/// What a vehicle's route to one stop and on to its end costs.
using CostAlone = std::function<double(const Vehicle& vehicle, std::size_t stop)>;

/// The stops that no route visits, in their order.
[[nodiscard]] std::vector<Unvisited> unvisited(const Problem& problem, const Plan& plan, const CostAlone& cost_alone);
[[nodiscard]] std::vector<Unvisited> unvisited(const Problem& problem, const Plan& plan);

}  // namespace ponte::planning
