#pragma once

#include "ponte/planning/formats/mission_file.hpp"

/// OGC KML 2.2, plain or in a zip archive (KMZ). Points of placemarks, or one line. Named values of their ExtendedData
/// may be altitude, altitude_above, dwell_s, priority and sensor_quality; a polygon's value fence, "inclusion" or
/// "exclusion", makes a geofence of it. An altitude counts only where altitudeMode tells what it counts from.
namespace ponte::planning {

[[nodiscard]] ReadingResult read_kml(Bytes bytes, const ReadOptions& options = {});
[[nodiscard]] Writing write_kml(const MissionFile& content);

/// The first file of the archive whose name ends in .kml. At most 64 MiB are unpacked.
[[nodiscard]] ReadingResult read_kmz(Bytes bytes, const ReadOptions& options = {});
/// An archive with the one file doc.kml.
[[nodiscard]] Writing write_kmz(const MissionFile& content);

}  // namespace ponte::planning
