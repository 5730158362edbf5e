#pragma once

#include "ponte/planning/formats/mission_file.hpp"

/// "QGC WPL 110": a line for each mission item, twelve fields separated by tabs. As Mission Planner and ArduPilot write
/// it, item 0 is home; "QGC WPL 120" has none. Spaces between the fields and decimal commas, which some writers leave,
/// are understood; a comment line, which pymavlink writes, names the item after it.
namespace ponte::planning {

[[nodiscard]] ReadingResult read_wpl(Bytes bytes, const ReadOptions& options = {});
/// Writes version 110. Without a home, item 0 is one at 0, 0, which means the same.
[[nodiscard]] Result<Writing, FormatError> write_wpl(const MissionFile& content);

}  // namespace ponte::planning
