#pragma once

#include "ponte/planning/formats/mission_file.hpp"

/// GPX 1.1, and 1.0, which has the same elements: its waypoints; or, where there are none, its one route; or its one
/// track. The datum of elevations is not specified; they are taken as above mean sea level.
namespace ponte::planning {

[[nodiscard]] ReadingResult read_gpx(Bytes bytes, const ReadOptions& options = {});
/// Writes waypoints.
[[nodiscard]] Writing write_gpx(const MissionFile& content);

}  // namespace ponte::planning
