#include "ponte/planning/ruin_and_recreate.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace ponte::planning {
namespace {

double env(const char* n, double d) { return std::getenv(n) ? atof(std::getenv(n)) : d; }
const Node neighbours = (Node)env("P_NEIGH", 40);
const Node string_length_max = (Node)env("P_LMAX", 10);
const Node removed_mean = (Node)env("P_CBAR", 10);
const Node insert_neigh = (Node)env("P_INS", 40);
const double hot = env("P_HOT", 1), cold = env("P_COLD", 0.01), base = env("P_BASE", 100);
const bool onestring = env("P_ONE", 1) != 0;
const bool frombest = env("P_FROMBEST", 0) != 0;

}  // namespace

RuinAndRecreate::RuinAndRecreate(const Problem& problem, std::uint64_t seed)
    : legs_{problem},
      near_{legs_.stops(), neighbours, [this](Node a, Node b) { return legs_.distance(a, b); }},
      scoring_{problem.objective},
      random_{seed},
      routes_{legs_},
      cooling_{1, 1, 1},
      is_ruined_(legs_.vehicles()) {
  absent_.resize(legs_.stops());
  std::iota(absent_.begin(), absent_.end(), Node{0});
  recreate();
  scoring_.scale_ = 1.0 / (double)(scoring_.score(legs_, routes_).longest + 1);
  score_ = best_score_ = scoring_.score(legs_, routes_);
  best_ = routes_.plan();
  routes_.keep();
  const double mean_leg = score_.total / (double)(legs_.stops() + legs_.vehicles());
  cooling_ = Cooling(mean_leg * hot + 1, mean_leg * cold + 1, (uint64_t)(base * (legs_.stops() + 1)));
}

void RuinAndRecreate::improve(std::uint64_t tries) {
  if (legs_.stops() == 0) return;
  for (; tries > 0; --tries) {
    ruin();
    recreate();
    judge();
  }
}

void RuinAndRecreate::ruin() {
  absent_.clear();
  std::ranges::fill(is_ruined_, char{0});
  Node served = 0;
  Node used = 0;
  for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle) {
    served += routes_.size(vehicle);
    used += routes_.size(vehicle) > 0 ? 1 : 0;
  }
  const auto longest = std::clamp<Node>(served / std::max<Node>(used, 1), 1, string_length_max);
  const auto most_strings = 4 * removed_mean / (1 + longest);
  auto strings = 1 + random_.below(std::max<Node>(most_strings, 1));
  const auto first = random_.below(legs_.stops());
  const auto visit = [&](Node stop) {
    const auto vehicle = routes_.vehicle_of(stop);
    if (vehicle == Routes::nobody) {
      if (std::ranges::find(absent_, stop) == absent_.end()) absent_.push_back(stop);
    } else if (!onestring || is_ruined_[vehicle] == 0) {
      is_ruined_[vehicle] = 1;
      remove_string(stop, longest);
      --strings;
    }
  };
  visit(first);
  for (const auto stop : near_.of(first)) {
    if (strings == 0) break;
    visit(stop);
  }
}

void RuinAndRecreate::remove_string(Node stop, Node longest) {
  const auto vehicle = routes_.vehicle_of(stop);
  const auto size = routes_.size(vehicle);
  auto length = 1 + random_.below(std::min(size, longest));
  // Half of the strings keep a part in their middle.
  Node kept = 0;
  if (length > 1 && length < size && random_.chance(0.5)) {
    kept = 1;
    while (length + kept < size && random_.chance(0.99)&&0) ++kept;
  }
  const auto kept_from = kept > 0 ? 1 + random_.below(length - 1) : length;
  auto node = stop;
  const auto home = legs_.home(vehicle);
  for (auto back = random_.below(length + kept); back > 0 && routes_.previous(node) != home; --back)
    node = routes_.previous(node);
  for (Node i = 0; i < length + kept && node != home; ++i) {
    const auto following = routes_.next(node);
    if (i < kept_from || i >= kept_from + kept) {
      routes_.remove(node);
      absent_.push_back(node);
    }
    node = following;
  }
}

void RuinAndRecreate::recreate() {
  sort_absent();
  for (const auto stop : absent_) {
    const auto best = best_insertion(stop);
    if (best.vehicle != Routes::nobody) routes_.insert(best.vehicle, best.behind, stop);
  }
}

void RuinAndRecreate::sort_absent() {
  for (auto i = absent_.size(); i > 1; --i)
    std::swap(absent_[i - 1], absent_[random_.below(static_cast<std::uint32_t>(i))]);
  const auto nearest_home = [&](Node stop) {
    Ticks least = legs_.limit(0);
    for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle)
      least = std::min(least, legs_(vehicle, legs_.home(vehicle), stop));
    return least;
  };
  switch (random_.below(8)) {
    case 0: std::ranges::stable_sort(absent_, std::less{}, nearest_home); break;
    case 1:
    case 2: std::ranges::stable_sort(absent_, std::greater{}, nearest_home); break;
    default: break;
  }
}

RuinAndRecreate::Insertion RuinAndRecreate::best_insertion(Node stop) {
  Insertion best;
  for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle) {
    if (!legs_.may_visit(vehicle, stop)) continue;
    const auto home = legs_.home(vehicle);
    consider(vehicle, home, stop, best);
    if (routes_.size(vehicle) > 0) consider(vehicle, routes_.previous(home), stop, best);
  }
  Node i = 0;
  for (const auto neighbour : near_.of(stop)) {
    if (++i > insert_neigh) break;
    const auto vehicle = routes_.vehicle_of(neighbour);
    if (vehicle == Routes::nobody || !legs_.may_visit(vehicle, stop)) continue;
    consider(vehicle, neighbour, stop, best);
    consider(vehicle, routes_.previous(neighbour), stop, best);
  }
  return best;
}

void RuinAndRecreate::consider(Node vehicle, Node behind, Node stop, Insertion& best) {
  if (--tries_until_blink_ == 0) {
    tries_until_blink_ = 1 + random_.below(199);
    return;
  }
  const auto added = routes_.added_cost(vehicle, behind, stop);
  const auto before = routes_.cost(vehicle);
  if (before + added > legs_.limit(vehicle)) return;
  const auto cost = scoring_.weight(before + added) - scoring_.weight(before);
  if (best.vehicle == Routes::nobody || cost < best.cost) best = {vehicle, behind, cost};
}

void RuinAndRecreate::judge() {
  const auto score = scoring_.score(legs_, routes_);
  const auto worse = score.smooth - score_.smooth + 1000.0 * (double)(score.unvisited_priority - score_.unvisited_priority);
  if (worse < cooling_.temperature() * random_.exponential()) {
    score_ = score;
    routes_.keep();
    if (scoring_.is_better(score, best_score_)) {
      best_score_ = score;
      best_ = routes_.plan();
    }
  } else {
    routes_.take_back();
  }
  cooling_.step();
}

}  // namespace ponte::planning
