#include "ponte/planning/turning.hpp"

#include "ponte/planning/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace ponte::planning {
namespace {

constexpr auto infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t degrees = 360;
constexpr auto degree = std::numbers::pi / 180;

/// The chords of a path are tested against the zones: they leave a circle by a thousandth of its radius.
constexpr auto tested_every = 5 * degree;

/// From each of `rows` poses past the best of `between` to each of `columns`.
std::vector<double> joined(const std::vector<double>& first, const std::vector<double>& second, std::size_t rows,
                           std::size_t between, std::size_t columns) {
  std::vector<double> result(rows * columns, infinite);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < between; ++i)
      for (std::size_t column = 0; column < columns; ++column) {
        auto& seconds = result[row * columns + column];
        seconds = std::min(seconds, first[row * between + i] + second[i * columns + column]);
      }
  return result;
}

double of_degree(std::size_t number) { return static_cast<double>(number) * degree; }

}  // namespace

FlyingTimes::FlyingTimes(MetresPerSecond airspeed, const Wind& wind) : airspeed_{airspeed}, wind_{wind} {
  if (wind.speed.value == 0) return;
  turned_.push_back(0);
  for (std::size_t i = 0; i < degrees; ++i)
    turned_.push_back(turned_.back() + straight(degree, Radians{of_degree(i) + degree / 2}));
}

double FlyingTimes::straight(double metres, Radians course) const {
  return metres > 0 ? metres / ground_speed(airspeed_, course, wind_).value : 0;
}

double FlyingTimes::seconds_of_turn(double from_course, double to_course, double radius) const {
  const auto turned_to = [&](double course) {
    const auto rounds = std::floor(course / (2 * std::numbers::pi));
    const auto part = std::clamp((course - rounds * 2 * std::numbers::pi) / degree, 0.0, degrees - 1e-9);
    const auto whole = static_cast<std::size_t>(part);
    return rounds * turned_.back() + std::lerp(turned_[whole], turned_[whole + 1], part - std::floor(part));
  };
  return radius * std::abs(turned_to(to_course) - turned_to(from_course));
}

double FlyingTimes::along(const DubinsPath& path) const {
  if (turned_.empty()) return path.length() / airspeed_.value;
  if (!std::isfinite(turned_.back())) return infinite;
  double sum = 0;
  auto course = path.start.course.value;
  for (const auto& piece : path.pieces) {
    const auto next = course + piece.bend * piece.metres / path.radius;
    sum += piece.bend == 0 ? straight(piece.metres, Radians{course}) : seconds_of_turn(course, next, path.radius);
    course = next;
  }
  return sum;
}

// The craft turns as fast as in still air, and the track bends by that much less as it is faster over ground, and again
// as its course changes less than its heading.
Metres turn_radius_in_wind(Metres radius, MetresPerSecond airspeed, const Wind& wind) {
  const auto faster = 1 + wind.speed / airspeed;
  return radius * (faster * faster);
}

std::vector<Pose> poses_at(const MapPoint& point) {
  std::vector<Pose> result;
  for (std::size_t i = 0; i < courses; ++i)
    result.push_back({point, Radians{2 * std::numbers::pi * static_cast<double>(i) / courses}});
  return result;
}

std::vector<double> marks(const DubinsPath& path, double radians) {
  std::vector<double> result;
  double flown = 0;
  for (const auto& piece : path.pieces) {
    if (piece.metres == 0) continue;
    const auto parts = piece.bend == 0 ? 1.0 : std::ceil(piece.metres / (path.radius * radians));
    for (double part = 1; part <= parts; ++part) result.push_back(flown + piece.metres * part / parts);
    flown += piece.metres;
  }
  return result;
}

bool TurningWays::is_free(const DubinsPath& path) const {
  if (airspace_.has_no_zones()) return true;
  auto at = path.start.at;
  for (const auto metres : marks(path, tested_every)) {
    const auto point = path.pose_after(metres).at;
    if (!airspace_.is_free(std::exchange(at, point), point)) return false;
  }
  return true;
}

std::optional<TurningWays::Way> TurningWays::direct(const Pose& from, const Pose& to) const {
  std::array<std::pair<double, DubinsPath>, dubins_words.size()> paths;
  std::size_t count = 0;
  for (const auto word : dubins_words)
    if (const auto path = dubins_path(word, from, to, radius_))
      if (const auto seconds = times_.along(*path); std::isfinite(seconds)) paths[count++] = {seconds, *path};
  const auto found = std::span{paths}.first(count);
  std::ranges::stable_sort(found, {}, &std::pair<double, DubinsPath>::first);
  for (const auto& [seconds, path] : found)
    if (is_free(path)) return Way{{path}, seconds};
  return std::nullopt;
}

std::optional<TurningWays::Way> TurningWays::way(const Pose& from, std::span<const MapPoint> corners,
                                                 const Pose& to) const {
  auto best = direct(from, to);
  if (best || corners.empty()) return best;
  // The fastest way to each pose at the corner before, and from there on.
  std::vector<std::pair<Pose, Way>> reached{{from, {}}};
  const auto go_on = [&](const Pose& next) -> std::optional<Way> {
    std::optional<Way> fastest;
    for (const auto& [pose, so_far] : reached) {
      const auto leg = direct(pose, next);
      if (!leg || (fastest && so_far.seconds + leg->seconds >= fastest->seconds)) continue;
      fastest = so_far;
      fastest->paths.push_back(leg->paths.front());
      fastest->seconds += leg->seconds;
    }
    return fastest;
  };
  for (const auto& corner : corners) {
    std::vector<std::pair<Pose, Way>> next;
    for (const auto& pose : poses_at(corner))
      if (auto there = go_on(pose)) next.emplace_back(pose, std::move(*there));
    reached = std::move(next);
  }
  return go_on(to);
}

std::vector<double> TurningWays::direct_seconds(std::span<const Pose> from, std::span<const Pose> to) const {
  std::vector<double> result;
  for (const auto& first : from)
    for (const auto& last : to) {
      const auto found = direct(first, last);
      result.push_back(found ? found->seconds : infinite);
    }
  return result;
}

std::vector<double> TurningWays::seconds(std::span<const Pose> from, std::span<const MapPoint> corners,
                                         std::span<const Pose> to) const {
  auto result = direct_seconds(from, to);
  if (corners.empty() || std::ranges::all_of(result, [](double each) { return std::isfinite(each); })) return result;
  auto at = poses_at(corners.front());
  auto so_far = direct_seconds(from, at);
  for (const auto& corner : corners.subspan(1)) {
    auto next = poses_at(corner);
    so_far = joined(so_far, direct_seconds(at, next), from.size(), courses, courses);
    at = std::move(next);
  }
  const auto past_corners = joined(so_far, direct_seconds(at, to), from.size(), courses, to.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!std::isfinite(result[i])) result[i] = past_corners[i];
  return result;
}

}  // namespace ponte::planning
