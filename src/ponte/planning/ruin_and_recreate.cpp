#include "ponte/planning/ruin_and_recreate.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <ranges>

namespace ponte::planning {
namespace {

constexpr Node neighbours = 40;
constexpr Node string_max = 10;
constexpr Node removed_mean = 10;
constexpr std::uint32_t blink_interval_mean = 100;

// The highest temperature is one typical leg.
constexpr int halvings = 7;
constexpr std::uint64_t first_tries_per_stop = 100;

std::vector<Ticks> from_nearest_start(const Legs& legs) {
  std::vector<Ticks> result(legs.stops(), no_way);
  for (Node vehicle = 0; vehicle < legs.vehicles(); ++vehicle)
    for (Node stop = 0; stop < legs.stops(); ++stop)
      result[stop] = std::min(result[stop], legs(vehicle, legs.home(vehicle), stop));
  return result;
}

/// The mean way to one of the three nearest stops; what has no way does not count.
Ticks typical_leg(const Legs& legs, const Neighbours& near) {
  Ticks sum = 1;
  Ticks count = 1;
  for (Node stop = 0; stop < legs.stops(); ++stop) {
    for (const auto other : near.of(stop) | std::views::take(3)) {
      const auto leg = legs.distance(stop, other);
      if (leg >= no_way / 2) continue;
      sum += leg;
      ++count;
    }
  }
  return sum / count + 1;
}

}  // namespace

RuinAndRecreate::RuinAndRecreate(const Problem& problem, std::uint64_t seed)
    : legs_{problem},
      near_{legs_.stops(), neighbours, [this](Node a, Node b) { return legs_.distance(a, b); }},
      random_{seed},
      routes_{legs_},
      scoring_{problem.objective, legs_},
      cooling_{static_cast<double>(typical_leg(legs_, near_)), halvings, first_tries_per_stop * (legs_.stops() + 1)},
      is_absent_(legs_.stops()),
      from_nearest_start_{from_nearest_start(legs_)} {
  absent_.resize(legs_.stops());
  std::iota(absent_.begin(), absent_.end(), Node{0});
  recreate();
  routes_.keep();
  best_ = routes_.plan();
  score_ = best_score_ = scoring_.score(legs_, routes_);
}

void RuinAndRecreate::improve(std::uint64_t tries) {
  if (legs_.stops() == 0) return;
  for (; tries > 0; --tries) {
    ruin();
    recreate();
    judge();
  }
}

/// Removes strings of stops around a stop that chance names. Unvisited stops on the way get another chance.
void RuinAndRecreate::ruin() {
  Node visited = 0;
  Node used = 0;
  for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle) {
    visited += routes_.size(vehicle);
    if (routes_.size(vehicle) > 0) ++used;
  }
  const auto longest = std::clamp<Node>(visited / std::max<Node>(used, 1), 1, string_max);
  auto strings = 1 + random_.below(std::max<Node>(4 * removed_mean / (1 + longest), 1));
  const auto remove_around = [&](Node stop) {
    if (is_absent_[stop] != 0) return;
    if (routes_.vehicle_of(stop) == Routes::nobody) {
      absent_.push_back(stop);
      is_absent_[stop] = 1;
      return;
    }
    remove_string(stop, longest);
    --strings;
  };
  const auto first = random_.below(legs_.stops());
  remove_around(first);
  for (const auto stop : near_.of(first)) {
    if (strings == 0) break;
    remove_around(stop);
  }
}

/// Removes up to `longest` stops around this one from its route; half of the strings leave a stop in their middle.
void RuinAndRecreate::remove_string(Node stop, Node longest) {
  const auto vehicle = routes_.vehicle_of(stop);
  const auto home = legs_.home(vehicle);
  const auto size = routes_.size(vehicle);
  const auto length = 1 + random_.below(std::min(size, longest));
  const bool leaves_one = length > 1 && length < size && random_.chance(0.5);
  const auto left = leaves_one ? 1 + random_.below(length - 1) : length;
  auto node = stop;
  for (auto back = random_.below(length); back > 0 && routes_.previous(node) != home; --back)
    node = routes_.previous(node);
  for (Node i = 0; i < length + (leaves_one ? 1U : 0U) && node != home; ++i) {
    const auto following = routes_.next(node);
    if (i != left) {
      routes_.remove(node);
      absent_.push_back(node);
      is_absent_[node] = 1;
    }
    node = following;
  }
}

void RuinAndRecreate::recreate() {
  sort_absent();
  for (const auto stop : absent_) {
    if (const auto best = best_insertion(stop)) routes_.insert(best->vehicle, best->behind, stop);
    is_absent_[stop] = 0;
  }
  absent_.clear();
}

/// Mostly by chance; also by priority, the farthest first, or the nearest first.
void RuinAndRecreate::sort_absent() {
  for (auto i = absent_.size(); i > 1; --i)
    std::swap(absent_[i - 1], absent_[random_.below(static_cast<std::uint32_t>(i))]);
  const auto start = [&](Node stop) { return from_nearest_start_[stop]; };
  const auto priority = [&](Node stop) { return legs_.priority(stop); };
  switch (random_.below(10)) {
    case 0: std::ranges::stable_sort(absent_, std::less{}, start); break;
    case 1:
    case 2: std::ranges::stable_sort(absent_, std::greater{}, start); break;
    case 3:
    case 4:
    case 5: std::ranges::stable_sort(absent_, std::greater{}, priority); break;
    default: break;
  }
}

/// Where the stop costs least: beside a near stop, or at an end of a route.
std::optional<RuinAndRecreate::Insertion> RuinAndRecreate::best_insertion(Node stop) {
  std::optional<Insertion> best;
  const auto consider = [&](Node vehicle, Node behind) {
    if (--until_blink_ == 0) {
      until_blink_ = 1 + random_.below(2 * blink_interval_mean);
      return;
    }
    const auto before = routes_.cost(vehicle);
    const auto after = before + routes_.added_cost(vehicle, behind, stop);
    if (after > legs_.limit(vehicle)) return;
    const auto cost = scoring_.share(after) - scoring_.share(before);
    if (!best || cost < best->cost) best = {vehicle, behind, cost};
  };
  for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle) {
    if (!legs_.may_visit(vehicle, stop)) continue;
    const auto home = legs_.home(vehicle);
    consider(vehicle, home);
    if (routes_.size(vehicle) > 0) consider(vehicle, routes_.previous(home));
  }
  for (const auto neighbour : near_.of(stop)) {
    const auto vehicle = routes_.vehicle_of(neighbour);
    if (vehicle == Routes::nobody || !legs_.may_visit(vehicle, stop)) continue;
    consider(vehicle, neighbour);
    consider(vehicle, routes_.previous(neighbour));
  }
  return best;
}

void RuinAndRecreate::judge() {
  const auto score = scoring_.score(legs_, routes_);
  const auto tolerance = cooling_.temperature() * random_.exponential();
  cooling_.step();
  if (score.smooth - score_.smooth > tolerance || !routes_.are_within_limits()) {
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
