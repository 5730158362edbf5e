#include "mission/plan.hpp"

#include "common/failure.hpp"
#include "common/load_file.hpp"
#include "mission/plan_map.hpp"
#include "mission/plan_options.hpp"
#include "mission/plan_report.hpp"
#include "ponte/planning/flight_mission.hpp"
#include "ponte/planning/pass_search.hpp"
#include "ponte/planning/separation.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <span>

namespace ponte::app {
namespace {

using planning::Flight;
using planning::FlightPlanner;
using planning::Plan;
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

/// Lets solvers think, one after the other, for equal parts of the time and of the tries.
class Thinking {
 public:
  Thinking(const PlanOptions& options, double solvers)
      : seconds_{options.seconds / solvers},
        tries_{static_cast<std::uint64_t>(static_cast<double>(options.tries) / solvers)},
        progress_{!options.quiet} {}

  void improve(planning::Solver& solver) {
    const auto start = Clock::now();
    constexpr std::uint64_t portion = 100;
    for (std::uint64_t done = 0; done < tries_; done += portion) {
      const auto thought = std::chrono::duration<double>(Clock::now() - start).count();
      if (thought >= seconds_) break;
      progress_.show(std::max(thought / seconds_, static_cast<double>(done) / static_cast<double>(tries_)));
      solver.improve(std::min(portion, tries_ - done));
    }
    progress_.end();
  }

 private:
  double seconds_;
  std::uint64_t tries_;
  Progress progress_;
};

Plan in_given_order(const FlightPlanner& planner) {
  if (planner.problem().vehicles.size() != 1) throw UsageError{"--order given: expected one vehicle"};
  Plan plan;
  plan.routes.emplace_back(planner.problem().stops.size());
  std::iota(plan.routes[0].begin(), plan.routes[0].end(), std::size_t{0});
  const auto& vehicle = planner.problem().vehicles[0];
  const auto cost = planning::best_passes(planner.pass_problem(), vehicle, plan.routes[0]).cost;
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
  Thinking thinking{options, planner.has_passes() ? 2.0 : 1.0};
  thinking.improve(*solver);
  if (!planner.has_passes()) return solver->best();
  planning::PassSearch search{planner.pass_problem(), solver->best(), options.seed};
  thinking.improve(search);
  return search.best();
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

/// The flights kept apart, after the conflicts of those that are not have been told.
std::vector<Flight> flights_apart(const PlanOptions& options, const FlightPlanner& planner, const Plan& plan) {
  const auto highest = highest_altitude(planner.task());
  planning::Separation separation{.distance = Metres{options.separation_m},
                                  .height = Metres{options.layer_m},
                                  .window = vehicle::Seconds{options.window_s},
                                  .wait = vehicle::Seconds{options.wait_s},
                                  .layers_max = 1};
  if (options.separate_by == "altitude")
    separation.layers_max += static_cast<int>((options.altitude_max_m - highest) / options.layer_m);
  auto flights = planner.flights(plan);
  const auto found = planning::conflicts(flights, separation);
  planning::separate(flights, planner.task().crafts, separation);
  report_conflicts(options, found);
  if (const auto left = planning::conflicts(flights, separation); !left.empty())
    throw Failure{fmt::format("vehicles {} and {} cannot be kept {:g} m apart: expected a lower --separation",
                              left[0].first + 1, left[0].second + 1, options.separation_m)};
  return flights;
}

void run(const PlanOptions& options) {
  const FlightPlanner planner{task_from(options)};
  const auto& task = planner.task();
  if (const auto checked = planning::check(planner.problem()); !checked) throw Failure{checked.error()};
  check_altitudes(options, task);
  for (std::size_t i = 0; i < task.crafts.size(); ++i)
    if (!planner.airspace().allows(task.crafts[i].start))
      throw Failure{fmt::format("vehicle {}: it starts where the zones do not allow to fly", i + 1)};

  const auto plan = options.order == "given" ? in_given_order(planner) : best_plan(planner, options);
  const auto flights = flights_apart(options, planner, plan);
  std::vector<vehicle::Mission> missions;
  for (std::size_t i = 0; i < flights.size(); ++i)
    missions.push_back(planning::mission_of(task, i, flights[i], options.pictures));
  write_missions(options, missions);
  if (!options.map.empty()) {
    const auto page = map_page(task, flights);
    save_file(options.map, std::as_bytes(std::span{page}));
  }
  for (std::size_t i = 0; i < flights.size(); ++i) report_vehicle(options, task, i, flights[i], missions[i]);
  report_unvisited(options, planner, plan);
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
