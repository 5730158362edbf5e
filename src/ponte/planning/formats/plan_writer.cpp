#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/numbered_items.hpp"
#include "ponte/planning/formats/plan.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ponte::planning {
namespace {

/// What JSON cannot say, NaN, is null in a plan.
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string number(const std::optional<MetresPerSecond>& speed) { return speed ? number(speed->value) : "null"; }

std::string position(const vehicle::Place& place) {
  return fmt::format("{}, {}", number(degrees_from_radians(place.latitude)),
                     number(degrees_from_radians(place.longitude)));
}

/// QGroundControl's AltitudeMode.
int altitude_mode(vehicle::AltitudeFrame frame) {
  switch (frame) {
    case vehicle::AltitudeFrame::home: return 1;
    case vehicle::AltitudeFrame::msl: return 2;
    case vehicle::AltitudeFrame::terrain: return 4;
  }
  return 0;
}

std::string simple_item(const NumberedItem& item) {
  const auto& command = item.command;
  std::vector<std::string> parameters;
  for (const double parameter : command.parameters) parameters.push_back(number(parameter));
  const auto frame = vehicle::altitude_frame(command.frame);
  const auto altitude = vehicle::has_place(command.command) && frame
                            ? fmt::format("\"AMSLAltAboveTerrain\": null, \"Altitude\": {}, \"AltitudeMode\": {}, ",
                                          number(command.parameters[6]), altitude_mode(*frame))
                            : "";
  return fmt::format(
      "{{\"type\": \"SimpleItem\", {}\"autoContinue\": {}, \"command\": {}, \"doJumpId\": {}, \"frame\": {}, "
      "\"params\": [{}]}}",
      altitude, !item.waits, command.command, item.number, command.frame, fmt::join(parameters, ", "));
}

/// The items, with patterns in the places of those that they made.
std::vector<std::string> item_texts(const vehicle::Mission& mission) {
  const auto items = numbered(mission.items, 1);
  std::vector<std::string> texts;
  auto pattern = mission.patterns.begin();
  for (std::size_t i = 0; i < items.size() || pattern != mission.patterns.end();) {
    if (pattern != mission.patterns.end() && pattern->first == i) {
      texts.push_back(pattern->text);
      i += pattern->count;
      ++pattern;
    } else {
      texts.push_back(simple_item(items[i++]));
    }
  }
  return texts;
}

std::string home_text(const std::optional<vehicle::Home>& home) {
  return home ? fmt::format("{}, {}", position(home->place), number(home->altitude_msl.value)) : "null, null, null";
}

std::string fence_text(const vehicle::FencePolygon& fence) {
  std::vector<std::string> corners;
  for (const auto& corner : fence.corners) corners.push_back(fmt::format("[{}]", position(corner)));
  return fmt::format("{{\"inclusion\": {}, \"polygon\": [{}], \"version\": 1}}", fence.inclusion,
                     fmt::join(corners, ", "));
}

std::string fence_text(const vehicle::FenceCircle& fence) {
  return fmt::format("{{\"circle\": {{\"center\": [{}], \"radius\": {}}}, \"inclusion\": {}, \"version\": 1}}",
                     position(fence.centre), number(fence.radius.value), fence.inclusion);
}

std::string point_text(const vehicle::RallyPoint& point) {
  return fmt::format("[{}, {}]", position(point.place), number(point.altitude.height.value));
}

/// The elements of an array, one to a line.
std::string lines(const std::vector<std::string>& elements) {
  return elements.empty() ? "" : fmt::format("\n      {}\n    ", fmt::join(elements, ",\n      "));
}

template <class Shape>
std::string fence_lines(const std::vector<Shape>& shapes) {
  std::vector<std::string> texts;
  for (const auto& shape : shapes) texts.push_back(fence_text(shape));
  return lines(texts);
}

/// The mode that all items share, or 0, mixed.
int global_altitude_mode(const vehicle::Mission& mission) {
  int shared = -1;
  for (const auto& item : mission.items) {
    const auto command = vehicle::express(item.action);
    const auto frame = vehicle::altitude_frame(command.frame);
    if (!frame || !vehicle::has_place(command.command)) continue;
    const int mode = altitude_mode(*frame);
    if (shared != -1 && shared != mode) return 0;
    shared = mode;
  }
  return std::max(shared, 0);
}

/// A plan's rally points count from home.
std::vector<std::string> rally_texts(const vehicle::Mission& mission, Losses& losses) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < mission.rally_points.size(); ++i) {
    if (mission.rally_points[i].altitude.above == vehicle::AltitudeFrame::home)
      texts.push_back(point_text(mission.rally_points[i]));
    else
      losses.add("rally, its altitude not above home,", "point", i + 1);
  }
  return texts;
}

}  // namespace

Result<Writing, FormatError> write_plan(const MissionFile& content) {
  auto to_write = mission_for(content);
  if (!to_write) return fail(to_write.error());
  const auto& mission = to_write->mission;
  Losses losses;
  for (std::size_t i = 0; i < mission.items.size(); ++i)
    if (!mission.items[i].name.empty()) losses.add("name", "item", i + 1);

  std::string text = "{\n  \"fileType\": \"Plan\",\n  \"groundStation\": \"ponte\",\n  \"version\": 1,\n";
  text += fmt::format(
      "  \"mission\": {{\n    \"version\": 2,\n    \"firmwareType\": {},\n    \"vehicleType\": {},\n    "
      "\"cruiseSpeed\": "
      "{},\n    \"hoverSpeed\": {},\n    \"globalPlanAltitudeMode\": {},\n    \"plannedHomePosition\": [{}],\n    "
      "\"items\": [{}]\n  }},\n",
      mission.autopilot, mission.airframe, number(mission.cruise_speed), number(mission.hover_speed),
      global_altitude_mode(mission), home_text(mission.home), lines(item_texts(mission)));
  const auto breach =
      mission.fence_return ? fmt::format(",\n    \"breachReturn\": {}", point_text(*mission.fence_return)) : "";
  text +=
      fmt::format("  \"geoFence\": {{\n    \"version\": 2,\n    \"circles\": [{}],\n    \"polygons\": [{}]{}\n  }},\n",
                  fence_lines(mission.fence_circles), fence_lines(mission.fence_polygons), breach);
  text += fmt::format("  \"rallyPoints\": {{\n    \"version\": 2,\n    \"points\": [{}]\n  }}\n}}\n",
                      lines(rally_texts(mission, losses)));

  auto told = std::move(to_write->losses);
  std::ranges::move(losses.told(), std::back_inserter(told));
  return Writing{bytes_from(text), std::move(told)};
}

}  // namespace ponte::planning
