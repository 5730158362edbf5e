#pragma once

#include "ponte/planning/formats/mission_file.hpp"

namespace ponte::app {

/// Prints what a file holds, a JSON object for each thing: its "type" is settings, home, item, pattern, fence_polygon,
/// fence_circle, fence_return, rally_point or point. Places are in degrees, altitudes and radii in metres;
/// items are numbered from 1, and a jump has the number of its target.
void print_json(const planning::MissionFile& content);

}  // namespace ponte::app
