#include "ponte/planning/airspace.hpp"

#include "ponte/planning/plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ponte::planning {
namespace {

constexpr int sides_of_circle = 24;

}  // namespace

Airspace::Airspace(const vehicle::Mission& fence, const vehicle::Place& centre, Metres margin) : map_{centre} {
  for (const auto& polygon : fence.fence_polygons) {
    auto& zone = zones_.emplace_back(Zone{{}, polygon.inclusion});
    for (const auto& corner : polygon.corners) zone.corners.push_back(map_.point(corner));
  }
  for (const auto& circle : fence.fence_circles) {
    auto& zone = zones_.emplace_back(Zone{{}, circle.inclusion});
    const auto half_side = std::numbers::pi / sides_of_circle;
    const auto radius = Metres{circle.inclusion ? circle.radius.value : circle.radius.value / std::cos(half_side)};
    for (int i = 0; i < sides_of_circle; ++i)
      zone.corners.push_back(map_.point(displaced(circle.centre, Radians{2 * half_side * i}, radius)));
  }
  for (auto& zone : zones_)
    if (signed_area(zone.corners) < 0) std::ranges::reverse(zone.corners);
  for (const auto& zone : zones_) add_turns(zone, margin.value);
  std::erase_if(turns_, [this](const MapPoint& point) { return !allows(point); });
  seen_from_.resize(turns_.size());
  for (std::size_t a = 0; a < turns_.size(); ++a)
    for (std::size_t b = 0; b < turns_.size(); ++b)
      if (a != b && is_free(turns_[a], turns_[b])) seen_from_[a].push_back(b);
}

/// A shortest way turns at the corners that stick out into the allowed side. There it keeps the margin.
void Airspace::add_turns(const Zone& zone, double margin) {
  const auto& corners = zone.corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& corner = corners[i];
    const auto in = corner - corners[(i + corners.size() - 1) % corners.size()];
    const auto out = corners[(i + 1) % corners.size()] - corner;
    const bool sticks_out = (cross(in, out) > 0) != zone.inclusion;
    if (!sticks_out || length(in) == 0 || length(out) == 0) continue;
    const auto direction = in * (1 / length(in)) - out * (1 / length(out));
    if (length(direction) == 0) continue;
    turns_.push_back(corner + direction * (margin / length(direction)));
  }
}

bool Airspace::allows(const vehicle::Place& place) const { return allows(map_.point(place)); }

bool Airspace::allows(const MapPoint& point) const {
  return std::ranges::all_of(zones_,
                             [&](const Zone& zone) { return is_inside(zone.corners, point) == zone.inclusion; });
}

bool Airspace::is_free(const MapPoint& from, const MapPoint& to) const {
  return std::ranges::none_of(zones_, [&](const Zone& zone) {
    auto before = zone.corners.back();
    for (const auto& corner : zone.corners) {
      if (touch(from, to, before, corner)) return true;
      before = corner;
    }
    return false;
  });
}

// Dijkstra's search over the turns, with both ends added to them.
std::optional<std::vector<vehicle::Place>> Airspace::way(const vehicle::Place& from, const vehicle::Place& to) const {
  const auto start = map_.point(from);
  const auto goal = map_.point(to);
  if (!allows(start) || !allows(goal)) return std::nullopt;
  if (is_free(start, goal)) return std::vector<vehicle::Place>{};

  constexpr auto far = std::numeric_limits<double>::infinity();
  const auto count = turns_.size();
  std::vector<double> reached(count, far);
  std::vector<std::size_t> came_from(count, count);
  std::vector<char> is_settled(count);
  for (std::size_t i = 0; i < count; ++i)
    if (is_free(start, turns_[i])) reached[i] = length(turns_[i] - start);
  auto best = far;
  auto last = count;
  while (true) {
    auto nearest = count;
    for (std::size_t i = 0; i < count; ++i)
      if (is_settled[i] == 0 && reached[i] < best && (nearest == count || reached[i] < reached[nearest])) nearest = i;
    if (nearest == count) break;
    is_settled[nearest] = 1;
    const auto whole = reached[nearest] + length(goal - turns_[nearest]);
    if (whole < best && is_free(turns_[nearest], goal)) {
      best = whole;
      last = nearest;
    }
    for (const auto next : seen_from_[nearest]) {
      const auto through = reached[nearest] + length(turns_[next] - turns_[nearest]);
      if (through >= reached[next]) continue;
      reached[next] = through;
      came_from[next] = nearest;
    }
  }
  if (last == count) return std::nullopt;
  std::vector<vehicle::Place> places;
  for (; last != count; last = came_from[last]) places.push_back(map_.place(turns_[last]));
  std::ranges::reverse(places);
  return places;
}

}  // namespace ponte::planning
