#pragma once

#include "ponte/core/quantity.hpp"

/// Places on the WGS-84 ellipsoid, and the way from one to another. Away from the poles.
namespace ponte::sim {

/// A place. The geoid of the simulated Earth is its ellipsoid.
struct Position {
  Radians latitude{};
  Radians longitude{};  ///< -pi to pi
  Metres altitude_msl{};
  friend bool operator==(const Position&, const Position&) = default;
};

/// A vector along the Earth's axes, in the SI unit that its name tells.
struct NorthEastDown {
  double north{};
  double east{};
  double down{};

  friend constexpr NorthEastDown operator+(const NorthEastDown& a, const NorthEastDown& b) {
    return {a.north + b.north, a.east + b.east, a.down + b.down};
  }
  friend constexpr NorthEastDown operator-(const NorthEastDown& a, const NorthEastDown& b) {
    return {a.north - b.north, a.east - b.east, a.down - b.down};
  }
  friend constexpr NorthEastDown operator*(const NorthEastDown& a, double factor) {
    return {a.north * factor, a.east * factor, a.down * factor};
  }
  friend bool operator==(const NorthEastDown&, const NorthEastDown&) = default;
};

/// The length over ground.
[[nodiscard]] double horizontal(const NorthEastDown& vector);

/// Metres from one place to another, by the ellipsoid's radii half way. Good to centimetres over ten kilometres.
[[nodiscard]] NorthEastDown offset_between(const Position& from, const Position& to);

/// The place at this offset: the inverse of `offset_between`.
[[nodiscard]] Position displaced(const Position& from, const NorthEastDown& offset);

/// The same angle between -pi and pi.
[[nodiscard]] double wrapped(double angle);

}  // namespace ponte::sim
