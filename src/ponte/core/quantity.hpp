#pragma once

#include <compare>
#include <numbers>
#include <string_view>

namespace ponte {

/// A physical value in the SI unit that its type names. Beyond the mapping files every number is one of these.
template <class Unit>
struct Quantity {
  using unit = Unit;
  double value{};

  constexpr Quantity() = default;
  constexpr explicit Quantity(double number) : value{number} {}

  friend constexpr auto operator<=>(const Quantity&, const Quantity&) = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity{a.value + b.value}; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity{a.value - b.value}; }
  friend constexpr Quantity operator-(Quantity a) { return Quantity{-a.value}; }
  friend constexpr Quantity operator*(Quantity a, double factor) { return Quantity{a.value * factor}; }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
};

// clang-format off
struct MetreUnit                 { static constexpr std::string_view symbol = "m"; };
struct MetrePerSecondUnit        { static constexpr std::string_view symbol = "m/s"; };
struct MetrePerSecondSquaredUnit { static constexpr std::string_view symbol = "m/s^2"; };
struct RadianUnit                { static constexpr std::string_view symbol = "rad"; };
struct RadianPerSecondUnit       { static constexpr std::string_view symbol = "rad/s"; };
struct KelvinUnit                { static constexpr std::string_view symbol = "K"; };
struct PascalUnit                { static constexpr std::string_view symbol = "Pa"; };
struct PercentUnit               { static constexpr std::string_view symbol = "%"; };
struct PercentPerSecondUnit      { static constexpr std::string_view symbol = "%/s"; };
// clang-format on

using Metres = Quantity<MetreUnit>;
using MetresPerSecond = Quantity<MetrePerSecondUnit>;
using MetresPerSecondSquared = Quantity<MetrePerSecondSquaredUnit>;
using Radians = Quantity<RadianUnit>;
using RadiansPerSecond = Quantity<RadianPerSecondUnit>;
using Kelvins = Quantity<KelvinUnit>;
using Pascals = Quantity<PascalUnit>;
using Percent = Quantity<PercentUnit>;
using PercentPerSecond = Quantity<PercentPerSecondUnit>;

[[nodiscard]] constexpr Radians radians_from_degrees(double degrees) {
  return Radians{degrees * (std::numbers::pi / 180)};
}

}  // namespace ponte
