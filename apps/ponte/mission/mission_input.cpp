#include "mission/mission_input.hpp"

#include "common/failure.hpp"
#include "common/load_file.hpp"
#include "ponte/planning/formats/poi.hpp"
#include "ponte/planning/formats/point_draft.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

namespace ponte::app {
namespace {

using planning::Where;

std::vector<std::string> layout_names() {
  std::vector<std::string> names;
  for (const auto layout : planning::poi_layouts) names.emplace_back(name_of(layout));
  return names;
}

std::string place_prefix(const std::string& file, const Where& where) {
  return where.unit == Where::Unit::nowhere ? file + ": " : fmt::format("{}: {}: ", file, to_text(where));
}

planning::ReadOptions read_options(const MissionInput& input) {
  planning::ReadOptions options;
  options.bare_polygons_are_inclusions = input.bare_polygons_are_inclusions;
  for (const auto layout : planning::poi_layouts)
    if (name_of(layout) == input.poi_layout) options.poi_layout = layout;
  for (const auto frame : planning::altitude_frames)
    if (planning::name_of(frame) == input.altitude_above) options.altitude_above = frame;
  return options;
}

planning::Format format_of(const MissionInput& input, Bytes bytes) {
  if (!input.format.empty()) return planning::format_named(input.format).value();
  const auto format = planning::detect_format(bytes, input.file);
  if (!format) throw Failure{to_text(input.file, format.error())};
  return *format;
}

bool holds_nothing(const planning::MissionFile& content) {
  const auto& mission = content.mission;
  return content.points.empty() && mission.items.empty() && mission.patterns.empty() && !mission.home &&
         mission.fence_polygons.empty() && mission.fence_circles.empty() && mission.rally_points.empty();
}

}  // namespace

void add_mission_input_options(CLI::App& command, MissionInput& input) {
  command.add_option("--from", input.format, "Format of the input, if its content does not tell")
      ->check(CLI::IsMember(planning::format_names()));
  command.add_option("--poi-layout", input.poi_layout, "How the values of a path.poi are written, if they do not tell")
      ->check(CLI::IsMember(layout_names()));
  command.add_option("--altitude-above", input.altitude_above, "What altitudes count from, if the input does not tell")
      ->check(CLI::IsMember({"msl", "home", "terrain"}));
  command.add_option("--altitude", input.altitude_m,
                     "Metres, of points without an altitude; above home, or --altitude-above");
}

LoadedMission load_mission(const MissionInput& input) {
  const auto file = load_file(input.file);
  if (!file.damage.empty()) throw Failure{fmt::format("{}: damaged at {}", input.file, file.damage)};
  const auto format = format_of(input, file.bytes);
  const auto options = read_options(input);
  auto reading = planning::read_mission_file(format, file.bytes, options);
  if (!reading) throw Failure{to_text(input.file, reading.error())};
  if (holds_nothing(reading->content))
    throw Failure{fmt::format("{}: there is nothing in it: expected points or a mission", input.file)};
  for (const auto& [where, text] : reading->remarks)
    fmt::print(stderr, "{}{}\n", place_prefix(input.file, where), text);
  if (input.altitude_m)
    for (auto& point : reading->content.points)
      if (!point.altitude)
        point.altitude =
            vehicle::Altitude{Metres{*input.altitude_m}, options.altitude_above.value_or(vehicle::AltitudeFrame::home)};
  return {format, std::move(reading->content)};
}

std::string to_text(const std::string& file, const planning::FormatError& error) {
  return fmt::format("{}{}: expected {}", place_prefix(file, error.where), error.what, error.expectation);
}

}  // namespace ponte::app
