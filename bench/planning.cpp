// Times the planner's solvers on the instances in bench/planning, and prints one JSON object per figure for
// bench/planning.py. Limits are seconds of this thread's processor time, so that other work on the machine does not
// change the result.

#include "ponte/core/json_text.hpp"
#include "ponte/planning/solver.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace {

using namespace ponte;
using namespace ponte::planning;

struct Place {
  double x{};
  double y{};
};

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

double distance(Place a, Place b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::vector<Place> read_tsplib(const std::filesystem::path& path) {
  std::ifstream file{path};
  std::vector<Place> places;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words{line};
    int number{};
    Place place;
    if (words >> number >> place.x >> place.y) places.push_back(place);
  }
  if (places.empty()) throw std::runtime_error{path.string() + ": no coordinates"};
  return places;
}

/// The first place is the home of all vehicles; TSPLIB rounds distances to whole numbers.
Problem homecoming(std::vector<Place> places, std::size_t vehicles, bool is_rounded) {
  std::ranges::rotate(places, places.begin() + 1);
  const auto stops = places.size() - 1;
  CostMatrix costs{places.size()};
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < places.size(); ++b) {
      const auto exact = distance(places[a], places[b]);
      costs(a, b) = is_rounded ? std::floor(exact + 0.5) : exact;
    }
  return {.stops = std::vector<Stop>(stops),
          .vehicles = std::vector<Vehicle>(vehicles, {.start = stops, .ends = {stops}}),
          .costs = {costs},
          .objective = vehicles > 1 ? Objective::longest : Objective::total};
}

Problem heterogeneous(const nlohmann::json& instance) {
  Problem problem;
  std::vector<Place> places;
  for (const auto& stop : instance["stops"]) {
    places.push_back({stop["x"], stop["y"]});
    problem.stops.push_back({.quality_needed = stop["quality"]});
  }
  for (const auto& vehicle : instance["vehicles"]) places.push_back({vehicle["x"], vehicle["y"]});
  for (const auto& vehicle : instance["vehicles"]) {
    const auto home = problem.stops.size() + problem.vehicles.size();
    problem.vehicles.push_back(
        {.costs = problem.costs.size(), .start = home, .ends = {home}, .quality = vehicle["quality"]});
    auto& costs = problem.costs.emplace_back(places.size());
    for (std::size_t a = 0; a < places.size(); ++a)
      for (std::size_t b = 0; b < places.size(); ++b)
        costs(a, b) = distance(places[a], places[b]) / vehicle["speed"].get<double>();
  }
  return problem;
}

/// The objective of the best plan after each of these times, which rise.
std::vector<double> values_after(const Problem& problem, Method method, std::uint64_t seed,
                                 const std::vector<double>& seconds) {
  const auto start = processor_seconds();
  const auto solver = make_solver(problem, method, seed);
  std::vector<double> values;
  for (const auto limit : seconds) {
    while (processor_seconds() - start < limit) solver->improve(method == Method::best ? 50 : 5000);
    const auto found = figures(problem, solver->best());
    values.push_back(problem.objective == Objective::total ? found.total : found.longest);
  }
  return values;
}

void print(const std::string& name, double value, const char* unit) {
  JsonText json;
  json.begin_object().member("case", std::string_view{name}).member("value", value).member("unit", unit).end_object();
  fmt::print("{}\n", json.text());
  std::fflush(stdout);
}

struct Tour {
  const char* name;
  double optimum;
};
constexpr Tour tours[] = {{"eil51", 426},     {"berlin52", 7542}, {"st70", 675},      {"eil76", 538},   {"rat99", 1211},
                          {"kroA100", 21282}, {"lin105", 14379},  {"kroA200", 29368}, {"pcb442", 50778}};

/// How many of ten seeds find the optimum in one second; for the large one, the worst gap of ten seeds in five.
void bench_tours(const std::filesystem::path& folder) {
  for (const auto& tour : tours) {
    const auto problem = homecoming(read_tsplib(folder / "tsplib" / (std::string{tour.name} + ".tsp")), 1, true);
    const bool is_large = problem.stops.size() > 200;
    int optima = 0;
    double worst = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto length = values_after(problem, Method::best, seed, {is_large ? 5.0 : 1.0}).front();
      if (length <= tour.optimum) ++optima;
      worst = std::max(worst, 100 * (length / tour.optimum - 1));
    }
    if (is_large)
      print(fmt::format("{} worst gap 5 s", tour.name), worst, "%");
    else
      print(fmt::format("{} optimum 1 s", tour.name), optima, "of 10");
  }
}

struct LongestRoute {
  const char* name;
  std::size_t vehicles;
  double best_known;
};
constexpr LongestRoute longest_routes[] = {
    {"eil51", 2, 222.73},     {"eil51", 3, 159.57},     {"eil51", 5, 118.13},     {"eil51", 7, 112.07},
    {"berlin52", 2, 4110.21}, {"berlin52", 3, 3069.59}, {"berlin52", 5, 2440.92}, {"berlin52", 7, 2440.92},
    {"eil76", 2, 280.85},     {"eil76", 3, 195.72},     {"eil76", 5, 142.88},     {"eil76", 7, 127.56},
    {"rat99", 2, 665.99},     {"rat99", 3, 517.72},     {"rat99", 5, 450.18},     {"rat99", 7, 438.65}};

/// The gap of the longest route to the best known one after 0.1, 1 and 10 seconds, for both methods, and the means.
void bench_longest_routes(const std::filesystem::path& folder) {
  const std::vector<double> seconds{0.1, 1, 10};
  std::map<std::string, double> sums;
  for (const auto& each : longest_routes) {
    const auto places = read_tsplib(folder / "tsplib" / (std::string{each.name} + ".tsp"));
    const auto problem = homecoming(places, each.vehicles, false);
    for (const auto method : {Method::best, Method::annealing}) {
      const auto values = values_after(problem, method, 1, seconds);
      for (std::size_t i = 0; i < seconds.size(); ++i) {
        const auto gap = 100 * (values[i] / each.best_known - 1);
        const auto what = fmt::format("{}{:g} s", method == Method::annealing ? "annealing " : "", seconds[i]);
        print(fmt::format("{}-m{} gap {}", each.name, each.vehicles, what), gap, "%");
        sums[what] += gap;
      }
    }
  }
  for (const auto& [what, sum] : sums)
    print(fmt::format("longest route mean gap {}", what), sum / static_cast<double>(std::size(longest_routes)), "%");
}

/// The gap to the lower bound after ten seconds, for both methods.
void bench_heterogeneous(const std::filesystem::path& folder) {
  std::ifstream file{folder / "generated.json"};
  for (const auto& instance : nlohmann::json::parse(file)) {
    const auto problem = heterogeneous(instance);
    for (const auto method : {Method::best, Method::annealing}) {
      const auto value = values_after(problem, method, 1, {10}).front();
      print(fmt::format("{} gap to bound{} 10 s", instance["name"].get<std::string>(),
                        method == Method::annealing ? " annealing" : ""),
            100 * (value / instance["lower_bound"].get<double>() - 1), "%");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view group = argc == 3 ? argv[2] : "all";
  const auto is_wanted = [&](std::string_view name) { return group == "all" || group == name; };
  if (argc < 2 || argc > 3 || !(is_wanted("tours") || is_wanted("longest") || is_wanted("heterogeneous"))) {
    fmt::print(stderr, "usage: bench_planning FOLDER [tours|longest|heterogeneous]\n");
    return 2;
  }
  try {
    const std::filesystem::path folder{argv[1]};
    if (is_wanted("tours")) bench_tours(folder);
    if (is_wanted("longest")) bench_longest_routes(folder);
    if (is_wanted("heterogeneous")) bench_heterogeneous(folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_planning: {}\n", error.what());
    return 1;
  }
  return 0;
}
