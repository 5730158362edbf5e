#include "ponte/planning/flight_plan.hpp"

#include "ponte/planning/plane.hpp"

#include <algorithm>
#include <utility>

namespace ponte::planning {
namespace {

/// The points, both ends of each line with its run-in, the starts and ends of the crafts.
std::vector<vehicle::Place> places_of(const Task& task) {
  std::vector<vehicle::Place> places;
  for (const auto& point : task.points) places.push_back(point.place);
  for (const auto& line : task.lines) {
    places.push_back(displaced(line.begin, bearing(line.begin, line.end).course, -line.run_in));
    places.push_back(displaced(line.end, bearing(line.end, line.begin).course, -line.run_in));
  }
  for (const auto& craft : task.crafts) {
    places.push_back(craft.start);
    places.insert(places.end(), craft.ends.begin(), craft.ends.end());
  }
  return places;
}

/// Each start and end of a craft is a place of its own, behind the stops.
Problem bare_problem(const Task& task) {
  Problem problem;
  problem.objective = task.objective;
  for (const auto& point : task.points)
    problem.stops.push_back({.service = point.dwell.count(),
                             .priority = std::clamp(point.priority.value_or(1), lowest_priority, highest_priority),
                             .quality_needed = point.sensor_quality.value_or(0)});
  problem.stops.resize(task.points.size() + task.lines.size());
  auto place = problem.stops.size();
  for (const auto& craft : task.crafts) {
    Vehicle vehicle{.start = place++, .ends = {}, .quality = craft.quality};
    for (std::size_t i = 0; i < craft.ends.size(); ++i) vehicle.ends.push_back(place++);
    const auto climb_and_descent = 2 * task.altitude.height.value / craft.vertical_speed.value;
    vehicle.endurance = std::max(0.0, craft.endurance.count() - climb_and_descent);
    problem.vehicles.push_back(std::move(vehicle));
  }
  return problem;
}

/// Neighbours in the list that are at the same spot.
template <class Pass>
std::vector<std::vector<Pass>> grouped(const std::vector<Pass>& passes, std::size_t Pass::*spot) {
  std::vector<std::vector<Pass>> groups;
  for (const auto& pass : passes) {
    if (groups.empty() || groups.back().front().*spot != pass.*spot) groups.emplace_back();
    groups.back().push_back(pass);
  }
  return groups;
}

}  // namespace

FlightPlanner::FlightPlanner(Task task)
    : task_{std::move(task)},
      places_{places_of(task_)},
      airspace_{task_.fence, places_.front(), task_.margin},
      problem_{.problem = bare_problem(task_), .classes = {}} {
  for (const auto& place : places_) spots_.push_back(airspace_.map().point(place));
  find_ways();
  for (std::size_t i = 0; i < task_.crafts.size(); ++i) problem_.problem.vehicles[i].costs = class_of(task_.crafts[i]);
  for (const auto& each : classes_) {
    problem_.classes.push_back(pass_costs(each));
    problem_.problem.costs.push_back(expected(problem_.classes.back(), problem_.problem.stops.size()));
  }
}

void FlightPlanner::find_ways() {
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
}

std::size_t FlightPlanner::class_of(const Craft& craft) {
  const auto found = std::ranges::find_if(
      classes_, [&](const Class& each) { return each.speed == craft.speed && each.turn_radius == craft.turn_radius; });
  if (found != classes_.end()) return static_cast<std::size_t>(found - classes_.begin());
  FlyingTimes times{craft.speed, task_.wind};
  Class added{
      .speed = craft.speed, .turn_radius = craft.turn_radius, .times = times, .passes = passes_of(craft.turn_radius)};
  if (craft.turn_radius.value > 0)
    added.turning.emplace(airspace_, std::move(times), turn_radius_in_wind(craft.turn_radius, craft.speed, task_.wind));
  classes_.push_back(std::move(added));
  return classes_.size() - 1;
}

std::vector<std::vector<FlightPlanner::Pass>> FlightPlanner::passes_of(Metres turn_radius) const {
  std::vector<std::vector<Pass>> result;
  const auto points = task_.points.size();
  for (std::size_t spot = 0; spot < places_.size();) {
    auto& passes = result.emplace_back();
    if (spot >= points && spot < points + 2 * task_.lines.size()) {
      for (const auto& [in, out] : {std::pair{spot, spot + 1}, std::pair{spot + 1, spot}})
        passes.push_back({in, out, course(spots_[in], spots_[out])});
      spot += 2;
      continue;
    }
    if (turn_radius.value > 0)
      for (const auto& pose : poses_at(spots_[spot])) passes.push_back({spot, spot, pose.course});
    else
      passes.push_back({spot, spot, {}});
    ++spot;
  }
  return result;
}

PassCosts FlightPlanner::pass_costs(const Class& likes) const {
  std::vector<std::size_t> first{0};
  for (const auto& passes : likes.passes) first.push_back(first.back() + passes.size());
  PassCosts result{.first = first, .costs = CostMatrix{first.back()}};
  for (std::size_t from = 0; from < likes.passes.size(); ++from)
    for (std::size_t to = 0; to < likes.passes.size(); ++to) add_costs(result, likes, from, to);
  return result;
}

void FlightPlanner::add_costs(PassCosts& costs, const Class& likes, std::size_t from, std::size_t to) const {
  auto row = costs.first[from];
  for (const auto& outs : grouped(likes.passes[from], &Pass::out)) {
    auto column = costs.first[to];
    for (const auto& ins : grouped(likes.passes[to], &Pass::in)) {
      const auto out = outs.front().out;
      const auto in = ins.front().in;
      std::vector<double> legs(outs.size() * ins.size(), unlimited);
      if (likes.turning && ways_[out * places_.size() + in]) {
        std::vector<Pose> poses;
        for (const auto& pass : outs) poses.push_back({spots_[out], pass.course});
        std::vector<Pose> next;
        for (const auto& pass : ins) next.push_back({spots_[in], pass.course});
        legs = likes.turning->seconds(poses, corner_points(out, in), next);
      } else if (!likes.turning) {
        legs.assign(legs.size(), seconds(likes, out, in));
      }
      for (std::size_t i = 0; i < legs.size(); ++i) {
        const auto whole = legs[i] + seconds_within(likes, ins[i % ins.size()]);
        costs.costs(row + i / ins.size(), column + i % ins.size()) = whole <= highest_cost ? whole : unlimited;
      }
      column += ins.size();
    }
    row += outs.size();
  }
}

std::vector<MapPoint> FlightPlanner::corner_points(std::size_t from, std::size_t to) const {
  std::vector<MapPoint> points;
  for (const auto& corner : corners(from, to)) points.push_back(airspace_.map().point(corner));
  return points;
}

double FlightPlanner::seconds(const Class& likes, std::size_t from, std::size_t to) const {
  if (!ways_[from * places_.size() + to]) return unlimited;
  double sum = 0;
  auto at = places_[from];
  const auto fly_to = [&](const vehicle::Place& place) {
    const auto [length, course] = bearing(std::exchange(at, place), place);
    sum += likes.times.straight(length.value, course);
  };
  for (const auto& corner : corners(from, to)) fly_to(corner);
  fly_to(places_[to]);
  return sum;
}

/// A line has to be flown as it is.
double FlightPlanner::seconds_within(const Class& likes, const Pass& pass) const {
  if (pass.in == pass.out) return 0;
  const auto& way = ways_[pass.in * places_.size() + pass.out];
  return way && way->empty() ? seconds(likes, pass.in, pass.out) : unlimited;
}

bool FlightPlanner::has_passes() const {
  return !task_.lines.empty() ||
         std::ranges::any_of(task_.crafts, [](const Craft& craft) { return craft.turn_radius.value > 0; });
}

}  // namespace ponte::planning
