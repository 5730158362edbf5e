#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/kml.hpp"
#include "ponte/planning/formats/point_draft.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/shapes.hpp"
#include "ponte/planning/formats/text.hpp"
#include "ponte/planning/formats/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ponte::planning {
namespace {

struct Tuple {
  Where where;
  vehicle::Place place;
  double altitude{};  ///< 0 where there is none
};

/// "longitude,latitude" or "longitude,latitude,altitude".
Tuple parse_tuple(std::string_view text, Where where) {
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  for (auto rest = text;; rest.remove_prefix(rest.find(',') + 1)) {
    const auto number = number_in(rest.substr(0, rest.find(',')));
    if (!number || count == numbers.size())
      refuse(where, fmt::format("coordinates has '{}'", text), "longitude,latitude or longitude,latitude,altitude");
    numbers[count++] = *number;
    if (rest.find(',') == rest.npos) break;
  }
  if (count < 2) refuse(where, fmt::format("coordinates has '{}'", text), "longitude,latitude without spaces between");
  return {where, checked_place(numbers[1], numbers[0], where), numbers[2]};
}

class KmlReader final : public pugi::xml_tree_walker {
 public:
  KmlReader(const XmlText& xml, const ReadOptions& options) : xml_{xml}, options_{options} {}

  Reading read() {
    if (local_name(xml_.root()) != "kml")
      refuse(xml_.where(xml_.root()), fmt::format("the root is <{}>", xml_.root().name()), "<kml>");
    xml_.root().traverse(*this);
    take(std::move(shapes_), reading_);
    return std::move(reading_);
  }

 private:
  bool for_each(pugi::xml_node& node) override {
    constexpr std::array<std::string_view, 7> other_shapes{
        "Track", "MultiTrack", "Model", "GroundOverlay", "PhotoOverlay", "ScreenOverlay", "NetworkLink"};
    const auto name = local_name(node);
    if (name == "Placemark")
      placemark_ = node;
    else if (name == "Point")
      read_point(node);
    else if (name == "LineString")
      read_line(node);
    else if (name == "Polygon")
      read_polygon(node);
    else if (std::ranges::find(other_shapes, name) != other_shapes.end())
      remark(node, fmt::format("<{}> is not kept", node.name()));
    return true;
  }

  void remark(const pugi::xml_node& node, std::string text) {
    reading_.remarks.push_back({xml_.where(node), std::move(text)});
  }

  [[nodiscard]] std::vector<Tuple> tuples(const pugi::xml_node& shape) const {
    const auto coordinates = child(shape, "coordinates");
    if (!coordinates || !coordinates.first_child())
      refuse(xml_.where(shape), fmt::format("<{}> has no coordinates", shape.name()), "some");
    auto where = xml_.where(coordinates.first_child());
    std::vector<Tuple> result;
    std::string_view rest{coordinates.child_value()};
    constexpr std::string_view space = " \t\r\n";
    while (true) {
      const auto blank = std::min(rest.find_first_not_of(space), rest.size());
      where.number += static_cast<std::size_t>(std::ranges::count(rest.substr(0, blank), '\n'));
      rest.remove_prefix(blank);
      if (rest.empty()) return result;
      const auto length = std::min(rest.find_first_of(space), rest.size());
      result.push_back(parse_tuple(rest.substr(0, length), where));
      rest.remove_prefix(length);
    }
  }

  /// What the placemark's ExtendedData call so.
  [[nodiscard]] std::string_view data(std::string_view name) const {
    for (const auto& each : child(placemark_, "ExtendedData").children())
      if (local_name(each) == "Data" && each.attribute("name").value() == name) return child_text(each, "value");
    return {};
  }

  PointOfInterest point(const Tuple& tuple, const pugi::xml_node& shape, std::string_view name) {
    PointDraft draft{tuple.where};
    draft.set_place(tuple.place);
    draft.set(name_name, name);
    const auto mode = child_text(shape, "altitudeMode");
    if (mode == "absolute" || mode == "relativeToGround")
      draft.set_altitude(tuple.altitude);
    else if (tuple.altitude != 0)
      reading_.remarks.push_back({tuple.where, fmt::format("the altitude {} is not kept: altitudeMode is {}",
                                                           tuple.altitude, mode.empty() ? "clampToGround" : mode)});
    for (const auto each : {altitude_name, altitude_above_name, dwell_name, priority_name, sensor_quality_name})
      if (const auto value = data(each); !value.empty()) draft.set(each, value);
    return draft.finish(mode == "absolute" ? vehicle::AltitudeFrame::msl : vehicle::AltitudeFrame::terrain);
  }

  void read_point(const pugi::xml_node& shape) {
    const auto positions = tuples(shape);
    if (positions.size() != 1)
      refuse(xml_.where(shape), fmt::format("the point has {} positions", positions.size()), "one");
    remark_other_data();
    shapes_.points.push_back(point(positions.front(), shape, child(placemark_, "name").child_value()));
  }

  void remark_other_data() {
    for (const auto& each : child(placemark_, "ExtendedData").children())
      if (const std::string_view name{each.attribute("name").value()}; !PointDraft::knows(name))
        remark(each, fmt::format("the value '{}' of ExtendedData is not kept", name));
  }

  void read_line(const pugi::xml_node& shape) {
    Shapes::Line line{.where = xml_.where(shape), .points = {}};
    for (const auto& each : tuples(shape)) line.points.push_back(point(each, shape, {}));
    shapes_.lines.push_back(std::move(line));
  }

  void read_polygon(const pugi::xml_node& shape) {
    const auto fence = data("fence");
    if (fence.empty() && !options_.bare_polygons_are_inclusions) {
      remark(shape, "a polygon is not kept: its placemark has no value fence, \"inclusion\" or \"exclusion\"");
      return;
    }
    if (child(shape, "innerBoundaryIs"))
      refuse(xml_.where(child(shape, "innerBoundaryIs")), "the polygon has a hole", "a polygon of its own for it");
    const auto ring = child(child(shape, "outerBoundaryIs"), "LinearRing");
    if (!ring) refuse(xml_.where(shape), "the polygon has no outer ring", "<outerBoundaryIs><LinearRing>");
    vehicle::FencePolygon polygon{.corners = {}, .inclusion = fence.empty() || is_inclusion(fence, xml_.where(shape))};
    for (const auto& each : tuples(ring)) polygon.corners.push_back(each.place);
    add_ring(reading_.content.mission, std::move(polygon), xml_.where(ring));
  }

  const XmlText& xml_;
  const ReadOptions& options_;
  pugi::xml_node placemark_;  ///< the last one begun
  Shapes shapes_;
  Reading reading_;
};

}  // namespace

ReadingResult read_kml(Bytes bytes, const ReadOptions& options) try {
  const XmlText xml{text_in(bytes)};
  return KmlReader{xml, options}.read();
} catch (const FormatError& error) {
  return fail(error);
}

}  // namespace ponte::planning
