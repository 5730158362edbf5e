#pragma once

#include "ponte/planning/formats/mission_file.hpp"

/// GeoJSON after RFC 7946. A point's properties may be name, altitude, altitude_above, dwell_s, priority and
/// sensor_quality; a polygon's property fence, "inclusion" or "exclusion", makes a geofence of it. The third number of
/// a position is taken as an altitude above mean sea level unless altitude_above tells otherwise.
namespace ponte::planning {

[[nodiscard]] ReadingResult read_geojson(Bytes bytes, const ReadOptions& options = {});
[[nodiscard]] Writing write_geojson(const MissionFile& content);

}  // namespace ponte::planning
