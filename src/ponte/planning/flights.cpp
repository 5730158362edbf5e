#include "ponte/planning/flight_plan.hpp"
#include "ponte/planning/plane.hpp"

#include <numbers>
#include <utility>

namespace ponte::planning {
namespace {

constexpr auto chord = std::numbers::pi / 18;          ///< of the track, in turns
constexpr auto waypoint_every = std::numbers::pi / 2;  ///< in turns

SurveyLine in_direction(SurveyLine line, bool backwards) {
  if (backwards) std::swap(line.begin, line.end);
  return line;
}

void wait_there(Flight& flight, vehicle::Seconds duration, Metres height) {
  flight.time += duration;
  flight.track.push_back({flight.time, flight.track.back().place, height});
}

}  // namespace

std::vector<Flight> FlightPlanner::flights(const Plan& plan) const {
  std::vector<Flight> result;
  for (std::size_t i = 0; i < task_.crafts.size(); ++i) result.push_back(flight(i, plan.routes[i]));
  return result;
}

Flight FlightPlanner::flight(std::size_t index, const std::vector<std::size_t>& route) const {
  Flight result;
  if (route.empty()) return result;
  const auto& craft = task_.crafts[index];
  const auto& vehicle = problem().vehicles[index];
  const auto& likes = classes_[vehicle.costs];
  const auto passed = best_passes(problem_, vehicle, route);
  const vehicle::Seconds climb{task_.altitude.height.value / craft.vertical_speed.value};
  result.track.push_back({{}, craft.start, {}});
  wait_there(result, climb, task_.altitude.height);
  auto at = likes.passes[vehicle.start][passed.passes[0]];
  for (std::size_t i = 0; i < route.size(); ++i) {
    const auto& next = likes.passes[route[i]][passed.passes[i + 1]];
    add_leg(result, likes, std::exchange(at, next), next, route[i]);
    if (route[i] < task_.points.size()) wait_there(result, task_.points[route[i]].dwell, result.track.back().height);
  }
  if (!vehicle.ends.empty()) add_leg(result, likes, at, likes.passes[passed.end][passed.passes.back()], std::nullopt);
  wait_there(result, climb, {});
  return result;
}

void FlightPlanner::add_leg(Flight& flight, const Class& likes, const Pass& from, const Pass& to,
                            std::optional<std::size_t> stop) const {
  const bool is_point = stop && *stop < task_.points.size();
  Flight::Leg leg{.turns = {},
                  .target = places_[to.out],
                  .stop = stop,
                  .line = {},
                  .altitude = is_point ? task_.points[*stop].altitude.value_or(task_.altitude) : task_.altitude};
  flight.track.push_back({flight.time, flight.track.back().place, leg.altitude.height});
  if (likes.turning) {
    turn_to(flight, leg, likes, from, to);
  } else {
    leg.turns = corners(from.out, to.in);
    for (const auto& corner : leg.turns) fly_to(flight, likes, corner);
    fly_to(flight, likes, places_[to.in]);
  }
  if (to.in != to.out) {
    leg.line = in_direction(task_.lines[*stop - task_.points.size()], to.in > to.out);
    if (leg.line->run_in.value > 0) leg.turns.push_back(places_[to.in]);
    fly_to(flight, likes, places_[to.out]);
  }
  flight.legs.push_back(std::move(leg));
}

void FlightPlanner::turn_to(Flight& flight, Flight::Leg& leg, const Class& likes, const Pass& from,
                            const Pass& to) const {
  const auto way =
      likes.turning->way({spots_[from.out], from.course}, corner_points(from.out, to.in), {spots_[to.in], to.course});
  const auto& map = airspace_.map();
  const auto least_apart = likes.turn_radius.value / 2;
  auto last = spots_[from.out];
  for (const auto& path : way->paths) {
    for (const auto metres : marks(path, chord))
      flight.track.push_back({flight.time + vehicle::Seconds{likes.times.along(path.first(metres))},
                              map.place(path.pose_after(metres).at), leg.altitude.height});
    for (const auto metres : marks(path, waypoint_every)) {
      const auto point = path.pose_after(metres).at;
      if (length(point - last) < least_apart || length(point - spots_[to.in]) < least_apart) continue;
      leg.turns.push_back(map.place(point));
      last = point;
    }
    flight.time += vehicle::Seconds{likes.times.along(path)};
    flight.length = flight.length + Metres{path.length()};
  }
}

void FlightPlanner::fly_to(Flight& flight, const Class& likes, const vehicle::Place& place) const {
  const auto [length, course] = bearing(flight.track.back().place, place);
  flight.time += vehicle::Seconds{likes.times.straight(length.value, course)};
  flight.length = flight.length + length;
  flight.track.push_back({flight.time, place, flight.track.back().height});
}

}  // namespace ponte::planning
