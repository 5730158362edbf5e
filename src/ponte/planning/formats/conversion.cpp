#include "ponte/planning/formats/conversion.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace ponte::planning {
namespace {

/// The waypoint as a point, and what a point cannot say of it.
PointOfInterest point_from(const vehicle::WaypointItem& waypoint, const vehicle::MissionItem& item, std::size_t number,
                           Losses& losses) {
  if (waypoint.acceptance_radius != Metres{}) losses.add("acceptance radius", "item", number);
  if (waypoint.pass_radius != Metres{}) losses.add("pass radius", "item", number);
  if (waypoint.yaw) losses.add("yaw", "item", number);
  if (item.waits) losses.add("wait for the pilot", "item", number);
  return {.place = waypoint.place, .altitude = waypoint.altitude, .dwell = waypoint.dwell, .name = item.name};
}

/// Takes away what the format does not say.
void reduce(PointOfInterest& point, std::size_t number, const PointFields& says, Losses& losses) {
  const auto lose = [&](bool said, bool present, const char* what) {
    if (said || !present) return false;
    losses.add(what, "point", number);
    return true;
  };
  if (point.altitude) {
    const bool msl = point.altitude->above == vehicle::AltitudeFrame::msl;
    if (lose(msl ? says.msl_altitude : says.other_altitudes, true,
             msl ? "altitude" : "altitude that is not above mean sea level"))
      point.altitude.reset();
  }
  if (lose(says.dwell, point.dwell != vehicle::Seconds{}, "dwell")) point.dwell = {};
  if (lose(says.priority, point.priority.has_value(), "priority")) point.priority.reset();
  if (lose(says.sensor_quality, point.sensor_quality.has_value(), "sensor quality")) point.sensor_quality.reset();
  if (lose(says.name, !point.name.empty(), "name")) point.name.clear();
}

}  // namespace

PointsToWrite points_for(const MissionFile& content, const PointFields& format_says) {
  PointsToWrite result{.points = content.points, .losses = {}};
  Losses losses;
  const auto& items = content.mission.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (const auto* waypoint = std::get_if<vehicle::WaypointItem>(&items[i].action))
      result.points.push_back(point_from(*waypoint, items[i], i + 1, losses));
    else
      losses.add(title_of(items[i].action), "item", i + 1);
  }
  for (const auto& pattern : content.mission.patterns)
    losses.add(fmt::format("the pattern {} as a whole", pattern.kind));
  if (content.mission.home) losses.add("home");
  lose_zones(content.mission, format_says.fence_polygons, losses);
  lose_settings(content.mission, losses);
  for (std::size_t i = 0; i < result.points.size(); ++i) reduce(result.points[i], i + 1, format_says, losses);
  result.losses = losses.told();
  return result;
}

Result<MissionToWrite, FormatError> mission_for(const MissionFile& content) {
  MissionToWrite result{.mission = content.mission, .losses = {}};
  Losses losses;
  for (std::size_t i = 0; i < content.points.size(); ++i) {
    auto point = content.points[i];
    if (!point.altitude)
      return fail(FormatError{point.where, fmt::format("point {} has no altitude", i + 1),
                              "one for each waypoint of a mission (--altitude)"});
    reduce(point, i + 1, {.msl_altitude = true, .other_altitudes = true, .dwell = true, .name = true}, losses);
    const vehicle::WaypointItem waypoint{.place = point.place, .altitude = *point.altitude, .dwell = point.dwell};
    result.mission.items.push_back({.action = waypoint, .name = point.name});
  }
  result.losses = losses.told();
  return result;
}

void lose_zones(const vehicle::Mission& mission, bool fence_polygons_said, Losses& losses) {
  if (!fence_polygons_said)
    for (std::size_t i = 0; i < mission.fence_polygons.size(); ++i) losses.add("fence", "polygon", i + 1);
  for (std::size_t i = 0; i < mission.fence_circles.size(); ++i) losses.add("fence", "circle", i + 1);
  if (mission.fence_return) losses.add("where to go after a breach of the fence");
  for (std::size_t i = 0; i < mission.rally_points.size(); ++i) losses.add("rally", "point", i + 1);
}

void lose_settings(const vehicle::Mission& mission, Losses& losses) {
  if (mission.cruise_speed) losses.add("cruise speed");
  if (mission.hover_speed) losses.add("hover speed");
  if (mission.autopilot != 0 || mission.airframe != 0) losses.add("kind of autopilot and airframe");
}

std::string title_of(const vehicle::Action& action) {
  if (const auto* other = std::get_if<vehicle::OtherItem>(&action)) return fmt::format("command {}", other->command);
  static constexpr std::array titles{
      "take-off", "waypoint",        "loiter",        "land",          "return",  "speed", "delay",
      "jump",     "camera distance", "take pictures", "stop pictures", "look at", "gimbal"};
  static_assert(titles.size() + 1 == std::variant_size_v<vehicle::Action>);
  return titles[action.index()];
}

}  // namespace ponte::planning
