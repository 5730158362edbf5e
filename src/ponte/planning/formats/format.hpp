#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::planning {

enum class Format : std::uint8_t {
  poi,      ///< path.poi: binary pairs of latitude and longitude
  csv,      ///< a table with a header
  geojson,  ///< RFC 7946
  kml,      ///< OGC KML 2.2
  kmz,      ///< KML in a zip archive
  gpx,      ///< GPX 1.1
  plan,     ///< QGroundControl's plan
  wpl,      ///< "QGC WPL 110", also Mission Planner's .waypoints
};
inline constexpr std::array formats{Format::poi, Format::csv, Format::geojson, Format::kml,
                                    Format::kmz, Format::gpx, Format::plan,    Format::wpl};

/// "poi", "csv", ...: what `--from` and `--to` take.
[[nodiscard]] std::string_view name_of(Format format);
[[nodiscard]] std::optional<Format> format_named(std::string_view name);
/// Of all formats, in their order.
[[nodiscard]] std::vector<std::string> format_names();
/// By the end of a file's name, e.g. "a.waypoints" is `wpl`; upper and lower case are the same.
[[nodiscard]] std::optional<Format> format_of_name(std::string_view file_name);

/// What the bytes are by their content. The file's name decides only where the content leaves it open.
[[nodiscard]] Result<Format, FormatError> detect_format(Bytes bytes, std::string_view file_name);

/// Reads a file of this format.
[[nodiscard]] ReadingResult read_mission_file(Format format, Bytes bytes, const ReadOptions& options = {});

/// Writes everything that this format can say; points become waypoints and waypoints points where it calls for them.
/// Refuses what the format has no way to hold at all.
[[nodiscard]] Result<Writing, FormatError> write_mission_file(Format format, const MissionFile& content);

}  // namespace ponte::planning
