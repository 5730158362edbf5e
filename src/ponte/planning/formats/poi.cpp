#include "ponte/planning/formats/poi.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/refusal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace ponte::planning {
namespace {

std::size_t width_of(PoiLayout layout) {
  return layout == PoiLayout::f64_le || layout == PoiLayout::f64_be ? sizeof(double) : sizeof(float);
}

std::size_t pair_size(PoiLayout layout) { return 2 * width_of(layout); }

double value_at(const std::byte* at, PoiLayout layout) {
  switch (layout) {
    case PoiLayout::f64_le: return load_le<double>(at);
    case PoiLayout::f64_be: return load_be<double>(at);
    case PoiLayout::f32_le: return double{load_le<float>(at)};
    case PoiLayout::f32_be: return double{load_be<float>(at)};
  }
  return 0;
}

/// What the values are in a layout. In a wrong one, most of them are far out of range or very near to 0.
enum class Fit : std::uint8_t {
  none,
  coordinates,
  zeros,  ///< coordinates, but all latitudes or all longitudes are 0
  swapped,
};

bool may_be(double degrees, double highest) {
  constexpr double centimetre = 1e-7;
  return degrees == 0 || (std::abs(degrees) >= centimetre && std::abs(degrees) <= highest);
}

Fit fit_of(Bytes bytes, PoiLayout layout) {
  if (bytes.size() % pair_size(layout) != 0) return Fit::none;
  bool straight = true;
  bool turned = true;
  bool first_are_zero = true;
  bool second_are_zero = true;
  for (std::size_t at = 0; at < bytes.size(); at += pair_size(layout)) {
    const double first = value_at(&bytes[at], layout);
    const double second = value_at(&bytes[at + width_of(layout)], layout);
    straight = straight && may_be(first, 90) && may_be(second, 180);
    turned = turned && may_be(first, 180) && may_be(second, 90);
    first_are_zero = first_are_zero && first == 0;
    second_are_zero = second_are_zero && second == 0;
  }
  if (straight) return first_are_zero || second_are_zero ? Fit::zeros : Fit::coordinates;
  return turned ? Fit::swapped : Fit::none;
}

std::vector<PoiLayout> layouts_with(Bytes bytes, Fit fit) {
  std::vector<PoiLayout> layouts;
  std::ranges::copy_if(poi_layouts, std::back_inserter(layouts),
                       [&](PoiLayout layout) { return fit_of(bytes, layout) == fit; });
  return layouts;
}

std::vector<std::string_view> names_of(const std::vector<PoiLayout>& layouts) {
  std::vector<std::string_view> names;
  for (const auto layout : layouts) names.push_back(name_of(layout));
  return names;
}

PoiLayout layout_of(Bytes bytes) {
  auto found = layouts_with(bytes, Fit::coordinates);
  const bool are_doubles = std::ranges::any_of(found, [](auto layout) { return width_of(layout) == sizeof(double); });
  // The lower halves of round doubles are 0, which makes floats that are 0 at every other place.
  for (const auto layout : layouts_with(bytes, Fit::zeros))
    if (!are_doubles || width_of(layout) == sizeof(double)) found.push_back(layout);
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    refuse(at_byte(0), fmt::format("its values are coordinates as {}", fmt::join(names_of(found), " and as ")),
           "to be told which (--poi-layout)");
  if (const auto swapped = layouts_with(bytes, Fit::swapped); !swapped.empty())
    refuse(at_byte(0), fmt::format("read as {}, latitude and longitude look swapped", name_of(swapped.front())),
           "pairs of latitude and longitude");
  refuse(at_byte(0), "its values are no coordinates, whatever their width and byte order",
         "pairs of latitude -90 to 90 and longitude -180 to 180 (or --poi-layout)");
}

}  // namespace

std::string_view name_of(PoiLayout layout) {
  constexpr std::array<std::string_view, poi_layouts.size()> names{"f64-le", "f64-be", "f32-le", "f32-be"};
  return names[static_cast<std::size_t>(layout)];
}

ReadingResult read_poi(Bytes bytes, const ReadOptions& options) try {
  if (bytes.empty()) refuse({}, "it is empty", "pairs of latitude and longitude");
  const auto smallest = pair_size(options.poi_layout.value_or(PoiLayout::f32_le));
  if (const auto rest = bytes.size() % smallest; rest != 0)
    refuse(at_byte(bytes.size() - rest), fmt::format("{} bytes remain", rest),
           fmt::format("pairs of {} bytes", smallest));
  const auto layout = options.poi_layout ? *options.poi_layout : layout_of(bytes);
  Reading reading;
  for (std::size_t at = 0; at < bytes.size(); at += pair_size(layout)) {
    const double latitude = value_at(&bytes[at], layout);
    const double longitude = value_at(&bytes[at + width_of(layout)], layout);
    reading.content.points.push_back({.place = checked_place(latitude, longitude, at_byte(at)), .where = at_byte(at)});
  }
  reading.remarks = doubts(reading.content.points);
  return reading;
} catch (const FormatError& error) {
  return fail(error);
}

Writing write_poi(const MissionFile& content) {
  auto [points, losses] = points_for(content, {});
  Writing writing{.bytes = {}, .losses = std::move(losses)};
  writing.bytes.resize(points.size() * pair_size(PoiLayout::f64_le));
  auto* at = writing.bytes.data();
  for (const auto& point : points) {
    store_le(at, degrees_from_radians(point.place.latitude));
    store_le(at + sizeof(double), degrees_from_radians(point.place.longitude));
    at += pair_size(PoiLayout::f64_le);
  }
  return writing;
}

}  // namespace ponte::planning
