#include "ponte/planning/flight_plan.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::planning {
namespace {

using vehicle::Place;

std::vector<MapPoint> path(const Map& map, const Craft& craft, const Flight& flight) {
  std::vector<MapPoint> points{map.point(craft.start)};
  for (const auto& leg : flight.legs) {
    for (const auto& turn : leg.turns) points.push_back(map.point(turn));
    points.push_back(map.point(leg.target));
  }
  return points;
}

double distance_to_line(const MapPoint& point, const MapPoint& from, const MapPoint& to) {
  const auto east = to.east - from.east;
  const auto north = to.north - from.north;
  const auto square = east * east + north * north;
  const auto along = (point.east - from.east) * east + (point.north - from.north) * north;
  const auto part = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  return std::hypot(from.east + part * east - point.east, from.north + part * north - point.north);
}

bool cross(const MapPoint& a, const MapPoint& b, const MapPoint& c, const MapPoint& d) {
  const auto side = [](const MapPoint& from, const MapPoint& to, const MapPoint& point) {
    return (to.east - from.east) * (point.north - from.north) - (to.north - from.north) * (point.east - from.east);
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool come_near(const std::vector<MapPoint>& a, const std::vector<MapPoint>& b, double distance) {
  for (std::size_t i = 1; i < a.size(); ++i)
    for (std::size_t j = 1; j < b.size(); ++j) {
      const auto least = std::min({distance_to_line(a[i - 1], b[j - 1], b[j]), distance_to_line(a[i], b[j - 1], b[j]),
                                   distance_to_line(b[j - 1], a[i - 1], a[i]), distance_to_line(b[j], a[i - 1], a[i])});
      if (least < distance || cross(a[i - 1], a[i], b[j - 1], b[j])) return true;
    }
  return false;
}

}  // namespace

std::vector<int> layers(const std::vector<Craft>& crafts, const std::vector<Flight>& flights, Metres distance) {
  std::vector<int> result(flights.size());
  if (flights.empty()) return result;
  const Map map{crafts.front().start};
  std::vector<std::vector<MapPoint>> paths;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    paths.push_back(path(map, crafts[i], flights[i]));
    std::vector<char> is_taken(flights.size() + 1);
    for (std::size_t j = 0; j < i; ++j)
      if (come_near(paths[i], paths[j], distance.value)) is_taken[static_cast<std::size_t>(result[j])] = 1;
    result[i] = static_cast<int>(std::ranges::find(is_taken, char{0}) - is_taken.begin());
  }
  return result;
}

vehicle::Mission mission_of(const Craft& craft, const Flight& flight, const std::vector<PointOfInterest>& points,
                            const MissionStyle& style) {
  vehicle::Mission mission;
  if (flight.legs.empty()) return mission;
  const auto raised = [&](vehicle::Altitude altitude) {
    altitude.height = altitude.height + style.added_altitude;
    return altitude;
  };
  const auto add = [&](vehicle::Action action, std::string name = {}) {
    mission.items.push_back({.action = std::move(action), .name = std::move(name)});
  };
  if (craft.sets_speed) mission.hover_speed = craft.speed;
  if (style.wait.count() > 0) add(vehicle::DelayItem{style.wait});
  add(vehicle::TakeOffItem{.place = craft.start, .altitude = raised(flight.legs.front().altitude)});
  if (craft.sets_speed) add(vehicle::SpeedItem{.kind = vehicle::SpeedKind::ground, .speed = craft.speed});
  for (const auto& leg : flight.legs) {
    for (const auto& turn : leg.turns) add(vehicle::WaypointItem{.place = turn, .altitude = raised(leg.altitude)});
    if (!leg.point) break;
    const auto& point = points[*leg.point];
    add(vehicle::WaypointItem{.place = leg.target, .altitude = raised(leg.altitude), .dwell = point.dwell}, point.name);
    if (style.takes_pictures) add(vehicle::TakePicturesItem{.interval = {}, .count = 1});
  }
  const auto& end = flight.legs.back();
  if (!end.point && end.target == craft.start)
    add(vehicle::ReturnItem{});
  else
    add(vehicle::LandItem{.place = end.target, .altitude = {{}, end.altitude.above}});
  return mission;
}

}  // namespace ponte::planning
