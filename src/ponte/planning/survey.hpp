#pragma once

#include "ponte/core/result.hpp"
#include "ponte/planning/task.hpp"

#include <optional>
#include <string>
#include <vector>

/// Lines to fly along so that pictures of an area cover it; the words are those of ground stations.
namespace ponte::planning {

/// A camera that looks straight down, with the wider side of its picture across the flight. All above 0.
struct Camera {
  Metres sensor_width{};
  Metres sensor_height{};
  Metres focal_length{};
  double pixels_across{};  ///< as many as the picture is wide
};

/// What one picture shows of the ground.
struct Footprint {
  Metres across{};  ///< the flight
  Metres along{};
};
[[nodiscard]] Footprint footprint(const Camera& camera, Metres height);

/// The side of the square of ground that one pixel shows (GSD).
[[nodiscard]] Metres ground_sampling_distance(const Camera& camera, Metres height);
/// Where it is so.
[[nodiscard]] Metres height_for(const Camera& camera, Metres ground_sampling_distance);

struct SurveyStyle {
  Footprint footprint{};
  double side_overlap{};   ///< of pictures on neighbouring lines: the part that both show, 0 to 0.95
  double front_overlap{};  ///< of pictures on one line, likewise
  Metres turnaround{};     ///< flown straight before and behind each line
  std::optional<Radians>
      course{};  ///< of the lines, from north; absent: the one of the polygon's sides that costs least
};

/// Lines whose pictures show every point of the polygon, which may be concave. Refuses, in words, a polygon of less
/// than 3 corners, one whose sides cross, and one that takes more than `lines_max` lines.
[[nodiscard]] Result<std::vector<SurveyLine>, std::string> survey(const std::vector<vehicle::Place>& corners,
                                                                  const SurveyStyle& style);
inline constexpr std::size_t lines_max = 1000;

/// The same for all points that are within half the width of a line of at least two places.
[[nodiscard]] Result<std::vector<SurveyLine>, std::string> corridor(const std::vector<vehicle::Place>& line,
                                                                    Metres width, const SurveyStyle& style);

}  // namespace ponte::planning
