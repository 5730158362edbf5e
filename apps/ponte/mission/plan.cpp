#include "mission/plan.hpp"

#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "common/load_file.hpp"
#include "mission/plan_map.hpp"
#include "mission/plan_options.hpp"
#include "ponte/planning/solver.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numeric>

namespace ponte::app {
namespace {

using planning::Flight;
using planning::FlightPlanner;
using planning::Plan;
using planning::UnvisitedReason;
using Clock = std::chrono::steady_clock;

/// A bar on the terminal; silent when stderr is none.
class Progress {
 public:
  explicit Progress(bool is_wanted) : is_shown_{is_wanted && isatty(STDERR_FILENO) != 0} {}
  void show(double part) {
    constexpr int width = 40;
    const auto filled = static_cast<int>(part * width);
    if (!is_shown_ || filled == filled_) return;
    filled_ = filled;
    fmt::print(stderr, "\rplanning [{:<{}}]", std::string(static_cast<std::size_t>(filled), '#'), width);
  }
  void end() const {
    if (is_shown_) fmt::print(stderr, "\r{:{}}\r", "", 52);
  }

 private:
  bool is_shown_;
  int filled_{-1};
};

Plan in_given_order(const FlightPlanner& planner) {
  if (planner.problem().vehicles.size() != 1) throw UsageError{"--order given: expected one vehicle"};
  Plan plan;
  plan.routes.emplace_back(planner.problem().stops.size());
  std::iota(plan.routes[0].begin(), plan.routes[0].end(), std::size_t{0});
  const auto& vehicle = planner.problem().vehicles[0];
  const auto cost = planning::route_cost(planner.problem(), vehicle, plan.routes[0]);
  if (!std::isfinite(cost)) throw Failure{"the given order cannot be flown: a point has no way to it"};
  if (cost > vehicle.endurance)
    throw Failure{
        fmt::format("the given order takes {:.0f} s and the vehicle has {:.0f} s: expected fewer points, or "
                    "--order best, which leaves some out",
                    cost, vehicle.endurance)};
  return plan;
}

Plan best_plan(const FlightPlanner& planner, const PlanOptions& options) {
  const auto method = options.solver == "sa" ? planning::Method::annealing : planning::Method::best;
  const auto solver = planning::make_solver(planner.problem(), method, options.seed);
  Progress progress{!options.quiet};
  const auto start = Clock::now();
  constexpr std::uint64_t portion = 100;
  for (std::uint64_t done = 0; done < options.tries; done += portion) {
    const auto thought = std::chrono::duration<double>(Clock::now() - start).count();
    if (thought >= options.seconds) break;
    progress.show(std::max(thought / options.seconds, static_cast<double>(done) / static_cast<double>(options.tries)));
    solver->improve(std::min(portion, options.tries - done));
  }
  progress.end();
  return solver->best();
}

std::string point_name(const planning::PointOfInterest& point, std::size_t index) {
  auto name = fmt::format("point {}", index + 1);
  if (!point.name.empty()) name += fmt::format(" '{}'", point.name);
  if (point.where.unit != planning::Where::Unit::nowhere) name += fmt::format(" ({})", to_text(point.where));
  return name;
}

std::string reason_text(const FlightPlanner& planner, const planning::Unvisited& left) {
  const auto& point = planner.task().points[left.stop];
  switch (left.reason) {
    case UnvisitedReason::no_sensor:
      return fmt::format("needs a sensor quality of {}, which no vehicle has", point.sensor_quality.value_or(0));
    case UnvisitedReason::no_way:
      return planner.airspace().allows(point.place) ? "no vehicle has a way there and on to where it ends"
                                                    : "lies where the zones do not allow to fly";
    case UnvisitedReason::too_far:
      return fmt::format("a flight to it alone takes {:.0f} s, beyond the endurance", left.cost_alone);
    case UnvisitedReason::outweighed: return "the endurance is spent on other points";
  }
  return {};
}

void check_altitudes(const PlanOptions& options, const FlightPlanner& planner, int highest_layer) {
  const auto check = [&](const std::string& what, double altitude) {
    const auto highest = altitude + highest_layer * options.layer_m;
    if (altitude < options.altitude_min_m || highest > options.altitude_max_m)
      throw Failure{
          fmt::format("{}: flies at {:g} to {:g} m with its layers: expected {:g} to {:g} (--altitude-min, "
                      "--altitude-max)",
                      what, altitude, highest, options.altitude_min_m, options.altitude_max_m)};
  };
  const auto& task = planner.task();
  check("the plan", task.altitude.height.value);
  for (std::size_t i = 0; i < task.points.size(); ++i) {
    const auto& altitude = task.points[i].altitude;
    if (!altitude) continue;
    if (altitude->above == task.altitude.above)
      check(point_name(task.points[i], i), altitude->height.value);
    else
      fmt::print(stderr, "{}: its altitude is not above home, so its limits are not checked\n",
                 point_name(task.points[i], i));
  }
}

/// "out.plan" for one vehicle, "out-2.plan" for the second of several.
std::string output_name(const std::string& output, std::size_t index, std::size_t count) {
  if (count == 1) return output;
  const std::filesystem::path path{output};
  return (path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), index + 1, path.extension().string()))
      .string();
}

void write_missions(const PlanOptions& options, const std::vector<vehicle::Mission>& missions) {
  for (const auto& output : options.outputs) {
    const auto format = planning::format_of_name(output);
    if (!format) throw UsageError{fmt::format("{}: the name tells no format", output)};
    for (std::size_t i = 0; i < missions.size(); ++i) {
      if (missions[i].items.empty()) continue;
      const auto name = output_name(output, i, missions.size());
      const auto writing = planning::write_mission_file(*format, {.points = {}, .mission = missions[i]});
      if (!writing) throw Failure{to_text(name, writing.error())};
      save_file(name, writing->bytes);
      for (const auto& loss : writing->losses) fmt::print(stderr, "{}: lost: {}\n", name, loss);
    }
  }
}

void print_vehicle(const PlanOptions& options, const planning::Craft& craft, std::size_t index, const Flight& flight,
                   const vehicle::Mission& mission, int layer) {
  std::vector<std::size_t> order;
  for (const auto& leg : flight.legs)
    if (leg.point) order.push_back(*leg.point + 1);
  const auto whole = craft.endurance.count() / (1 - options.reserve_percent / 100);
  const auto used = 100 * flight.time.count() / whole;
  const auto margin = whole - flight.time.count();
  if (!options.json) {
    fmt::print("vehicle {}: {} points, {} items, {:.0f} m, {:.0f} s", index + 1, order.size(), mission.items.size(),
               flight.length.value, flight.time.count());
    if (std::isfinite(whole)) fmt::print(", energy {:.1f} %, margin {:.0f} s", used, margin);
    fmt::print("{}\n", layer > 0 ? fmt::format(", {:g} m higher", layer * options.layer_m) : "");
    return;
  }
  JsonText line;
  line.begin_object().member("vehicle", static_cast<std::uint64_t>(index + 1)).member("length_m", flight.length.value);
  line.member("time_s", flight.time.count()).member("layer", layer);
  if (std::isfinite(whole)) line.member("energy_percent", used).member("margin_s", margin);
  line.key("points").begin_array();
  for (const auto point : order) line.value(std::uint64_t{point});
  line.end_array().end_object();
  print_line(line);
}

void print_unvisited(const PlanOptions& options, const FlightPlanner& planner, const Plan& plan) {
  for (const auto& left : planning::unvisited(planner.problem(), plan)) {
    const auto why = reason_text(planner, left);
    if (!options.json) {
      fmt::print("not visited: {}: {}\n", point_name(planner.task().points[left.stop], left.stop), why);
      continue;
    }
    JsonText line;
    line.begin_object().member("unvisited", static_cast<std::uint64_t>(left.stop + 1));
    line.member("reason", std::string_view{why}).end_object();
    print_line(line);
  }
}

void run(const PlanOptions& options) {
  const FlightPlanner planner{task_from(options, load_mission(options.input).content)};
  const auto& task = planner.task();
  if (const auto checked = planning::check(planner.problem()); !checked) throw Failure{checked.error()};
  for (std::size_t i = 0; i < task.crafts.size(); ++i)
    if (!planner.airspace().allows(task.crafts[i].start))
      throw Failure{fmt::format("vehicle {}: it starts where the zones do not allow to fly", i + 1)};

  const auto plan = options.order == "given" ? in_given_order(planner) : best_plan(planner, options);
  const auto flights = planner.flights(plan);
  const auto layers = planning::layers(task.crafts, flights, Metres{2 * options.margin_m});
  check_altitudes(options, planner, *std::ranges::max_element(layers));
  std::vector<vehicle::Mission> missions;
  for (std::size_t i = 0; i < flights.size(); ++i)
    missions.push_back(planning::mission_of(task.crafts[i], flights[i], task.points,
                                            {.added_altitude = Metres{layers[i] * options.layer_m},
                                             .wait = vehicle::Seconds{layers[i] * options.wait_s},
                                             .takes_pictures = options.pictures}));
  write_missions(options, missions);
  if (!options.map.empty()) {
    const auto page = map_page(planner, flights);
    std::vector<std::byte> bytes(page.size());
    std::memcpy(bytes.data(), page.data(), page.size());
    save_file(options.map, bytes);
  }
  for (std::size_t i = 0; i < flights.size(); ++i)
    print_vehicle(options, task.crafts[i], i, flights[i], missions[i], layers[i]);
  print_unvisited(options, planner, plan);
}

}  // namespace

void add_mission_plan(CLI::App& mission) {
  auto options = std::make_shared<PlanOptions>();
  auto* command = mission.add_subcommand("plan", "Points of interest in, the best routes out");
  add_plan_options(*command, *options);
  command->footer(
      "Example:\n  ponte mission plan tests/vectors/missions/path_2016.poi --output mission.plan "
      "--output-html map.html");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
