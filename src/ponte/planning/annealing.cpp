#include "ponte/planning/annealing.hpp"

namespace ponte::planning {
namespace {

constexpr int halvings = 10;
constexpr std::uint64_t first_tries_per_stop = 1000;
constexpr std::uint32_t turned_max = 50;

/// From a start to a stop, in the mean of those that have a way.
Ticks mean_leg(const Legs& legs) {
  Ticks sum = 0;
  Ticks count = 1;
  for (Node vehicle = 0; vehicle < legs.vehicles(); ++vehicle) {
    for (Node stop = 0; stop < legs.stops(); ++stop) {
      const auto leg = legs(vehicle, legs.home(vehicle), stop);
      if (leg >= no_way) continue;
      sum += leg;
      ++count;
    }
  }
  return sum / count;
}

}  // namespace

Annealing::Annealing(const Problem& problem, std::uint64_t seed)
    : legs_{problem},
      random_{seed},
      routes_{legs_},
      scoring_{problem.objective, legs_},
      cooling_{static_cast<double>(mean_leg(legs_)), halvings, first_tries_per_stop * (legs_.stops() + 1)} {
  for (Node stop = 0; stop < legs_.stops(); ++stop) {
    insert_anywhere(stop);
    if (routes_.are_within_limits())
      routes_.keep();
    else
      routes_.take_back();
  }
  score_ = best_score_ = scoring_.score(legs_, routes_);
  best_ = routes_.plan();
}

void Annealing::improve(std::uint64_t tries) {
  if (legs_.stops() == 0) return;
  for (; tries > 0; --tries) {
    const auto stop = random_.below(legs_.stops());
    const auto other = random_.below(legs_.stops());
    const bool are_visited = routes_.vehicle_of(stop) != Routes::nobody && routes_.vehicle_of(other) != Routes::nobody;
    const auto kind = are_visited ? random_.below(3) : 0;
    if (kind == 0) {
      if (routes_.vehicle_of(stop) != Routes::nobody) routes_.remove(stop);
      insert_anywhere(stop);
    } else if (kind == 1 && stop != other) {
      exchange(stop, other);
    } else {
      turn_round(stop);
    }
    judge();
  }
}

/// Behind a stop or a home that chance names.
void Annealing::insert_anywhere(Node stop) {
  const auto node = random_.below(legs_.stops() + legs_.vehicles());
  const auto vehicle = routes_.vehicle_of(node);
  if (vehicle != Routes::nobody && legs_.may_visit(vehicle, stop)) routes_.insert(vehicle, node, stop);
}

void Annealing::exchange(Node a, Node b) {
  const auto vehicle_a = routes_.vehicle_of(a);
  const auto vehicle_b = routes_.vehicle_of(b);
  if (!legs_.may_visit(vehicle_a, b) || !legs_.may_visit(vehicle_b, a)) return;
  const auto before_a = routes_.previous(a);
  routes_.remove(a);
  const auto before_b = routes_.previous(b);
  routes_.remove(b);
  // When b followed a, it goes back to where both were, and a behind it.
  routes_.insert(vehicle_a, before_a == b ? before_b : before_a, b);
  routes_.insert(vehicle_b, before_b == before_a || before_a == b ? b : before_b, a);
}

/// A part of the route that begins behind this stop.
void Annealing::turn_round(Node first) {
  const auto vehicle = routes_.vehicle_of(first);
  if (vehicle == Routes::nobody) return;
  auto node = routes_.next(first);
  for (auto count = random_.below(turned_max); count > 0; --count) {
    const auto moved = routes_.next(node);
    if (node >= legs_.stops() || moved >= legs_.stops()) return;
    routes_.remove(moved);
    routes_.insert(vehicle, first, moved);
  }
}

void Annealing::judge() {
  const auto score = scoring_.score(legs_, routes_);
  const bool is_taken = score.smooth - score_.smooth <= cooling_.temperature() * random_.exponential();
  cooling_.step();
  if (!is_taken || !routes_.are_within_limits()) {
    routes_.take_back();
    return;
  }
  routes_.keep();
  score_ = score;
  if (!scoring_.is_better(score, best_score_)) return;
  best_score_ = score;
  best_ = routes_.plan();
}

}  // namespace ponte::planning
