#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <array>
#include <string_view>

/// `path.poi` of the mission control of 2016: floating-point values without a header, in pairs, latitude and longitude
/// in degrees. Neither the width of the values nor their byte order is recorded.
namespace ponte::planning {

inline constexpr std::array poi_layouts{PoiLayout::f64_le, PoiLayout::f64_be, PoiLayout::f32_le, PoiLayout::f32_be};

/// "f64-le", ...
[[nodiscard]] std::string_view name_of(PoiLayout layout);

/// Reads the bytes in the one layout in which every value is a coordinate. Refuses, and says why, where none or several
/// remain, unless `options.poi_layout` tells.
[[nodiscard]] ReadingResult read_poi(Bytes bytes, const ReadOptions& options = {});

/// Writes `f64_le`.
[[nodiscard]] Writing write_poi(const MissionFile& content);

}  // namespace ponte::planning
