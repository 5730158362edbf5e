#include "ponte/planning/formats/gpx.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/point_draft.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/shapes.hpp"
#include "ponte/planning/formats/text.hpp"
#include "ponte/planning/formats/xml_text.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace ponte::planning {
namespace {

class GpxReader {
 public:
  GpxReader(const XmlText& xml, const ReadOptions& options) : xml_{xml}, options_{options} {}

  Reading read() {
    const auto root = xml_.root();
    if (local_name(root) != "gpx") refuse(xml_.where(root), fmt::format("the root is <{}>", root.name()), "<gpx>");
    const bool has_route = !child(root, "rte").empty();
    for (const auto& node : root.children()) {
      const auto name = local_name(node);
      if (name == "wpt")
        shapes_.points.push_back(point(node));
      else if (name == "rte")
        shapes_.lines.push_back(line(node, {node}, "rtept"));
      else if (name == "trk" && has_route)
        remark(node, "a track is not kept, since the file has a route");
      else if (name == "trk")
        shapes_.lines.push_back(line(node, {node.children().begin(), node.children().end()}, "trkpt"));
    }
    take(std::move(shapes_), reading_);
    return std::move(reading_);
  }

 private:
  void remark(const pugi::xml_node& node, std::string text) {
    reading_.remarks.push_back({xml_.where(node), std::move(text)});
  }

  Shapes::Line line(const pugi::xml_node& node, const std::vector<pugi::xml_node>& parts, std::string_view point_name) {
    Shapes::Line result{.where = xml_.where(node), .points = {}};
    for (const auto& part : parts)
      for (const auto& each : part.children())
        if (local_name(each) == point_name) result.points.push_back(point(each));
    if (result.points.empty()) refuse(result.where, fmt::format("<{}> has no <{}>", node.name(), point_name), "some");
    return result;
  }

  PointOfInterest point(const pugi::xml_node& node) {
    const auto where = xml_.where(node);
    PointDraft draft{where};
    const double latitude = degrees(node, "lat");
    draft.set_place(checked_place(latitude, degrees(node, "lon"), where));
    for (const auto& part : node.children()) {
      const auto name = local_name(part);
      if (name == "ele")
        draft.set(altitude_name, trimmed(part.child_value()));
      else if (name == "name")
        draft.set(name_name, part.child_value());
      else if (part.type() == pugi::node_element && remarked_.insert(std::string{name}).second)
        remark(part, fmt::format("<{}> of points is not kept", part.name()));
    }
    if (draft.altitude_is_vague() && !options_.altitude_above && remarked_.insert("ele").second)
      remark(child(node, "ele"), "elevations are taken as above mean sea level, since GPX does not tell");
    return draft.finish(options_.altitude_above.value_or(vehicle::AltitudeFrame::msl));
  }

  [[nodiscard]] double degrees(const pugi::xml_node& node, const char* name) const {
    const auto attribute = node.attribute(name);
    const auto number = number_in(trimmed(attribute.value()));
    if (!number)
      refuse(xml_.where(node),
             attribute ? fmt::format("{} is '{}'", name, attribute.value()) : fmt::format("{} is missing", name),
             "decimal degrees");
    return *number;
  }

  const XmlText& xml_;
  const ReadOptions& options_;
  Shapes shapes_;
  Reading reading_;
  std::set<std::string> remarked_;  ///< elements that a remark has told of
};

}  // namespace

ReadingResult read_gpx(Bytes bytes, const ReadOptions& options) try {
  const XmlText xml{text_in(bytes)};
  return GpxReader{xml, options}.read();
} catch (const FormatError& error) {
  return fail(error);
}

Writing write_gpx(const MissionFile& content) {
  auto [points, losses] = points_for(content, {.msl_altitude = true, .name = true});
  pugi::xml_document xml;
  auto declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("UTF-8");
  auto root = xml.append_child("gpx");
  root.append_attribute("version").set_value("1.1");
  root.append_attribute("creator").set_value("ponte");
  root.append_attribute("xmlns").set_value("http://www.topografix.com/GPX/1/1");
  for (const auto& point : points) {
    auto node = root.append_child("wpt");
    node.append_attribute("lat").set_value(decimal_text(degrees_from_radians(point.place.latitude)).c_str());
    node.append_attribute("lon").set_value(decimal_text(degrees_from_radians(point.place.longitude)).c_str());
    if (point.altitude) append_text(node, "ele", decimal_text(point.altitude->height.value));
    if (!point.name.empty()) append_text(node, "name", point.name);
  }
  return {bytes_from(xml), std::move(losses)};
}

}  // namespace ponte::planning
