#include "ponte/planning/formats/geojson.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/json_tree.hpp"
#include "ponte/planning/formats/point_draft.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/shapes.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace ponte::planning {
namespace {

class GeoJsonReader {
 public:
  explicit GeoJsonReader(const ReadOptions& options) : options_{options} {}

  Reading read(const JsonValue& root) {
    if (root.find("crs") != nullptr)
      remark(root.find("crs")->line,
             "'crs' is not looked at: the places are taken as longitude and latitude of WGS-84");
    read_object(root);
    if (vague_altitudes_)
      remark(1, "its altitudes are taken as above mean sea level, since altitude_above does not tell");
    take(std::move(shapes_), reading_);
    return std::move(reading_);
  }

 private:
  void remark(std::size_t line, std::string text) { reading_.remarks.push_back({at_line(line), std::move(text)}); }

  void read_object(const JsonValue& object) {
    const auto type = text_of(member_of(object, "type"), "type");
    if (type == "FeatureCollection") {
      for (const auto& feature : elements_of(member_of(object, "features"), "features")) read_feature(feature);
    } else if (type == "Feature") {
      read_feature(object);
    } else {
      read_geometry(object, nullptr);
    }
  }

  void read_feature(const JsonValue& feature) {
    const auto& type = member_of(feature, "type");
    if (text_of(type, "type") != "Feature")
      refuse(at_line(type.line), fmt::format("type is {}", shown(type)), "\"Feature\"");
    const auto& geometry = member_of(feature, "geometry");
    if (geometry.kind == JsonValue::Kind::null)
      remark(feature.line, "a feature without a geometry is not kept");
    else
      read_geometry(geometry, feature.find("properties"));
  }

  void read_geometry(const JsonValue& geometry, const JsonValue* properties) {
    const auto& type_value = member_of(geometry, "type");
    const auto type = text_of(type_value, "type");
    if (type == "GeometryCollection") {
      for (const auto& each : elements_of(member_of(geometry, "geometries"), "geometries"))
        read_geometry(each, properties);
      return;
    }
    const auto& coordinates = member_of(geometry, "coordinates");
    const auto& parts = elements_of(coordinates, "coordinates");
    if (type == "Point") {
      shapes_.points.push_back(point(coordinates, properties));
    } else if (type == "MultiPoint") {
      for (const auto& position : parts) shapes_.points.push_back(point(position, properties));
    } else if (type == "LineString") {
      read_line(coordinates);
    } else if (type == "MultiLineString") {
      for (const auto& line : parts) read_line(line);
    } else if (type == "Polygon") {
      read_polygon(coordinates, properties);
    } else if (type == "MultiPolygon") {
      for (const auto& polygon : parts) read_polygon(polygon, properties);
    } else {
      refuse(at_line(type_value.line), fmt::format("type is '{}'", type), "a type of RFC 7946");
    }
  }

  PointOfInterest point(const JsonValue& position, const JsonValue* properties) {
    const auto& numbers = elements_of(position, "a position");
    if (numbers.size() < 2)
      refuse(at_line(position.line), fmt::format("a position has {} numbers", numbers.size()),
             "longitude, latitude and perhaps altitude");
    if (numbers.size() > 3) remark(position.line, "a position has more than three numbers, the rest is not kept");
    PointDraft draft{at_line(position.line)};
    draft.set_place(
        checked_place(number_of(numbers[1], "latitude"), number_of(numbers[0], "longitude"), at_line(position.line)));
    if (numbers.size() > 2) draft.set_altitude(number_of(numbers[2], "altitude"));
    if (properties != nullptr && properties->kind == JsonValue::Kind::object)
      for (const auto& property : properties->elements) set(draft, property);
    vague_altitudes_ = vague_altitudes_ || (draft.altitude_is_vague() && !options_.altitude_above);
    return draft.finish(options_.altitude_above.value_or(vehicle::AltitudeFrame::msl));
  }

  void set(PointDraft& draft, const JsonValue& value) {
    if (value.kind == JsonValue::Kind::null) return;
    if (!PointDraft::knows(value.name))
      remark(value.line, fmt::format("the property '{}' is not kept", value.name));
    else
      draft.set(value.name, value.kind == JsonValue::Kind::text ? value.text : shown(value));
  }

  void read_line(const JsonValue& coordinates) {
    Shapes::Line line{.where = at_line(coordinates.line), .points = {}};
    for (const auto& position : elements_of(coordinates, "a line")) line.points.push_back(point(position, nullptr));
    if (line.points.size() < 2)
      refuse(line.where, fmt::format("the line has {} points", line.points.size()), "at least 2");
    shapes_.lines.push_back(std::move(line));
  }

  void read_polygon(const JsonValue& coordinates, const JsonValue* properties) {
    const auto* fence = properties != nullptr ? properties->find("fence") : nullptr;
    if (fence == nullptr && !options_.bare_polygons_are_inclusions) {
      remark(coordinates.line, "a polygon is not kept: it has no property fence, \"inclusion\" or \"exclusion\"");
      return;
    }
    const bool inclusion = fence == nullptr || is_inclusion(text_of(*fence, "fence"), at_line(fence->line));
    const auto& rings = elements_of(coordinates, "a polygon");
    if (rings.empty()) refuse(at_line(coordinates.line), "the polygon has no ring", "one");
    if (rings.size() > 1) refuse(at_line(rings[1].line), "the polygon has a hole", "a polygon of its own for it");
    vehicle::FencePolygon polygon{.corners = {}, .inclusion = inclusion};
    for (const auto& position : elements_of(rings[0], "a ring"))
      polygon.corners.push_back(point(position, nullptr).place);
    add_ring(reading_.content.mission, std::move(polygon), at_line(rings[0].line));
  }

  const ReadOptions& options_;
  Shapes shapes_;
  Reading reading_;
  bool vague_altitudes_{};
};

void append_position(JsonText& json, const vehicle::Place& place, const std::optional<vehicle::Altitude>& altitude) {
  json.begin_array().value(degrees_from_radians(place.longitude)).value(degrees_from_radians(place.latitude));
  if (altitude && altitude->above == vehicle::AltitudeFrame::msl) json.value(altitude->height.value);
  json.end_array();
}

std::string feature(const PointOfInterest& point) {
  JsonText json;
  json.begin_object().member("type", "Feature").key("geometry").begin_object().member("type", "Point");
  append_position(json.key("coordinates"), point.place, point.altitude);
  json.end_object().key("properties").begin_object();
  if (!point.name.empty()) json.member(name_name, std::string_view{point.name});
  if (point.altitude)
    json.member(altitude_name, point.altitude->height.value)
        .member(altitude_above_name, name_of(point.altitude->above));
  if (point.dwell.count() > 0) json.member(dwell_name, point.dwell.count());
  if (point.priority) json.member(priority_name, *point.priority);
  if (point.sensor_quality) json.member(sensor_quality_name, *point.sensor_quality);
  return json.end_object().end_object().text();
}

std::string feature(const vehicle::FencePolygon& fence) {
  JsonText json;
  json.begin_object().member("type", "Feature").key("geometry").begin_object().member("type", "Polygon");
  json.key("coordinates").begin_array().begin_array();
  for (const auto& corner : fence.corners) append_position(json, corner, {});
  append_position(json, fence.corners.front(), {});
  json.end_array().end_array().end_object();
  json.key("properties").begin_object().member("fence", fence.inclusion ? "inclusion" : "exclusion");
  return json.end_object().end_object().text();
}

}  // namespace

ReadingResult read_geojson(Bytes bytes, const ReadOptions& options) try {
  const auto root = parse_json(text_in(bytes));
  return GeoJsonReader{options}.read(root);
} catch (const FormatError& error) {
  return fail(error);
}

Writing write_geojson(const MissionFile& content) {
  auto [points, losses] = points_for(content, every_point_field);
  std::vector<std::string> features;
  for (const auto& point : points) features.push_back(feature(point));
  for (const auto& fence : content.mission.fence_polygons) features.push_back(feature(fence));
  const auto text =
      fmt::format("{{\"type\":\"FeatureCollection\",\"features\":[\n{}\n]}}\n", fmt::join(features, ",\n"));
  return {bytes_from(text), std::move(losses)};
}

}  // namespace ponte::planning
