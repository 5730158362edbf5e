#include "ponte/planning/flight_plan.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::planning {
namespace {

std::vector<vehicle::Place> places_of(const Task& task) {
  std::vector<vehicle::Place> places;
  for (const auto& point : task.points) places.push_back(point.place);
  for (const auto& craft : task.crafts) {
    places.push_back(craft.start);
    places.insert(places.end(), craft.ends.begin(), craft.ends.end());
  }
  return places;
}

/// Each start and end of a craft is a place of its own, behind the points.
Problem bare_problem(const Task& task) {
  Problem problem;
  problem.objective = task.objective;
  for (const auto& point : task.points)
    problem.stops.push_back({.service = point.dwell.count(),
                             .priority = std::clamp(point.priority.value_or(1), lowest_priority, highest_priority),
                             .quality_needed = point.sensor_quality.value_or(0)});
  auto place = task.points.size();
  for (const auto& craft : task.crafts) {
    Vehicle vehicle{.costs = problem.vehicles.size(), .start = place++, .ends = {}, .quality = craft.quality};
    for (std::size_t i = 0; i < craft.ends.size(); ++i) vehicle.ends.push_back(place++);
    const auto climb_and_descent = 2 * task.altitude.height.value / craft.vertical_speed.value;
    vehicle.endurance = std::max(0.0, craft.endurance.count() - climb_and_descent);
    problem.vehicles.push_back(std::move(vehicle));
  }
  return problem;
}

}  // namespace

FlightPlanner::FlightPlanner(Task task)
    : task_{std::move(task)},
      places_{places_of(task_)},
      airspace_{task_.fence, places_.front(), task_.margin},
      problem_{bare_problem(task_)} {
  const auto count = places_.size();
  for (std::size_t from = 0; from < count; ++from)
    for (std::size_t to = 0; to < count; ++to) {
      if (to >= from) {
        ways_.push_back(airspace_.way(places_[from], places_[to]));
      } else {
        auto way = ways_[to * count + from];
        if (way) std::ranges::reverse(*way);
        ways_.push_back(std::move(way));
      }
    }
  for (const auto& craft : task_.crafts) {
    auto& costs = problem_.costs.emplace_back(count);
    for (std::size_t from = 0; from < count; ++from)
      for (std::size_t to = 0; to < count; ++to) costs(from, to) = seconds(craft, from, to).value_or(unlimited);
  }
}

std::optional<double> FlightPlanner::seconds(const Craft& craft, std::size_t from, std::size_t to) const {
  const auto& turns = ways_[from * places_.size() + to];
  if (!turns) return std::nullopt;
  double sum = 0;
  auto at = places_[from];
  const auto fly_to = [&](const vehicle::Place& place) {
    const auto [length, course] = bearing(at, place);
    if (length.value > 0) sum += length.value / ground_speed(craft.speed, course, task_.wind).value;
    at = place;
  };
  for (const auto& turn : *turns) fly_to(turn);
  fly_to(places_[to]);
  if (!(sum <= highest_cost)) return std::nullopt;
  return sum;
}

vehicle::Altitude FlightPlanner::altitude_of(std::size_t place) const {
  return place < task_.points.size() ? task_.points[place].altitude.value_or(task_.altitude) : task_.altitude;
}

void FlightPlanner::add_leg(Flight& flight, const Craft& craft, std::size_t from, std::size_t to) const {
  Flight::Leg leg{.turns = *ways_[from * places_.size() + to],
                  .target = places_[to],
                  .point = to < task_.points.size() ? std::optional{to} : std::nullopt,
                  .altitude = altitude_of(to)};
  auto at = places_[from];
  const auto measure = [&](const vehicle::Place& place) {
    flight.length = flight.length + bearing(at, place).length;
    at = place;
  };
  for (const auto& turn : leg.turns) measure(turn);
  measure(leg.target);
  flight.time += vehicle::Seconds{seconds(craft, from, to).value_or(unlimited)};
  if (leg.point) flight.time += task_.points[*leg.point].dwell;
  flight.legs.push_back(std::move(leg));
}

std::vector<Flight> FlightPlanner::flights(const Plan& plan) const {
  std::vector<Flight> result;
  for (std::size_t i = 0; i < task_.crafts.size(); ++i) {
    auto& flight = result.emplace_back();
    const auto& route = plan.routes[i];
    if (route.empty()) continue;
    const auto& craft = task_.crafts[i];
    const auto& vehicle = problem_.vehicles[i];
    auto at = vehicle.start;
    for (const auto stop : route) add_leg(flight, craft, std::exchange(at, stop), stop);
    if (!vehicle.ends.empty()) add_leg(flight, craft, at, route_end(problem_, vehicle, route));
    flight.time += vehicle::Seconds{2 * task_.altitude.height.value / craft.vertical_speed.value};
  }
  return result;
}

}  // namespace ponte::planning
