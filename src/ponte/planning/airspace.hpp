#pragma once

#include "ponte/planning/geodesy.hpp"

#include <optional>
#include <vector>

namespace ponte::planning {

/// Where a vehicle may fly: inside every inclusion, outside every exclusion. Finds the shortest way round them.
class Airspace {
 public:
  /// The zones of the mission's fence. Detours keep `margin` away from their corners; a circle counts as the polygon of
  /// 24 sides that keeps the vehicle on the right side of it. `centre` is a place in the midst of all.
  Airspace(const vehicle::Mission& fence, const vehicle::Place& centre, Metres margin);

  [[nodiscard]] const Map& map() const { return map_; }
  [[nodiscard]] bool has_no_zones() const { return zones_.empty(); }

  /// Whether a vehicle may be there.
  [[nodiscard]] bool allows(const vehicle::Place& place) const;
  /// Whether the straight line between two points of its map touches no border of a zone.
  [[nodiscard]] bool is_free(const MapPoint& from, const MapPoint& to) const;

  /// The places where the shortest way turns, without both ends; nothing when there is no way.
  [[nodiscard]] std::optional<std::vector<vehicle::Place>> way(const vehicle::Place& from,
                                                               const vehicle::Place& to) const;

 private:
  struct Zone {
    std::vector<MapPoint> corners;
    bool inclusion{};
  };
  [[nodiscard]] bool allows(const MapPoint& point) const;
  void add_turns(const Zone& zone, double margin);

  Map map_;
  std::vector<Zone> zones_;
  std::vector<MapPoint> turns_;                      ///< where a shortest way may turn: beside the corners of the zones
  std::vector<std::vector<std::size_t>> seen_from_;  ///< the turns that each turn sees
};

}  // namespace ponte::planning
