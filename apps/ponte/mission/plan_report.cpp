#include "mission/plan_report.hpp"

#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "ponte/core/degrees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ponte::app {
namespace {

using planning::Flight;
using planning::FlightPlanner;
using planning::Task;
using planning::UnvisitedReason;

/// "point 3 'well' (line 4)", or "survey line 2".
std::string stop_name(const Task& task, std::size_t stop) {
  if (stop >= task.points.size()) return fmt::format("survey line {}", stop - task.points.size() + 1);
  const auto& point = task.points[stop];
  auto name = fmt::format("point {}", stop + 1);
  if (!point.name.empty()) name += fmt::format(" '{}'", point.name);
  if (point.where.unit != planning::Where::Unit::nowhere) name += fmt::format(" ({})", to_text(point.where));
  return name;
}

bool is_allowed(const FlightPlanner& planner, std::size_t stop) {
  const auto& task = planner.task();
  const auto& airspace = planner.airspace();
  if (stop < task.points.size()) return airspace.allows(task.points[stop].place);
  const auto& line = task.lines[stop - task.points.size()];
  return airspace.allows(line.begin) && airspace.allows(line.end) &&
         airspace.is_free(airspace.map().point(line.begin), airspace.map().point(line.end));
}

std::string reason_text(const FlightPlanner& planner, const planning::Unvisited& left) {
  switch (left.reason) {
    case UnvisitedReason::no_sensor:
      return fmt::format("needs a sensor quality of {}, which no vehicle has",
                         planner.problem().stops[left.stop].quality_needed);
    case UnvisitedReason::no_way:
      return is_allowed(planner, left.stop) ? "no vehicle has a way there and on to where it ends"
                                            : "lies where the zones do not allow to fly";
    case UnvisitedReason::too_far:
      return fmt::format("a flight to it alone takes {:.0f} s, beyond the endurance", left.cost_alone);
    case UnvisitedReason::outweighed: return "the endurance is spent on others";
  }
  return {};
}

}  // namespace

double highest_altitude(const Task& task) {
  auto highest = task.altitude.height.value;
  for (const auto& point : task.points)
    if (point.altitude && point.altitude->above == task.altitude.above)
      highest = std::max(highest, point.altitude->height.value);
  return highest;
}

void check_altitudes(const PlanOptions& options, const Task& task) {
  const auto check = [&](const std::string& what, double altitude) {
    if (altitude < options.altitude_min_m || altitude > options.altitude_max_m)
      throw Failure{fmt::format("{}: flies at {:g} m: expected {:g} to {:g} (--altitude-min, --altitude-max)", what,
                                altitude, options.altitude_min_m, options.altitude_max_m)};
  };
  check("the plan", task.altitude.height.value);
  for (std::size_t i = 0; i < task.points.size(); ++i) {
    const auto& altitude = task.points[i].altitude;
    if (!altitude) continue;
    if (altitude->above == task.altitude.above)
      check(stop_name(task, i), altitude->height.value);
    else
      fmt::print(stderr, "{}: its altitude is not above home, so its limits are not checked\n", stop_name(task, i));
  }
}

void report_conflicts(const PlanOptions& options, const std::vector<planning::Conflict>& conflicts) {
  for (const auto& conflict : conflicts) {
    const auto latitude = degrees_from_radians(conflict.place.latitude);
    const auto longitude = degrees_from_radians(conflict.place.longitude);
    if (!options.json) {
      fmt::print("vehicles {} and {} would come within {:g} m after {:.0f} s, near {:.6f} {:.6f}\n", conflict.first + 1,
                 conflict.second + 1, options.separation_m, conflict.time.count(), latitude, longitude);
      continue;
    }
    JsonText line;
    line.begin_object().key("conflict").begin_array();
    line.value(std::uint64_t{conflict.first + 1}).value(std::uint64_t{conflict.second + 1}).end_array();
    line.member("time_s", conflict.time.count()).member("latitude", latitude).member("longitude", longitude);
    print_line(line.end_object());
  }
}

void report_vehicle(const PlanOptions& options, const Task& task, std::size_t index, const Flight& flight,
                    const vehicle::Mission& mission) {
  std::vector<std::uint64_t> points;
  std::vector<std::uint64_t> lines;
  for (const auto& leg : flight.legs)
    if (leg.stop) {
      if (leg.line)
        lines.push_back(*leg.stop - task.points.size() + 1);
      else
        points.push_back(*leg.stop + 1);
    }
  const auto whole = task.crafts[index].endurance.count() / (1 - options.reserve_percent / 100);
  const auto used = 100 * flight.time.count() / whole;
  const auto margin = whole - flight.time.count();
  if (!options.json) {
    fmt::print("vehicle {}: {} points, ", index + 1, points.size());
    if (!task.lines.empty()) fmt::print("{} survey lines, ", lines.size());
    fmt::print("{} items, {:.0f} m, {:.0f} s", mission.items.size(), flight.length.value, flight.time.count());
    if (std::isfinite(whole)) fmt::print(", energy {:.1f} %, margin {:.0f} s", used, margin);
    if (flight.added_altitude.value > 0) fmt::print(", {:g} m higher", flight.added_altitude.value);
    if (flight.wait.count() > 0) fmt::print(", takes off {:g} s later", flight.wait.count());
    fmt::print("\n");
    return;
  }
  JsonText line;
  const auto list = [&](std::string_view name, const std::vector<std::uint64_t>& numbers) {
    line.key(name).begin_array();
    for (const auto each : numbers) line.value(each);
    line.end_array();
  };
  line.begin_object().member("vehicle", static_cast<std::uint64_t>(index + 1)).member("length_m", flight.length.value);
  line.member("time_s", flight.time.count());
  line.member("added_altitude_m", flight.added_altitude.value).member("wait_s", flight.wait.count());
  if (std::isfinite(whole)) line.member("energy_percent", used).member("margin_s", margin);
  list("points", points);
  if (!task.lines.empty()) list("lines", lines);
  print_line(line.end_object());
}

void report_unvisited(const PlanOptions& options, const FlightPlanner& planner, const planning::Plan& plan) {
  const auto points = planner.task().points.size();
  for (const auto& left : planning::unvisited(planner.pass_problem(), plan)) {
    const auto why = reason_text(planner, left);
    if (!options.json) {
      fmt::print("not visited: {}: {}\n", stop_name(planner.task(), left.stop), why);
      continue;
    }
    JsonText line;
    line.begin_object();
    if (left.stop < points)
      line.member("unvisited", std::uint64_t{left.stop + 1});
    else
      line.member("unvisited_line", std::uint64_t{left.stop - points + 1});
    line.member("reason", std::string_view{why});
    print_line(line.end_object());
  }
}

}  // namespace ponte::app
