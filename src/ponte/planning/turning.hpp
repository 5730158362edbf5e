#pragma once

#include "ponte/planning/airspace.hpp"
#include "ponte/planning/dubins.hpp"
#include "ponte/planning/wind.hpp"

#include <optional>
#include <span>
#include <vector>

namespace ponte::planning {

/// How long a craft flies on each course and in turns. It holds its airspeed, whatever the wind.
class FlyingTimes {
 public:
  FlyingTimes(MetresPerSecond airspeed, const Wind& wind);

  /// Seconds for a straight line; infinite where the wind does not let it hold this course.
  [[nodiscard]] double straight(double metres, Radians course) const;
  /// Infinite when the wind is as fast as the craft.
  [[nodiscard]] double along(const DubinsPath& path) const;

 private:
  [[nodiscard]] double seconds_of_turn(double from_course, double to_course, double radius) const;

  MetresPerSecond airspeed_;
  Wind wind_;
  std::vector<double> turned_;  ///< seconds for a circle of radius 1 from north to each degree
};

/// The radius over ground that a craft with this radius in still air keeps on every course: that with the wind behind
/// it, where it turns widest.
[[nodiscard]] Metres turn_radius_in_wind(Metres radius, MetresPerSecond airspeed, const Wind& wind);

/// The courses that a turning craft may have where none is prescribed: every 30 degrees.
inline constexpr std::size_t courses = 12;
[[nodiscard]] std::vector<Pose> poses_at(const MapPoint& point);

/// Ways of a craft that cannot turn on the spot, through allowed air.
class TurningWays {
 public:
  TurningWays(const Airspace& airspace, FlyingTimes times, Metres radius)
      : airspace_{airspace}, times_{std::move(times)}, radius_{radius.value} {}

  struct Way {
    std::vector<DubinsPath> paths{};
    double seconds{};
  };
  /// The fastest way: of one path, or past the corners, where a way without turns would turn. Nothing if there is none.
  [[nodiscard]] std::optional<Way> way(const Pose& from, std::span<const MapPoint> corners, const Pose& to) const;

  /// The seconds of the ways from each pose to each, those from the first pose first; infinite where there is none.
  [[nodiscard]] std::vector<double> seconds(std::span<const Pose> from, std::span<const MapPoint> corners,
                                            std::span<const Pose> to) const;

 private:
  [[nodiscard]] std::optional<Way> direct(const Pose& from, const Pose& to) const;
  [[nodiscard]] std::vector<double> direct_seconds(std::span<const Pose> from, std::span<const Pose> to) const;
  [[nodiscard]] bool is_free(const DubinsPath& path) const;

  const Airspace& airspace_;
  FlyingTimes times_;
  double radius_;
};

/// Where along the path, in metres, each of its pieces ends, and in turns each part of at most so many radians.
[[nodiscard]] std::vector<double> marks(const DubinsPath& path, double radians);

}  // namespace ponte::planning
