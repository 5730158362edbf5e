#include "mission/survey_options.hpp"

#include "common/failure.hpp"
#include "mission/mission_input.hpp"
#include "mission/settings.hpp"
#include "ponte/planning/survey.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iterator>

namespace ponte::app {
namespace {

constexpr std::string_view camera_grammar =
    "keys sensor=WIDTHxHEIGHT (mm) focal=MM pixels=ACROSS, separated by semicolons, e.g. "
    "sensor=13.2x8.8;focal=8.8;pixels=5472";

planning::Camera camera_from(const std::string& text) {
  planning::Camera camera;
  const auto millimetres = [&](std::string_view value) { return Metres{number(value, text, 0.1, 1000) / 1000}; };
  for (std::string_view rest = text; !rest.empty();) {
    const auto [setting, others] = split(rest, ';');
    const auto [key, value] = split(setting, '=');
    rest = others;
    if (key == "sensor") {
      const auto [width, height] = split(value, 'x');
      camera.sensor_width = millimetres(width);
      camera.sensor_height = millimetres(height);
    } else if (key == "focal") {
      camera.focal_length = millimetres(value);
    } else if (key == "pixels") {
      camera.pixels_across = number(value, text, 1, 1e6);
    } else {
      throw UsageError{fmt::format("--camera '{}': there is no '{}': expected {}", text, key, camera_grammar)};
    }
  }
  if (camera.sensor_width.value == 0 || camera.focal_length.value == 0 || camera.pixels_across == 0)
    throw UsageError{fmt::format("--camera '{}': something is missing: expected {}", text, camera_grammar)};
  return camera;
}

planning::SurveyStyle style_from(const SurveyOptions& options, const planning::Camera& camera, Metres height) {
  planning::SurveyStyle style{.footprint = planning::footprint(camera, height),
                              .side_overlap = options.side_overlap_percent / 100,
                              .front_overlap = options.front_overlap_percent / 100,
                              .turnaround = Metres{options.turnaround_m}};
  if (options.angle_deg) style.course = radians_from_degrees(*options.angle_deg);
  return style;
}

planning::MissionFile load_shapes(const std::string& file) {
  MissionInput input;
  input.file = file;
  input.bare_polygons_are_inclusions = true;
  return load_mission(input).content;
}

void add_lines(planning::Task& task, const std::string& file,
               Result<std::vector<planning::SurveyLine>, std::string> lines) {
  if (!lines) throw Failure{fmt::format("{}: {}", file, lines.error())};
  std::ranges::move(*lines, std::back_inserter(task.lines));
}

/// Areas to take pictures of; those not to fly in become zones.
void add_areas(planning::Task& task, const std::string& file, const planning::SurveyStyle& style) {
  const auto before = task.lines.size();
  for (auto& polygon : load_shapes(file).mission.fence_polygons)
    if (polygon.inclusion)
      add_lines(task, file, planning::survey(polygon.corners, style));
    else
      task.fence.fence_polygons.push_back(std::move(polygon));
  if (task.lines.size() == before)
    throw Failure{fmt::format("{}: no polygon is in it: expected an area to take pictures of", file)};
}

void add_corridor(planning::Task& task, const std::string& file, Metres width, const planning::SurveyStyle& style) {
  std::vector<vehicle::Place> line;
  for (const auto& point : load_shapes(file).points) line.push_back(point.place);
  add_lines(task, file, planning::corridor(line, width, style));
}

}  // namespace

void add_survey_options(CLI::App& command, SurveyOptions& options) {
  command.add_option("--survey", options.areas, "A file with polygons to take pictures of (GeoJSON, KML, .plan)");
  auto* const corridor =
      command.add_option("--corridor", options.corridors, "A file with a line to take pictures along; with --width");
  command.add_option("--width", options.width_m, "Metres, of the corridor")
      ->check(CLI::Range(1.0, 10'000.0))
      ->needs(corridor);
  command.add_option("--camera", options.camera, fmt::format("The camera: {}", camera_grammar));
  command.add_option("--gsd", options.gsd_cm, "Ground sampling distance, centimetres per pixel, instead of --altitude")
      ->check(CLI::Range(0.01, 1000.0));
  command.add_option("--side-overlap", options.side_overlap_percent, "Percent, of pictures of neighbouring lines")
      ->check(CLI::Range(0.0, 95.0))
      ->capture_default_str();
  command.add_option("--front-overlap", options.front_overlap_percent, "Percent, of pictures of one line")
      ->check(CLI::Range(0.0, 95.0))
      ->capture_default_str();
  command.add_option("--turnaround", options.turnaround_m, "Turnaround distance: metres straight on beyond each line")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command
      .add_option("--angle", options.angle_deg, "Degrees from north, of the lines; the best side of the area without")
      ->check(CLI::Range(-360.0, 360.0));
}

std::optional<Metres> survey_altitude(const SurveyOptions& options) {
  if (!options.gsd_cm) return std::nullopt;
  return planning::height_for(camera_from(options.camera), Metres{*options.gsd_cm / 100});
}

void add_survey(const SurveyOptions& options, planning::Task& task) {
  if (!options.corridors.empty() && options.width_m == 0) throw UsageError{"--corridor: expected --width as well"};
  const auto camera = camera_from(options.camera);
  const auto style = style_from(options, camera, task.altitude.height);
  for (const auto& file : options.areas) add_areas(task, file, style);
  for (const auto& file : options.corridors) add_corridor(task, file, Metres{options.width_m}, style);
  fmt::print(stderr, "pictures from {:.1f} m: {:.1f} m by {:.1f} m, {:.2f} cm per pixel, one each {:.1f} m\n",
             task.altitude.height.value, style.footprint.across.value, style.footprint.along.value,
             100 * planning::ground_sampling_distance(camera, task.altitude.height).value,
             task.lines.front().spacing.value);
}

}  // namespace ponte::app
