#pragma once

#include "ponte/planning/formats/mission_file.hpp"

/// QGroundControl's `.plan`: JSON with fileType "Plan" and version 1; mission, geoFence and rallyPoints of version 2.
/// Complex items (surveys, landing patterns) are kept word for word as patterns, with the simple items they say they
/// make.
namespace ponte::planning {

[[nodiscard]] ReadingResult read_plan(Bytes bytes, const ReadOptions& options = {});
[[nodiscard]] Result<Writing, FormatError> write_plan(const MissionFile& content);

}  // namespace ponte::planning
