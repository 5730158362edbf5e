#include "ponte/planning/tour_search.hpp"

#include "ponte/core/assert.hpp"

#include <array>
#include <cmath>

namespace ponte::planning {
namespace {

constexpr Node neighbours = 8;
/// How many moves are tried at each depth before the search goes back.
constexpr std::array<std::size_t, 10> breadth = {5, 3, 2, 1, 1, 1, 1, 1, 1, 1};
/// The pieces that a kick exchanges are at most this long.
constexpr Tour::City piece_max = 30;
// The highest temperature in typical legs.
constexpr double hottest_legs = 0.125;
constexpr int halvings = 4;
constexpr std::uint64_t first_tries_per_city = 5;
/// What binds the start to the end, so that no tour parts them.
constexpr Ticks bond = -(Ticks{1} << 44U);

bool start_is_end(const Problem& problem) {
  const auto& vehicle = problem.vehicles.front();
  const auto& costs = problem.costs[vehicle.costs];
  for (std::size_t stop = 0; stop < problem.stops.size(); ++stop)
    if (ticks(costs(vehicle.start, stop)) != ticks(cost_to_end(costs, vehicle, stop))) return false;
  return true;
}

std::vector<Ticks> distances_of(const Problem& problem, std::size_t cities) {
  const auto& vehicle = problem.vehicles.front();
  const auto& costs = problem.costs[vehicle.costs];
  const auto stops = problem.stops.size();
  std::vector<Ticks> result(cities * cities, bond);
  const auto set = [&](std::size_t a, std::size_t b, double cost) {
    result[a * cities + b] = result[b * cities + a] = ticks(cost);
  };
  for (std::size_t a = 0; a < stops; ++a) {
    for (std::size_t b = 0; b < stops; ++b) set(a, b, costs(a, b));
    set(a, cities - 1, cost_to_end(costs, vehicle, a));
    set(a, stops, costs(vehicle.start, a));
  }
  return result;
}

std::vector<Tour::City> in_order(Tour::City count) {
  std::vector<Tour::City> result(count);
  std::iota(result.begin(), result.end(), Tour::City{0});
  return result;
}

}  // namespace

bool TourSearch::fits(const Problem& problem) {
  if (problem.vehicles.size() != 1 || problem.stops.size() < 8) return false;
  const auto& vehicle = problem.vehicles.front();
  const auto& costs = problem.costs[vehicle.costs];
  if (std::isfinite(vehicle.endurance)) return false;
  for (std::size_t a = 0; a < problem.stops.size(); ++a) {
    if (problem.stops[a].quality_needed > vehicle.quality) return false;
    if (std::isinf(costs(vehicle.start, a)) || std::isinf(cost_to_end(costs, vehicle, a))) return false;
    for (std::size_t b = 0; b < a; ++b)
      if (std::isinf(costs(a, b)) || ticks(costs(a, b)) != ticks(costs(b, a))) return false;
  }
  return true;
}

TourSearch::TourSearch(const Problem& problem, std::uint64_t seed)
    : stops_{static_cast<City>(problem.stops.size())},
      cities_{stops_ + (start_is_end(problem) ? 1 : 2)},
      distances_{distances_of(problem, cities_)},
      near_{cities_, neighbours, [this](City a, City b) { return distance(a, b); }},
      random_{seed},
      tour_{in_order(cities_)},
      cooling_{hottest_legs * static_cast<double>(typical_leg()), halvings, first_tries_per_city * cities_},
      is_queued_(cities_),
      best_{tour_} {
  for (City city = 0; city < cities_; ++city) enqueue(city);
  static_cast<void>(mend());
  tour_.keep();
  best_ = tour_;
}

/// The mean way to the nearest city.
Ticks TourSearch::typical_leg() const {
  Ticks sum = 0;
  for (City stop = 0; stop < stops_; ++stop) {
    const auto nearest = near_.of(stop);
    sum += distance(stop, nearest[0]);
  }
  return sum / stops_;
}

void TourSearch::improve(std::uint64_t tries) {
  for (; tries > 0; --tries) {
    const auto gain = kick();
    const auto longer = -(gain + mend());
    const auto tolerance = cooling_.temperature() * random_.exponential();
    cooling_.step();
    if (longer > 0 && static_cast<double>(longer) > tolerance) {
      while (tour_.turns() > 0) tour_.take_back();
      continue;
    }
    tour_.keep();
    length_ += longer;
    if (length_ >= best_length_) continue;
    best_length_ = length_;
    best_ = tour_;
  }
}

Plan TourSearch::best() const {
  const auto start = stops_;
  const bool goes_on = cities_ - stops_ == 1 || best_.next(start) != start + 1;
  std::vector<std::size_t> route;
  for (auto city = start; route.size() < stops_;) {
    city = goes_on ? best_.next(city) : best_.previous(city);
    route.push_back(city);
  }
  return {{route}};
}

void TourSearch::enqueue(City city) {
  if (std::exchange(is_queued_[city], char{1}) == 0) queue_.push_back(city);
}

/// Exchanges two neighbouring pieces, and says what that gains.
Ticks TourSearch::kick() {
  const auto longest = std::min(piece_max, (cities_ - 2) / 2);
  const auto before = random_.below(cities_);
  const auto a = tour_.next(before);
  const auto length = random_.below(longest);
  const auto a_end = tour_.ahead(a, length);
  const auto b = tour_.next(a_end);
  const auto b_end = tour_.ahead(b, random_.below(longest));
  const auto behind = tour_.next(b_end);
  tour_.reverse(a, b_end);
  tour_.reverse(b_end, b);
  tour_.reverse(a_end, a);
  for (const auto city : {before, a, a_end, b, b_end, behind}) enqueue(city);
  return distance(before, a) + distance(a_end, b) + distance(b_end, behind)  //
         - distance(before, b) - distance(b_end, a) - distance(a_end, behind);
}

/// Improves the tour around the queued cities until nothing is left to do, and says what that gains.
Ticks TourSearch::mend() {
  Ticks gain = 0;
  while (!queue_.empty()) {
    const auto city = queue_.back();
    queue_.pop_back();
    is_queued_[city] = 0;
    for (auto more = improve_city(city); more > 0; more = improve_city(city)) gain += more;
  }
  return gain;
}

Ticks TourSearch::improve_city(City city) {
  for (int side = 0; side < 2; ++side) {
    const auto end = tour_.next(city);
    if (const auto gain = deepen(city, end, distance(city, end), 0); gain > 0) return gain;
    tour_.mirror();
  }
  return 0;
}

/// The tour without the leg from `fixed` to the city `end` behind it is a path from `end` to `fixed`. Ties `end` to a
/// near city and cuts the leg before that, which makes another path, until closing it makes a shorter tour.
Ticks TourSearch::deepen(City fixed, City end, Ticks gain, std::size_t depth) {
  std::array<Move, breadth[0]> moves;
  const auto count = find_moves(fixed, end, gain, std::span{moves}.first(breadth[depth]));
  for (const auto& move : std::span{moves}.first(count)) {
    tour_.reverse(end, move.end);
    auto closed = move.gain - distance(move.end, fixed);
    if (closed <= 0 && depth + 1 < breadth.size()) closed = deepen(fixed, move.end, move.gain, depth + 1);
    if (closed > 0) {
      for (const auto city : {end, move.to, move.end}) enqueue(city);
      if (depth == 0) enqueue(fixed);
      return closed;
    }
    tour_.take_back();
  }
  return 0;
}

/// The best ways to go on from the loose end, the best first.
std::size_t TourSearch::find_moves(City fixed, City end, Ticks gain, std::span<Move> moves) const {
  std::size_t count = 0;
  for (const auto to : near_.of(end)) {
    const auto rest = gain - distance(end, to);
    if (rest <= 0) break;
    if (to == tour_.next(end) || to == fixed) continue;
    const auto new_end = tour_.previous(to);
    const Move move{to, new_end, rest + distance(new_end, to)};
    auto at = count;
    for (; at > 0 && moves[at - 1].gain < move.gain; --at)
      if (at < moves.size()) moves[at] = moves[at - 1];
    if (at < moves.size()) moves[at] = move;
    count = std::min(count + 1, moves.size());
  }
  return count;
}

}  // namespace ponte::planning
