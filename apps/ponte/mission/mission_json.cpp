#include "mission/mission_json.hpp"

#include "common/json_line.hpp"
#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/numbered_items.hpp"
#include "ponte/planning/formats/point_draft.hpp"

#include <string_view>

namespace ponte::app {
namespace {

JsonText& append(JsonText& json, const vehicle::Place& place) {
  return json.member("latitude", degrees_from_radians(place.latitude))
      .member("longitude", degrees_from_radians(place.longitude));
}

JsonText& append(JsonText& json, const vehicle::Altitude& altitude) {
  return json.member("altitude", altitude.height.value).member("altitude_above", planning::name_of(altitude.above));
}

JsonText& begin(JsonText& json, std::string_view type) { return json.begin_object().member("type", type); }

void end(JsonText& json) {
  json.end_object();
  print_line(json);
}

void print_settings(JsonText& json, const vehicle::Mission& mission) {
  begin(json, "settings")
      .member("autopilot", unsigned{mission.autopilot})
      .member("airframe", unsigned{mission.airframe});
  if (mission.cruise_speed) json.member("cruise_speed", mission.cruise_speed->value);
  if (mission.hover_speed) json.member("hover_speed", mission.hover_speed->value);
  end(json);
  if (!mission.home) return;
  append(begin(json, "home"), mission.home->place).member("altitude", mission.home->altitude_msl.value);
  end(json.member("altitude_above", "msl"));
}

void print_item(JsonText& json, const vehicle::MissionItem& item, const planning::NumberedItem& numbered) {
  const auto& command = numbered.command;
  begin(json, "item")
      .member("number", std::uint64_t{numbered.number})
      .member("what", std::string_view{planning::title_of(item.action)});
  if (!item.name.empty()) json.member("name", std::string_view{item.name});
  if (item.waits) json.member("waits", true);
  json.member("command", unsigned{command.command}).member("frame", unsigned{command.frame});
  json.key("parameters").begin_array();
  for (const double parameter : command.parameters) json.value(parameter);
  end(json.end_array());
}

void print_zones(JsonText& json, const vehicle::Mission& mission) {
  for (const auto& fence : mission.fence_polygons) {
    begin(json, "fence_polygon").member("inclusion", fence.inclusion).key("corners").begin_array();
    for (const auto& corner : fence.corners) append(json.begin_object(), corner).end_object();
    end(json.end_array());
  }
  for (const auto& fence : mission.fence_circles)
    end(append(begin(json, "fence_circle").member("inclusion", fence.inclusion), fence.centre)
            .member("radius", fence.radius.value));
  if (mission.fence_return)
    end(append(append(begin(json, "fence_return"), mission.fence_return->place), mission.fence_return->altitude));
  for (const auto& point : mission.rally_points)
    end(append(append(begin(json, "rally_point"), point.place), point.altitude));
}

void print_point(JsonText& json, const planning::PointOfInterest& point) {
  append(begin(json, "point"), point.place);
  if (point.altitude) append(json, *point.altitude);
  if (point.dwell.count() > 0) json.member(planning::dwell_name, point.dwell.count());
  if (point.priority) json.member(planning::priority_name, *point.priority);
  if (point.sensor_quality) json.member(planning::sensor_quality_name, *point.sensor_quality);
  if (!point.name.empty()) json.member("name", std::string_view{point.name});
  end(json.member("where", std::string_view{to_text(point.where)}));
}

}  // namespace

void print_json(const planning::MissionFile& content) {
  JsonText json;
  const auto& mission = content.mission;
  print_settings(json, mission);
  const auto numbered = planning::numbered(mission.items, 1);
  for (std::size_t i = 0; i < numbered.size(); ++i) print_item(json, mission.items[i], numbered[i]);
  for (const auto& pattern : mission.patterns)
    end(begin(json, "pattern")
            .member("kind", std::string_view{pattern.kind})
            .member("first_item", std::uint64_t{pattern.first + 1})
            .member("items", std::uint64_t{pattern.count})
            .member("text", std::string_view{pattern.text}));
  print_zones(json, mission);
  for (const auto& point : content.points) print_point(json, point);
}

}  // namespace ponte::app
