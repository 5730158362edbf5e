#pragma once

#include "ponte/planning/formats/losses.hpp"
#include "ponte/planning/formats/mission_file.hpp"

#include <string>
#include <vector>

/// Points as missions and missions as points, and what gets lost on the way.
namespace ponte::planning {

/// What a format of points can say beside places.
struct PointFields {
  bool msl_altitude{};     ///< altitudes above mean sea level
  bool other_altitudes{};  ///< those above home and terrain
  bool dwell{};
  bool priority{};
  bool sensor_quality{};
  bool name{};
  bool fence_polygons{};
};
inline constexpr PointFields every_point_field{true, true, true, true, true, true, true};

struct PointsToWrite {
  std::vector<PointOfInterest> points{};
  std::vector<std::string> losses{};
};

/// The points and, after them, the waypoints of the mission as points, with only what the format says of them.
[[nodiscard]] PointsToWrite points_for(const MissionFile& content, const PointFields& format_says);

struct MissionToWrite {
  vehicle::Mission mission{};
  std::vector<std::string> losses{};
};

/// The mission and, after its items, the points as waypoints. Refuses a point without an altitude.
[[nodiscard]] Result<MissionToWrite, FormatError> mission_for(const MissionFile& content);

/// What of a mission beside its items gets lost in a format that has no place for it.
void lose_zones(const vehicle::Mission& mission, bool fence_polygons_said, Losses& losses);
void lose_settings(const vehicle::Mission& mission, Losses& losses);

/// "take-off", "waypoint", ...; "command 82" for what is not interpreted.
[[nodiscard]] std::string title_of(const vehicle::Action& action);

}  // namespace ponte::planning
