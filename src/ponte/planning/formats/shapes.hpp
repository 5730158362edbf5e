#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <string_view>
#include <vector>

namespace ponte::planning {

/// What maps hold: points, lines and areas.
struct Shapes {
  struct Line {
    Where where{};
    std::vector<PointOfInterest> points{};
  };
  std::vector<PointOfInterest> points{};
  std::vector<Line> lines{};
};

/// Where there are points, they are what is meant, and a remark tells of each line; else it is the points of the only
/// line. Throws `FormatError` where there are several lines and no points, or nothing at all.
void take(Shapes shapes, Reading& reading);

/// What a fence's ring is for: "inclusion" or "exclusion". Throws `FormatError`.
[[nodiscard]] bool is_inclusion(std::string_view fence, Where where);

/// Adds the fence, whose corners are a closed ring as maps have it: the last corner is the first again.
void add_ring(vehicle::Mission& mission, vehicle::FencePolygon ring, Where where);

}  // namespace ponte::planning
