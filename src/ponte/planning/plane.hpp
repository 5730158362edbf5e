#pragma once

#include "ponte/planning/geodesy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

/// Points, lines and polygons on a map.
namespace ponte::planning {

[[nodiscard]] inline MapPoint operator-(const MapPoint& a, const MapPoint& b) {
  return {a.east - b.east, a.north - b.north};
}
[[nodiscard]] inline MapPoint operator+(const MapPoint& a, const MapPoint& b) {
  return {a.east + b.east, a.north + b.north};
}
[[nodiscard]] inline MapPoint operator*(const MapPoint& a, double factor) {
  return {a.east * factor, a.north * factor};
}
[[nodiscard]] inline double cross(const MapPoint& a, const MapPoint& b) { return a.east * b.north - a.north * b.east; }
[[nodiscard]] inline double dot(const MapPoint& a, const MapPoint& b) { return a.east * b.east + a.north * b.north; }
[[nodiscard]] inline double length(const MapPoint& a) { return std::hypot(a.east, a.north); }

/// From north, clockwise; 0 where both are the same point.
[[nodiscard]] inline Radians course(const MapPoint& from, const MapPoint& to) {
  return Radians{std::atan2(to.east - from.east, to.north - from.north)};
}
/// The point so far away on this course.
[[nodiscard]] inline MapPoint displaced(const MapPoint& from, Radians course, double metres) {
  return {from.east + metres * std::sin(course.value), from.north + metres * std::cos(course.value)};
}

/// Positive when the three turn left.
[[nodiscard]] inline double turn(const MapPoint& a, const MapPoint& b, const MapPoint& c) {
  return cross(b - a, c - a);
}

[[nodiscard]] inline bool is_between(const MapPoint& a, const MapPoint& b, const MapPoint& point) {
  return std::min(a.east, b.east) <= point.east && point.east <= std::max(a.east, b.east) &&
         std::min(a.north, b.north) <= point.north && point.north <= std::max(a.north, b.north);
}

/// Whether two lines have a point in common, their ends included.
[[nodiscard]] inline bool touch(const MapPoint& a, const MapPoint& b, const MapPoint& c, const MapPoint& d) {
  const auto c_side = turn(a, b, c);
  const auto d_side = turn(a, b, d);
  const auto a_side = turn(c, d, a);
  const auto b_side = turn(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && is_between(a, b, c)) || (d_side == 0 && is_between(a, b, d)) ||
         (a_side == 0 && is_between(c, d, a)) || (b_side == 0 && is_between(c, d, b));
}

/// From a point to the nearest of a line's.
[[nodiscard]] inline double distance_to_line(const MapPoint& point, const MapPoint& from, const MapPoint& to) {
  const auto line = to - from;
  const auto square = dot(line, line);
  const auto part = square > 0 ? std::clamp(dot(point - from, line) / square, 0.0, 1.0) : 0.0;
  return length(from + line * part - point);
}

/// Between the nearest points of two lines; 0 where they touch.
[[nodiscard]] inline double distance_of_lines(const MapPoint& a, const MapPoint& b, const MapPoint& c,
                                              const MapPoint& d) {
  if (touch(a, b, c, d)) return 0;
  return std::min(
      {distance_to_line(a, c, d), distance_to_line(b, c, d), distance_to_line(c, a, b), distance_to_line(d, a, b)});
}

/// Whether a polygon, whose last corner is joined to the first, has the point in it.
[[nodiscard]] inline bool is_inside(const std::vector<MapPoint>& corners, const MapPoint& point) {
  bool inside = false;
  auto before = corners.back();
  for (const auto& corner : corners) {
    if ((corner.north > point.north) != (before.north > point.north) &&
        (turn(before, corner, point) > 0) == (corner.north > before.north))
      inside = !inside;
    before = corner;
  }
  return inside;
}

/// Twice the area, positive when the corners go round to the left.
[[nodiscard]] inline double signed_area(const std::vector<MapPoint>& corners) {
  double sum = 0;
  auto before = corners.back();
  for (const auto& corner : corners) {
    sum += cross(before, corner);
    before = corner;
  }
  return sum;
}

}  // namespace ponte::planning
