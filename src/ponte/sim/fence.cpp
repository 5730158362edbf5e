#include "ponte/sim/fence.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

NorthEastDown seen_from(const Position& place, const MissionItem& item) {
  constexpr double degrees = 1e-7;
  return offset_between(
      place, {radians_from_degrees(item.x * degrees), radians_from_degrees(item.y * degrees), place.altitude_msl});
}

/// Whether the polygon of these corners surrounds the place: a ray from there crosses its sides an odd number of times.
bool surrounds(std::span<const MissionItem> corners, const Position& place) {
  bool inside = false;
  auto a = seen_from(place, corners.back());
  for (const auto& corner : corners) {
    const auto b = seen_from(place, corner);
    if ((a.north > 0) != (b.north > 0) && a.east - a.north * (b.east - a.east) / (b.north - a.north) > 0)
      inside = !inside;
    a = b;
  }
  return inside;
}

}  // namespace

std::optional<std::string_view> Fence::breach(const FenceSettings& settings, const Position& home,
                                              const Position& place) const {
  if (!settings.is_enabled) return std::nullopt;
  const auto exceeds = [](double value, Metres most) { return most > Metres{} && value > most.value; };
  if (settings.heeds_height && exceeds((place.altitude_msl - home.altitude_msl).value, settings.most_height))
    return "Max Alt";
  if (settings.heeds_radius && exceeds(horizontal(offset_between(home, place)), settings.most_radius)) return "Circle";
  if (settings.heeds_uploaded && !allows(place)) return "Polygon";
  return std::nullopt;
}

/// Inside every area that it has to stay in, and outside every other.
bool Fence::allows(const Position& place) const {
  for (std::size_t i = 0; i < items_.size();) {
    const auto& item = items_[i];
    const bool is_polygon = item.command == messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION ||
                            item.command == messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION;
    if (!is_polygon) {
      const bool within = horizontal(seen_from(place, item)) <= double{item.param1};
      if (item.command == messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION && !within) return false;
      if (item.command == messages::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION && within) return false;
      ++i;
      continue;
    }
    // Each corner tells how many there are; an upload that is cut off has fewer.
    const auto left = items_.size() - i;
    const auto count = item.param1 >= 1 && double{item.param1} < static_cast<double>(left)
                           ? static_cast<std::size_t>(item.param1)
                           : left;
    const bool wanted = item.command == messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION;
    if (surrounds(items_.subspan(i, count), place) != wanted) return false;
    i += count;
  }
  return true;
}

}  // namespace ponte::sim
