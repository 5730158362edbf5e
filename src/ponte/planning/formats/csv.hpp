#pragma once

#include "ponte/planning/formats/mission_file.hpp"

/// Tables with a header, separated by commas, semicolons or tabs. The columns latitude and longitude (or lat; lon, lng,
/// long) in decimal degrees are needed; name, altitude (or alt), altitude_above, dwell_s, priority, sensor_quality may
/// follow, in any order. A decimal comma is understood where the comma does not separate.
namespace ponte::planning {

[[nodiscard]] ReadingResult read_csv(Bytes bytes, const ReadOptions& options = {});
[[nodiscard]] Writing write_csv(const MissionFile& content);

}  // namespace ponte::planning
