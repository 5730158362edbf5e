#include "mission/plan_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace ponte::app {
namespace {

using planning::MapPoint;

constexpr std::array colours{"#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf"};

/// What the drawing has to show, in metres.
struct Frame {
  double west{std::numeric_limits<double>::infinity()};
  double east{-west};
  double south{west};
  double north{-west};

  void include(const MapPoint& point) {
    west = std::min(west, point.east);
    east = std::max(east, point.east);
    south = std::min(south, point.north);
    north = std::max(north, point.north);
  }
};

std::string escaped(std::string_view text) {
  std::string result;
  for (const auto c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

class Drawing {
 public:
  explicit Drawing(const vehicle::Place& centre) : map_{centre} {}

  void line(const std::vector<vehicle::Place>& places, std::string_view element, std::string_view style) {
    std::string points;
    for (const auto& place : places) points += text(place);
    body_ += fmt::format("<{} points=\"{}\" {}/>\n", element, points, style);
  }
  void dot(const vehicle::Place& place, std::string_view label, std::string_view style) {
    const auto point = shown(place);
    body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1%\" {}><title>{}</title></circle>\n", point.east,
                         -point.north, style, escaped(label));
  }
  [[nodiscard]] std::string svg() const {
    const auto space = std::max({frame_.east - frame_.west, frame_.north - frame_.south, 1.0}) / 20;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\" "
        "style=\"width:100%;height:80vh\" "
        "fill=\"none\" stroke-width=\"2\">\n{}</svg>\n",
        frame_.west - space, -frame_.north - space, frame_.east - frame_.west + 2 * space,
        frame_.north - frame_.south + 2 * space, body_);
  }

 private:
  MapPoint shown(const vehicle::Place& place) {
    const auto point = map_.point(place);
    frame_.include(point);
    return point;
  }
  std::string text(const vehicle::Place& place) {
    const auto point = shown(place);
    return fmt::format("{:.1f},{:.1f} ", point.east, -point.north);
  }

  planning::Map map_;
  Frame frame_;
  std::string body_;
};

std::string_view zone_style(bool inclusion) {
  return inclusion ? "stroke=\"#2a2\" vector-effect=\"non-scaling-stroke\""
                   : "fill=\"#f003\" stroke=\"#c00\" vector-effect=\"non-scaling-stroke\"";
}

}  // namespace

std::string map_page(const planning::Task& task, const std::vector<planning::Flight>& flights) {
  Drawing drawing{task.crafts.front().start};
  for (const auto& zone : task.fence.fence_polygons) drawing.line(zone.corners, "polygon", zone_style(zone.inclusion));
  for (const auto& circle : task.fence.fence_circles) {
    std::vector<vehicle::Place> ring;
    for (int i = 0; i < 72; ++i)
      ring.push_back(planning::displaced(circle.centre, Radians{2 * std::numbers::pi * i / 72}, circle.radius));
    drawing.line(ring, "polygon", zone_style(circle.inclusion));
  }
  for (const auto& line : task.lines)
    drawing.line({line.begin, line.end}, "polyline",
                 "stroke=\"#000\" stroke-opacity=\"0.2\" stroke-width=\"6\" vector-effect=\"non-scaling-stroke\"");
  std::string legend;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const auto* const colour = colours[i % colours.size()];
    std::vector<vehicle::Place> path;
    for (const auto& moment : flights[i].track) path.push_back(moment.place);
    drawing.line(path, "polyline", fmt::format("stroke=\"{}\" vector-effect=\"non-scaling-stroke\"", colour));
    drawing.dot(task.crafts[i].start, "start", fmt::format("fill=\"{}\"", colour));
    legend += fmt::format("<li style=\"color:{}\">vehicle {}: {:.0f} m, {:.0f} s</li>\n", colour, i + 1,
                          flights[i].length.value, flights[i].time.count());
  }
  for (std::size_t i = 0; i < task.points.size(); ++i)
    drawing.dot(task.points[i].place, fmt::format("point {} {}", i + 1, task.points[i].name),
                "fill=\"#fff\" stroke=\"#000\" vector-effect=\"non-scaling-stroke\"");
  return fmt::format(
      "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Mission plan</title>\n"
      "<body style=\"font-family:sans-serif\">\n<ul>\n{}</ul>\n{}",
      legend, drawing.svg());
}

}  // namespace ponte::app
