#pragma once

#include "ponte/vehicle/mission.hpp"

/// The shortest way between places, and a flat map around one.
namespace ponte::planning {

/// Along the geodesic on the WGS-84 ellipsoid.
struct Bearing {
  Metres length{};
  Radians course{};  ///< at its beginning, from north, clockwise, -pi to pi
};
[[nodiscard]] Bearing bearing(const vehicle::Place& from, const vehicle::Place& to);

/// The place so far away in this direction.
[[nodiscard]] vehicle::Place displaced(const vehicle::Place& from, Radians course, Metres length);

/// Metres on a map.
struct MapPoint {
  double east{};
  double north{};
  friend bool operator==(const MapPoint&, const MapPoint&) = default;
};

/// A map on which geodesics are nearly straight lines: the gnomonic projection. Lengths are true in its centre, and
/// 0.01 % too long 90 km away.
class Map {
 public:
  explicit Map(const vehicle::Place& centre) : centre_{centre} {}
  /// A place that is beyond the horizon of the centre, a quarter of the Earth away, has no point: NaN.
  [[nodiscard]] MapPoint point(const vehicle::Place& place) const;
  [[nodiscard]] vehicle::Place place(const MapPoint& point) const;

 private:
  vehicle::Place centre_;
};

}  // namespace ponte::planning
