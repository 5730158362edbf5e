#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/kml.hpp"
#include "ponte/planning/formats/point_draft.hpp"
#include "ponte/planning/formats/text.hpp"
#include "ponte/planning/formats/xml_text.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace ponte::planning {
namespace {

std::string position(const vehicle::Place& place, double altitude) {
  return fmt::format("{},{},{}", decimal_text(degrees_from_radians(place.longitude)),
                     decimal_text(degrees_from_radians(place.latitude)), decimal_text(altitude));
}

/// Adds a named value to the ExtendedData of a placemark.
void append_data(pugi::xml_node data, std::string_view name, const std::string& value) {
  auto node = data.append_child("Data");
  node.append_attribute("name").set_value(std::string{name}.c_str());
  append_text(node, "value", value);
}

void append_point(pugi::xml_node document, const PointOfInterest& point) {
  auto placemark = document.append_child("Placemark");
  if (!point.name.empty()) append_text(placemark, "name", point.name);
  auto data = placemark.append_child("ExtendedData");
  if (point.altitude) append_data(data, altitude_above_name, std::string{name_of(point.altitude->above)});
  if (point.dwell.count() > 0) append_data(data, dwell_name, decimal_text(point.dwell.count()));
  if (point.priority) append_data(data, priority_name, decimal_text(*point.priority));
  if (point.sensor_quality) append_data(data, sensor_quality_name, decimal_text(*point.sensor_quality));
  if (!data.first_child()) placemark.remove_child(data);

  auto shape = placemark.append_child("Point");
  if (point.altitude) {
    // KML has no heights above home; on a map those above ground come nearest.
    const bool msl = point.altitude->above == vehicle::AltitudeFrame::msl;
    append_text(shape, "altitudeMode", msl ? "absolute" : "relativeToGround");
  }
  append_text(shape, "coordinates", position(point.place, point.altitude ? point.altitude->height.value : 0));
}

void append_fence(pugi::xml_node document, const vehicle::FencePolygon& fence) {
  auto placemark = document.append_child("Placemark");
  append_data(placemark.append_child("ExtendedData"), "fence", fence.inclusion ? "inclusion" : "exclusion");
  auto ring = placemark.append_child("Polygon").append_child("outerBoundaryIs").append_child("LinearRing");
  std::string coordinates;
  for (const auto& corner : fence.corners) coordinates += position(corner, 0) + '\n';
  append_text(ring, "coordinates", coordinates + position(fence.corners.front(), 0));
}

}  // namespace

Writing write_kml(const MissionFile& content) {
  auto [points, losses] = points_for(content, every_point_field);
  pugi::xml_document xml;
  auto declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("UTF-8");
  auto root = xml.append_child("kml");
  root.append_attribute("xmlns").set_value("http://www.opengis.net/kml/2.2");
  auto document = root.append_child("Document");
  for (const auto& point : points) append_point(document, point);
  for (const auto& fence : content.mission.fence_polygons) append_fence(document, fence);
  return {bytes_from(xml), std::move(losses)};
}

}  // namespace ponte::planning
