#include "ponte/planning/dubins.hpp"

#include "ponte/planning/plane.hpp"

#include <numbers>

namespace ponte::planning {
namespace {

constexpr auto full_turn = 2 * std::numbers::pi;

/// Metres along a circle from one course to another, turning to the right when `bend` is 1. What is a full turn but for
/// rounding is none.
double arc(double from, double to, int bend, double radius) {
  constexpr auto rounding = 1e-9;
  auto angle = std::fmod(bend * (to - from), full_turn);
  if (angle < 0) angle += full_turn;
  return angle > full_turn - rounding ? 0 : angle * radius;
}

/// Of the circle that a vehicle in this pose flies when it turns to this side.
MapPoint centre(const Pose& pose, int bend, double radius) {
  return displaced(pose.at, pose.course + Radians{bend * std::numbers::pi / 2}, radius);
}

Pose after(const Pose& pose, const DubinsPath::Piece& piece, double radius) {
  if (piece.bend == 0) return {displaced(pose.at, pose.course, piece.metres), pose.course};
  const auto course = pose.course + Radians{piece.bend * piece.metres / radius};
  const auto middle = centre(pose, piece.bend, radius);
  return {displaced(middle, course - Radians{piece.bend * std::numbers::pi / 2}, radius), course};
}

/// First a circle to the side of `bend`, then a straight line, then a circle to the side of `last`.
std::optional<DubinsPath> straight_between(const Pose& from, const Pose& to, double radius, int bend, int last) {
  const auto first_centre = centre(from, bend, radius);
  const auto last_centre = centre(to, last, radius);
  const auto apart = length(last_centre - first_centre);
  auto line = course(first_centre, last_centre).value;
  auto straight = apart;
  if (bend != last) {
    // The line crosses the one between the centres.
    if (apart < 2 * radius) return std::nullopt;
    straight = std::sqrt(apart * apart - 4 * radius * radius);
    line += bend * std::atan2(2 * radius, straight);
  } else if (apart < 1e-9 * radius) {
    line = from.course.value;  // both circles are one
  }
  return DubinsPath{from,
                    radius,
                    {{{bend, arc(from.course.value, line, bend, radius)},
                      {0, straight},
                      {last, arc(line, to.course.value, last, radius)}}}};
}

/// Three circles that touch, the one in the middle on either side of the line between the other two.
std::optional<DubinsPath> circle_between(const Pose& from, const Pose& to, double radius, int bend) {
  const auto first_centre = centre(from, bend, radius);
  const auto last_centre = centre(to, bend, radius);
  const auto apart = length(last_centre - first_centre);
  if (apart > 4 * radius) return std::nullopt;
  const auto line = course(first_centre, last_centre);
  const auto aside = Radians{std::acos(apart / (4 * radius))};
  std::optional<DubinsPath> best;
  for (const auto side : {aside, -aside}) {
    const auto middle = displaced(first_centre, line + side, 2 * radius);
    const auto quarter = bend * std::numbers::pi / 2;
    const auto leaving = course(first_centre, middle).value + quarter;
    const auto joining = course(last_centre, middle).value + quarter;
    const DubinsPath path{from,
                          radius,
                          {{{bend, arc(from.course.value, leaving, bend, radius)},
                            {-bend, arc(leaving, joining, -bend, radius)},
                            {bend, arc(joining, to.course.value, bend, radius)}}}};
    if (!best || path.length() < best->length()) best = path;
  }
  return best;
}

}  // namespace

DubinsPath DubinsPath::first(double metres) const {
  auto path = *this;
  for (auto& piece : path.pieces) {
    piece.metres = std::min(metres, piece.metres);
    metres -= piece.metres;
  }
  return path;
}

Pose DubinsPath::pose_after(double metres) const {
  auto pose = start;
  for (const auto& piece : first(metres).pieces) pose = after(pose, piece, radius);
  return pose;
}

std::optional<DubinsPath> dubins_path(DubinsWord word, const Pose& from, const Pose& to, double radius) {
  constexpr int left = -1;
  constexpr int right = 1;
  switch (word) {
    case DubinsWord::lsl: return straight_between(from, to, radius, left, left);
    case DubinsWord::lsr: return straight_between(from, to, radius, left, right);
    case DubinsWord::lrl: return circle_between(from, to, radius, left);
    case DubinsWord::rsr: return straight_between(from, to, radius, right, right);
    case DubinsWord::rsl: return straight_between(from, to, radius, right, left);
    case DubinsWord::rlr: return circle_between(from, to, radius, right);
  }
  return std::nullopt;
}

DubinsPath shortest_dubins_path(const Pose& from, const Pose& to, double radius) {
  auto best = *dubins_path(DubinsWord::lsl, from, to, radius);
  for (const auto word : dubins_words)
    if (const auto path = dubins_path(word, from, to, radius); path && path->length() < best.length()) best = *path;
  return best;
}

}  // namespace ponte::planning
