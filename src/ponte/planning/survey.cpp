#include "ponte/planning/survey.hpp"

#include "ponte/planning/plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace ponte::planning {
namespace {

struct Interval {
  double begin{};
  double end{};
};

/// A polygon turned so that the lines go east.
std::vector<MapPoint> turned(const std::vector<MapPoint>& corners, Radians course) {
  const MapPoint along{std::sin(course.value), std::cos(course.value)};
  std::vector<MapPoint> result;
  for (const auto& corner : corners) result.push_back({dot(corner, along), cross(along, corner)});
  return result;
}

MapPoint turned_back(const MapPoint& point, Radians course) {
  const MapPoint along{std::sin(course.value), std::cos(course.value)};
  const MapPoint left{-along.north, along.east};
  return along * point.east + left * point.north;
}

/// Where a side is at this height; the side is not level.
double east_at(const MapPoint& a, const MapPoint& b, double north) {
  return a.east + (b.east - a.east) * (north - a.north) / (b.north - a.north);
}

/// Adds how far east and west the polygon reaches between two heights between which it has no corner.
void add_reach(const std::vector<MapPoint>& corners, double low, double high, std::vector<Interval>& reach) {
  const auto middle = (low + high) / 2;
  std::vector<std::pair<double, Interval>> sides;  // by where they cross the middle, and their own reach
  auto before = corners.back();
  for (const auto& corner : corners) {
    const auto a = std::exchange(before, corner);
    if ((a.north > middle) == (corner.north > middle)) continue;
    const auto [least, most] = std::minmax({east_at(a, corner, low), east_at(a, corner, high)});
    sides.push_back({east_at(a, corner, middle), {least, most}});
  }
  std::ranges::sort(sides, {}, [](const auto& side) { return side.first; });
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2)
    reach.push_back({sides[i].second.begin, std::max(sides[i].second.end, sides[i + 1].second.end)});
}

/// The parts of a line that see the polygon between two heights; gaps of less than `gap` are closed.
std::vector<Interval> parts_seen(const std::vector<MapPoint>& corners, double low, double high, double gap) {
  std::vector<double> heights{low, high};
  for (const auto& corner : corners)
    if (corner.north > low && corner.north < high) heights.push_back(corner.north);
  std::ranges::sort(heights);
  std::vector<Interval> reach;
  for (std::size_t i = 1; i < heights.size(); ++i)
    if (heights[i] > heights[i - 1]) add_reach(corners, heights[i - 1], heights[i], reach);
  std::ranges::sort(reach, {}, &Interval::begin);
  std::vector<Interval> parts;
  for (const auto& each : reach)
    if (!parts.empty() && each.begin <= parts.back().end + gap)
      parts.back().end = std::max(parts.back().end, each.end);
    else
      parts.push_back(each);
  return parts;
}

/// On the map, with both ends.
using MapLine = std::pair<MapPoint, MapPoint>;

std::vector<MapLine> lines_over(const std::vector<MapPoint>& polygon, Radians course, const SurveyStyle& style) {
  const auto corners = turned(polygon, course);
  const auto [lowest, highest] = std::ranges::minmax(corners, {}, &MapPoint::north);
  const auto spacing = style.footprint.across.value * (1 - style.side_overlap);
  const auto trigger = style.footprint.along.value * (1 - style.front_overlap);
  const auto height = highest.north - lowest.north;
  const auto count = std::max(1.0, std::ceil(height / spacing));
  const auto gap = 2 * style.turnaround.value + spacing;
  std::vector<MapLine> lines;
  for (double i = 0; i < count && lines.size() <= lines_max; ++i) {
    const auto north = (lowest.north + highest.north) / 2 + (i - (count - 1) / 2) * spacing;
    const auto half = style.footprint.across.value / 2;
    for (const auto& part : parts_seen(corners, north - half, north + half, gap)) {
      // A whole number of pictures, so that there is one at both ends whichever way it is flown.
      const auto pictures = std::max(1.0, std::ceil((part.end - part.begin) / trigger));
      const auto longer = (pictures * trigger - (part.end - part.begin)) / 2;
      lines.emplace_back(turned_back({part.begin - longer, north}, course),
                         turned_back({part.end + longer, north}, course));
    }
  }
  return lines;
}

/// To compare courses: all lines, and to get from each to the next.
double cost(const std::vector<MapLine>& lines, const SurveyStyle& style) {
  const auto between = 2 * style.turnaround.value + style.footprint.across.value;
  double sum = 0;
  for (const auto& [begin, end] : lines) sum += length(end - begin) + between;
  return sum;
}

std::vector<MapLine> best_lines(const std::vector<MapPoint>& corners, const SurveyStyle& style) {
  if (style.course) return lines_over(corners, *style.course, style);
  std::vector<MapLine> best;
  auto before = corners.back();
  for (const auto& corner : corners) {
    const auto side = course(std::exchange(before, corner), corner);
    auto lines = lines_over(corners, side, style);
    if (best.empty() || cost(lines, style) < cost(best, style)) best = std::move(lines);
  }
  return best;
}

std::optional<std::string> fault_of(const std::vector<MapPoint>& corners) {
  const auto count = corners.size();
  if (count < 3) return fmt::format("the polygon has {} corners: expected at least 3", count);
  if (signed_area(corners) == 0) return "the polygon has no area";
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const bool are_neighbours = j == i + 1 || (i == 0 && j == count - 1);
      if (!are_neighbours && touch(corners[i], corners[(i + 1) % count], corners[j], corners[(j + 1) % count]))
        return fmt::format("side {} of the polygon meets side {}: expected one that does not cross itself", i + 1,
                           j + 1);
    }
  return std::nullopt;
}

std::vector<SurveyLine> on_ground(const Map& map, const std::vector<MapLine>& lines, const SurveyStyle& style) {
  std::vector<SurveyLine> result;
  for (const auto& [begin, end] : lines)
    result.push_back({.begin = map.place(begin),
                      .end = map.place(end),
                      .spacing = style.footprint.along * (1 - style.front_overlap),
                      .run_in = style.turnaround});
  return result;
}

/// Without those that are the same as the one before.
std::vector<MapPoint> different_points(const Map& map, const std::vector<vehicle::Place>& places) {
  std::vector<MapPoint> points;
  for (const auto& place : places)
    if (const auto point = map.point(place); points.empty() || point != points.back()) points.push_back(point);
  return points;
}

std::string too_many_lines() {
  return fmt::format("it takes more than {} lines: expected a smaller area, a wider footprint, or less overlap",
                     lines_max);
}

}  // namespace

Footprint footprint(const Camera& camera, Metres height) {
  const auto scale = height / camera.focal_length;
  return {camera.sensor_width * scale, camera.sensor_height * scale};
}

Metres ground_sampling_distance(const Camera& camera, Metres height) {
  return footprint(camera, height).across * (1 / camera.pixels_across);
}

Metres height_for(const Camera& camera, Metres ground_sampling_distance) {
  return camera.focal_length * (ground_sampling_distance * camera.pixels_across / camera.sensor_width);
}

Result<std::vector<SurveyLine>, std::string> survey(const std::vector<vehicle::Place>& corners,
                                                    const SurveyStyle& style) {
  if (corners.empty()) return fail(std::string{"the polygon has no corners: expected at least 3"});
  const Map map{corners.front()};
  const auto points = different_points(map, corners);
  if (auto fault = fault_of(points)) return fail(std::move(*fault));
  const auto lines = best_lines(points, style);
  if (lines.size() > lines_max) return fail(too_many_lines());
  return on_ground(map, lines, style);
}

// Each leg is a rectangle, longer at the bends so that it reaches what is outside of them.
Result<std::vector<SurveyLine>, std::string> corridor(const std::vector<vehicle::Place>& line, Metres width,
                                                      const SurveyStyle& style) {
  if (line.size() < 2) return fail(fmt::format("the line has {} places: expected at least 2", line.size()));
  const Map map{line.front()};
  const auto points = different_points(map, line);
  if (points.size() < 2) return fail(std::string{"all places of the line are the same"});
  const auto half = width.value / 2;
  const auto at_bend = [&](std::size_t i) {
    if (i == 0 || i + 1 == points.size()) return 0.0;
    const auto bend = std::remainder((course(points[i], points[i + 1]) - course(points[i - 1], points[i])).value,
                                     2 * std::numbers::pi);
    return half * std::min(1.0, std::tan(std::min(std::abs(bend), std::numbers::pi / 2) / 2));
  };
  std::vector<MapLine> lines;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto leg = course(points[i - 1], points[i]);
    const auto aside = leg + Radians{std::numbers::pi / 2};
    const auto begin = displaced(points[i - 1], leg, -at_bend(i - 1));
    const auto end = displaced(points[i], leg, at_bend(i));
    const auto more = lines_over({displaced(begin, aside, -half), displaced(end, aside, -half),
                                  displaced(end, aside, half), displaced(begin, aside, half)},
                                 leg, style);
    lines.insert(lines.end(), more.begin(), more.end());
    if (lines.size() > lines_max) return fail(too_many_lines());
  }
  return on_ground(map, lines, style);
}

}  // namespace ponte::planning
