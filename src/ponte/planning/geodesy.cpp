#include "ponte/planning/geodesy.hpp"

#include "ponte/core/degrees.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Gnomonic.hpp>

namespace ponte::planning {

using GeographicLib::Geodesic;

Bearing bearing(const vehicle::Place& from, const vehicle::Place& to) {
  double length{};
  double course{};
  double course_there{};
  Geodesic::WGS84().Inverse(degrees_from_radians(from.latitude), degrees_from_radians(from.longitude),
                            degrees_from_radians(to.latitude), degrees_from_radians(to.longitude), length, course,
                            course_there);
  return {Metres{length}, radians_from_degrees(course)};
}

vehicle::Place displaced(const vehicle::Place& from, Radians course, Metres length) {
  double latitude{};
  double longitude{};
  Geodesic::WGS84().Direct(degrees_from_radians(from.latitude), degrees_from_radians(from.longitude),
                           degrees_from_radians(course), length.value, latitude, longitude);
  return {radians_from_degrees(latitude), radians_from_degrees(longitude)};
}

MapPoint Map::point(const vehicle::Place& place) const {
  MapPoint result;
  GeographicLib::Gnomonic{Geodesic::WGS84()}.Forward(
      degrees_from_radians(centre_.latitude), degrees_from_radians(centre_.longitude),
      degrees_from_radians(place.latitude), degrees_from_radians(place.longitude), result.east, result.north);
  return result;
}

vehicle::Place Map::place(const MapPoint& point) const {
  double latitude{};
  double longitude{};
  GeographicLib::Gnomonic{Geodesic::WGS84()}.Reverse(degrees_from_radians(centre_.latitude),
                                                     degrees_from_radians(centre_.longitude), point.east, point.north,
                                                     latitude, longitude);
  return {radians_from_degrees(latitude), radians_from_degrees(longitude)};
}

}  // namespace ponte::planning
