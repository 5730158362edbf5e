#include "ponte/planning/formats/coordinates.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ponte::planning {
namespace {

constexpr double far_degrees = 5;  ///< hundreds of kilometres: further than a mission reaches

vehicle::Place swapped(const vehicle::Place& place) { return {place.longitude, place.latitude}; }

/// True when the places lie together, in the sense of one mission. Longitudes meet at 180 degrees.
bool together(const vehicle::Place& a, const vehicle::Place& b) {
  const double limit = radians_from_degrees(far_degrees).value;
  return std::abs(a.latitude.value - b.latitude.value) <= limit &&
         std::abs(std::remainder(a.longitude.value - b.longitude.value, 2 * std::numbers::pi)) <= limit;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

vehicle::Place middle_of(std::span<const PlaceInFile> places) {
  std::vector<double> latitudes;
  std::vector<double> longitudes;
  for (const auto& each : places) {
    latitudes.push_back(each.place.latitude.value);
    longitudes.push_back(each.place.longitude.value);
  }
  return {Radians{median(std::move(latitudes))}, Radians{median(std::move(longitudes))}};
}

}  // namespace

vehicle::Place checked_place(double latitude, double longitude, Where where) {
  const bool latitude_fits = std::abs(latitude) <= 90;
  if (latitude_fits && std::abs(longitude) <= 180)
    return {radians_from_degrees(latitude), radians_from_degrees(longitude)};
  if (latitude_fits) refuse(where, fmt::format("longitude is {}", longitude), "-180 to 180");
  const bool swap_fits = std::abs(latitude) <= 180 && std::abs(longitude) <= 90;
  refuse(where, fmt::format("latitude is {}", latitude),
         swap_fits ? "-90 to 90; latitude and longitude look swapped" : "-90 to 90");
}

std::string to_text(const vehicle::Place& place) {
  return fmt::format("{}, {}", degrees_from_radians(place.latitude), degrees_from_radians(place.longitude));
}

std::vector<Remark> doubts(std::span<const PlaceInFile> places) {
  std::vector<Remark> remarks;
  if (places.empty()) return remarks;
  const auto middle = middle_of(places);
  std::map<std::pair<double, double>, Where> seen;
  for (const auto& [place, where] : places) {
    const auto [first, is_new] = seen.try_emplace({place.latitude.value, place.longitude.value}, where);
    if (place == vehicle::Place{})
      remarks.push_back({where, "0, 0 lies in the Atlantic; is a place missing?"});
    else if (!is_new)
      remarks.push_back({where, fmt::format("{} is the place of {} again", to_text(place), to_text(first->second))});
    else if (!together(place, middle) && together(swapped(place), middle))
      remarks.push_back({where, fmt::format("{} looks swapped: the other way round it lies near the middle of all, {}",
                                            to_text(place), to_text(middle))});
    else if (!together(place, middle))
      remarks.push_back(
          {where, fmt::format("{} lies far from the middle of all, {}", to_text(place), to_text(middle))});
  }
  return remarks;
}

std::vector<Remark> doubts(std::span<const PointOfInterest> points) {
  std::vector<PlaceInFile> places;
  for (const auto& point : points) places.push_back({point.place, point.where});
  return doubts(places);
}

}  // namespace ponte::planning
