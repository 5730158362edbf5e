#include "ponte/sim/geodesy.hpp"

#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

constexpr double semi_major_axis = 6378137.0;
constexpr double flattening = 1 / 298.257223563;
constexpr double eccentricity_squared = flattening * (2 - flattening);

/// Metres per radian of latitude and of longitude.
struct Radii {
  double along_meridian;
  double along_parallel;
};

Radii radii_at(double latitude, double altitude) {
  const double sine = std::sin(latitude);
  const double w_squared = 1 - eccentricity_squared * sine * sine;
  const double normal = semi_major_axis / std::sqrt(w_squared);
  const double meridional = normal * (1 - eccentricity_squared) / w_squared;
  return {meridional + altitude, (normal + altitude) * std::cos(latitude)};
}

}  // namespace

double horizontal(const NorthEastDown& vector) {
  return std::sqrt(vector.north * vector.north + vector.east * vector.east);
}

NorthEastDown offset_between(const Position& from, const Position& to) {
  const auto radii =
      radii_at((from.latitude.value + to.latitude.value) / 2, (from.altitude_msl.value + to.altitude_msl.value) / 2);
  return {(to.latitude.value - from.latitude.value) * radii.along_meridian,
          wrapped(to.longitude.value - from.longitude.value) * radii.along_parallel,
          from.altitude_msl.value - to.altitude_msl.value};
}

Position displaced(const Position& from, const NorthEastDown& offset) {
  const double altitude = from.altitude_msl.value - offset.down / 2;
  const double latitude = from.latitude.value;
  const double near_middle = latitude + offset.north / radii_at(latitude, altitude).along_meridian / 2;
  const double middle = latitude + offset.north / radii_at(near_middle, altitude).along_meridian / 2;
  const auto radii = radii_at(middle, altitude);
  return {Radians{latitude + offset.north / radii.along_meridian},
          Radians{wrapped(from.longitude.value + offset.east / radii.along_parallel)},
          Metres{from.altitude_msl.value - offset.down}};
}

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace ponte::sim
