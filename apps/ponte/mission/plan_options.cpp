#include "mission/plan_options.hpp"

#include "common/failure.hpp"
#include "mission/settings.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

namespace ponte::app {
namespace {

/// Metres per second, of a copter that is not told another.
constexpr double usual_speed = 8;
/// The ways between all pairs of so many points still fit into the memory of a small computer.
constexpr std::size_t stops_max = 2000;
/// Of a vehicle that cannot turn on the spot, with each way of passing them.
constexpr std::size_t turning_stops_max = 200;
constexpr std::string_view vehicle_grammar =
    "keys start=LAT,LON end=LAT,LON (repeatable) speed=M/S turn-radius=M endurance=S quality=0..1, separated by "
    "semicolons";

vehicle::Place place(std::string_view text, const std::string& whole) {
  const auto [latitude, longitude] = split(text, ',');
  return {radians_from_degrees(number(latitude, whole, -90, 90)),
          radians_from_degrees(number(longitude, whole, -180, 180))};
}

planning::Craft craft_from(const PlanOptions& options, const std::string& text, const vehicle::Place& usual_start) {
  constexpr double day_s = 86400;
  planning::Craft craft{.start = usual_start,
                        .speed = MetresPerSecond{options.speed.value_or(usual_speed)},
                        .sets_speed = options.speed.has_value(),
                        .vertical_speed = MetresPerSecond{options.vertical_speed},
                        .turn_radius = Metres{options.turn_radius_m}};
  auto endurance = options.endurance_s > 0 ? options.endurance_s : planning::unlimited;
  for (std::string_view rest = text; !rest.empty();) {
    const auto [setting, others] = split(rest, ';');
    const auto [key, value] = split(setting, '=');
    rest = others;
    if (key == "start")
      craft.start = place(value, text);
    else if (key == "end")
      craft.ends.push_back(place(value, text));
    else if (key == "speed")
      craft.speed = MetresPerSecond{number(value, text, 0.1, 1000)};
    else if (key == "turn-radius")
      craft.turn_radius = Metres{number(value, text, 0, 10'000)};
    else if (key == "endurance")
      endurance = number(value, text, 1, 30 * day_s);
    else if (key == "quality")
      craft.quality = number(value, text, 0, 1);
    else
      throw UsageError{fmt::format("--vehicle '{}': there is no '{}': expected {}", text, key, vehicle_grammar)};
  }
  craft.endurance = vehicle::Seconds{endurance * (1 - options.reserve_percent / 100)};
  if (craft.ends.empty() && options.end == "return") craft.ends.push_back(craft.start);
  return craft;
}

planning::Wind wind_from(const std::string& text) {
  if (text.empty()) return {};
  const auto [speed, from] = split(text, '@');
  return {MetresPerSecond{number(speed, text, 0, 100)}, radians_from_degrees(number(from, text, 0, 360))};
}

void check_size(const planning::Task& task) {
  const auto stops = task.points.size() + task.lines.size();
  const bool turns = std::ranges::any_of(task.crafts, [](const auto& craft) { return craft.turn_radius.value > 0; });
  const auto most = turns ? turning_stops_max : stops_max;
  if (stops > most)
    throw Failure{fmt::format("{} points and lines are too many to plan at once{}: expected at most {}", stops,
                              turns ? " for vehicles with a turn radius" : "", most)};
}

/// The zones of another file.
void add_fence(vehicle::Mission& fence, const std::string& file) {
  MissionInput input;
  input.file = file;
  const auto other = load_mission(input).content.mission;
  if (other.fence_polygons.empty() && other.fence_circles.empty())
    throw Failure{fmt::format("{}: no zone is in it: expected the polygons or circles of a fence", file)};
  fence.fence_polygons.insert(fence.fence_polygons.end(), other.fence_polygons.begin(), other.fence_polygons.end());
  fence.fence_circles.insert(fence.fence_circles.end(), other.fence_circles.begin(), other.fence_circles.end());
}

}  // namespace

void add_plan_options(CLI::App& command, PlanOptions& options) {
  command.add_option("POINTS", options.input.file,
                     "Points of interest, in any format of `ponte mission convert`; not needed with --survey or "
                     "--corridor");
  add_mission_input_options(command, options.input);
  add_survey_options(command, options.survey);
  command.add_option("--output", options.outputs, "File to write, e.g. mission.plan; one for each vehicle that flies");
  command.add_option("--output-html", options.map, "A map of points, zones and routes to look at");
  command.add_option("--order", options.order, "Visit in the best order, or as given")
      ->check(CLI::IsMember({"best", "given"}))
      ->capture_default_str();
  command.add_option("--end", options.end, "Return and land, or land at the last point")
      ->check(CLI::IsMember({"return", "last-point"}))
      ->capture_default_str();
  command.add_option("--objective", options.objective, "Make the sum of all flights short, or the longest")
      ->check(CLI::IsMember({"total", "longest"}))
      ->capture_default_str();
  command.add_option("--vehicle", options.vehicles, fmt::format("One vehicle: {}", vehicle_grammar));
  command.add_option("--fence", options.fences, "A file with zones (.plan, KML, GeoJSON) beside those of POINTS");
  command.add_option("--wind", options.wind, "M/S@DEGREES, from where it blows, e.g. 5@270");
  command.add_option("--speed", options.speed, "Metres per second, which the mission sets; it counts with 8 without")
      ->check(CLI::Range(0.1, 1000.0));
  command.add_option("--turn-radius", options.turn_radius_m, "Metres, of a fixed wing; 0: it turns on the spot")
      ->check(CLI::Range(0.0, 10'000.0))
      ->capture_default_str();
  command.add_option("--vertical-speed", options.vertical_speed, "Of climb and descent, metres per second")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command.add_option("--endurance", options.endurance_s, "Seconds in the air; unlimited unless given")
      ->check(CLI::Range(1.0, 2.6e6));
  command.add_option("--reserve", options.reserve_percent, "Percent of the endurance that is kept back")
      ->check(CLI::Range(0.0, 99.0))
      ->capture_default_str();
  command.add_option("--margin", options.margin_m, "Metres to keep from the corners of zones")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  command.add_option("--altitude-max", options.altitude_max_m, "Highest altitude, metres")->capture_default_str();
  command.add_option("--altitude-min", options.altitude_min_m, "Lowest altitude, metres")->capture_default_str();
  command.add_option("--separation", options.separation_m, "Metres between vehicles at any time, or else --layer")
      ->check(CLI::Range(1.0, 10'000.0))
      ->capture_default_str();
  command.add_option("--layer", options.layer_m, "Metres of altitude that keep vehicles apart")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  command
      .add_option("--separate-by", options.separate_by, "Keep vehicles apart by altitude and time, or by time alone")
      ->check(CLI::IsMember({"altitude", "time"}))
      ->capture_default_str();
  command.add_option("--window", options.window_s, "Seconds that a vehicle may be early or late")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command.add_option("--wait", options.wait_s, "Seconds, of which a take-off is put off by a multiple where needed")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command.add_option("--solver", options.solver, "best, or sa: simulated annealing, to compare with")
      ->check(CLI::IsMember({"best", "sa"}))
      ->capture_default_str();
  command.add_option("--seconds", options.seconds, "Longest time to think")
      ->check(CLI::Range(0.01, 86400.0))
      ->capture_default_str();
  command.add_option("--tries", options.tries, "Longest work to do; the same tries and seed give the same plan")
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Of the solver's chances")->capture_default_str();
  command.add_flag("--pictures", options.pictures, "Take a picture at each point");
  command.add_flag("--json", options.json, "One JSON object per vehicle and per point left out");
  command.add_flag("--quiet", options.quiet, "No progress");
}

planning::Task task_from(const PlanOptions& options) {
  planning::Task task;
  if (options.input.file.empty() && !options.survey.is_wanted())
    throw UsageError{"mission plan: expected POINTS, --survey or --corridor"};
  if (!options.input.file.empty()) {
    auto content = load_mission(options.input).content;
    if (content.points.empty())
      throw Failure{
          fmt::format("{}: there are no points in it: a mission is given as points of interest", options.input.file)};
    task.points = std::move(content.points);
    task.fence = std::move(content.mission);
  }
  for (const auto& file : options.fences) add_fence(task.fence, file);
  const auto altitude = survey_altitude(options.survey).value_or(Metres{options.input.altitude_m.value_or(40)});
  task.altitude = {altitude, vehicle::AltitudeFrame::home};
  if (options.survey.is_wanted()) add_survey(options.survey, task);
  const auto& usual_start = task.points.empty() ? task.lines.front().begin : task.points.front().place;
  const auto vehicles = options.vehicles.empty() ? std::vector<std::string>{""} : options.vehicles;
  for (const auto& text : vehicles) task.crafts.push_back(craft_from(options, text, usual_start));
  task.margin = Metres{options.margin_m};
  task.wind = wind_from(options.wind);
  task.objective = options.objective == "total" ? planning::Objective::total : planning::Objective::longest;
  check_size(task);
  return task;
}

}  // namespace ponte::app
