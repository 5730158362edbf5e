#include "ponte/planning/formats/shapes.hpp"

#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ponte::planning {

void take(Shapes shapes, Reading& reading) {
  auto& content = reading.content;
  const bool has_zones = !content.mission.fence_polygons.empty();
  if (shapes.points.empty() && shapes.lines.size() > 1)
    refuse(shapes.lines[1].where, fmt::format("this is one of {} lines, and there are no points", shapes.lines.size()),
           "points, or one line");
  if (shapes.points.empty() && shapes.lines.empty() && !has_zones)
    refuse({}, "there is no point in it", "points, a line, or areas that are fences");
  if (shapes.points.empty() && !shapes.lines.empty()) {
    content.points = std::move(shapes.lines.front().points);
  } else {
    content.points = std::move(shapes.points);
    for (const auto& line : shapes.lines)
      reading.remarks.push_back({line.where, fmt::format("the line of {} points is not kept, since the file has points "
                                                         "beside it",
                                                         line.points.size())});
  }
  std::ranges::move(doubts(content.points), std::back_inserter(reading.remarks));
}

bool is_inclusion(std::string_view fence, Where where) {
  if (fence != "inclusion" && fence != "exclusion")
    refuse(where, fmt::format("fence is '{}'", fence), "\"inclusion\" or \"exclusion\"");
  return fence == "inclusion";
}

void add_ring(vehicle::Mission& mission, vehicle::FencePolygon ring, Where where) {
  if (ring.corners.size() > 1 && ring.corners.front() == ring.corners.back())
    ring.corners.pop_back();
  else
    refuse(where, "the ring of a polygon is not closed", "the last position to be the first again");
  if (ring.corners.size() < 3) refuse(where, fmt::format("a fence has {} corners", ring.corners.size()), "at least 3");
  mission.fence_polygons.push_back(std::move(ring));
}

}  // namespace ponte::planning
