#include "ponte/planning/dubins.hpp"

#include "ponte/core/random.hpp"
#include "ponte/planning/plane.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ponte::planning {
namespace {

constexpr auto pi = std::numbers::pi;
constexpr double radius = 50;

struct Known {
  DubinsWord word;
  MapPoint to;
  double course;
  double length;  ///< worked out by hand, in radii
};
// All begin in the origin on course north.
const Known known[] = {
    {DubinsWord::rsr, {2 * radius, 0}, pi, pi},                // half a circle
    {DubinsWord::lsl, {-2 * radius, 0}, pi, pi},               //
    {DubinsWord::rsr, {0, 7 * radius}, 0, 7},                  // straight on
    {DubinsWord::lsl, {0, 7 * radius}, 0, 7},                  //
    {DubinsWord::rsr, {2 * radius, -3 * radius}, pi, pi + 3},  // round, and back
    {DubinsWord::lsr, {-5 * radius, 2 * radius}, 0, pi + 3},   // a quarter left, on, a quarter right
    {DubinsWord::rsl, {5 * radius, 2 * radius}, 0, pi + 3},    //
    {DubinsWord::rlr, {0, 0}, pi, 7 * pi / 3},                 // a drop: 60, 300 and 60 degrees
    {DubinsWord::lrl, {0, 0}, -pi, 7 * pi / 3},                //
};

double course_difference(Radians a, Radians b) { return std::abs(std::remainder(a.value - b.value, 2 * pi)); }

Pose random_pose(Random& random) {
  const auto east = 400 * (random.unit() - 0.5);
  const auto north = 400 * (random.unit() - 0.5);
  return {{east, north}, Radians{2 * pi * random.unit()}};
}

void expect_ends_at(const DubinsPath& path, const Pose& end, std::uint64_t seed) {
  const auto reached = path.pose_after(path.length());
  EXPECT_LT(length(reached.at - end.at), 1e-6) << "seed " << seed;
  EXPECT_LT(course_difference(reached.course, end.course), 1e-6) << "seed " << seed;
}

TEST(Dubins, KnowsTheLengthsOfAllSixWords) {
  for (const auto& each : known) {
    const auto path = dubins_path(each.word, {}, {each.to, Radians{each.course}}, radius);
    ASSERT_TRUE(path.has_value());
    EXPECT_NEAR(path->length() / radius, each.length, 1e-9) << "word " << int(each.word);
  }
}

TEST(Dubins, HasNoPathOfAWordWhoseCirclesLieWrong) {
  EXPECT_FALSE(dubins_path(DubinsWord::rlr, {}, {{0, 5 * radius}, {}}, radius).has_value());
  EXPECT_FALSE(dubins_path(DubinsWord::lsr, {}, {{-radius, 0}, {}}, radius).has_value());
}

TEST(DubinsSeeded, EveryWordLeadsToTheEndAndNoneIsShorterThanTheLine) {
  const auto seed = chosen_seed();
  Random random{seed};
  for (int i = 0; i < 500; ++i) {
    const auto from = random_pose(random);
    const auto to = random_pose(random);
    const auto shortest = shortest_dubins_path(from, to, radius);
    EXPECT_GE(shortest.length(), length(to.at - from.at) - 1e-9) << "seed " << seed;
    for (const auto word : dubins_words) {
      const auto path = dubins_path(word, from, to, radius);
      if (!path) continue;
      EXPECT_LE(shortest.length(), path->length());
      expect_ends_at(*path, to, seed);
    }
  }
}

TEST(DubinsSeeded, IsAsLongBackwardsAndInTheMirror) {
  const auto seed = chosen_seed();
  Random random{seed};
  for (int i = 0; i < 500; ++i) {
    const auto from = random_pose(random);
    const auto to = random_pose(random);
    const auto there = shortest_dubins_path(from, to, radius).length();
    const auto turned = [](const Pose& pose) { return Pose{pose.at, pose.course + Radians{pi}}; };
    EXPECT_NEAR(shortest_dubins_path(turned(to), turned(from), radius).length(), there, 1e-6) << "seed " << seed;
    const auto mirrored = [](const Pose& pose) { return Pose{{-pose.at.east, pose.at.north}, -pose.course}; };
    EXPECT_NEAR(shortest_dubins_path(mirrored(from), mirrored(to), radius).length(), there, 1e-6) << "seed " << seed;
  }
}

// The path moves ahead on its course, and the course changes no faster than the radius allows.
TEST(DubinsSeeded, IsContinuousAndBendsNoMoreThanItsRadius) {
  const auto seed = chosen_seed();
  Random random{seed};
  constexpr double step = 0.25;
  for (int i = 0; i < 50; ++i) {
    const auto path = shortest_dubins_path(random_pose(random), random_pose(random), radius);
    auto before = path.start;
    for (double flown = step; flown < path.length(); flown += step) {
      const auto pose = path.pose_after(flown);
      EXPECT_LE(course_difference(pose.course, before.course), step / radius + 1e-9) << "seed " << seed;
      const auto expected = displaced(before.at, Radians{before.course.value}, step);
      EXPECT_LT(length(pose.at - expected), step * step / radius) << "seed " << seed;
      before = pose;
    }
  }
}

// Pieces drawn by chance lead somewhere, and nothing of the same word leads there on a longer way.
TEST(DubinsSeeded, FindsPathsThatWereDrawn) {
  const auto seed = chosen_seed();
  Random random{seed};
  constexpr int bends[][3] = {{-1, 0, -1}, {-1, 0, 1}, {-1, 1, -1}, {1, 0, 1}, {1, 0, -1}, {1, -1, 1}};
  for (int i = 0; i < 600; ++i) {
    const auto word = dubins_words[static_cast<std::size_t>(i) % 6];
    DubinsPath drawn{random_pose(random), radius, {}};
    for (std::size_t piece = 0; piece < 3; ++piece)
      drawn.pieces[piece] = {bends[static_cast<std::size_t>(word)][piece], 2 * pi * radius * random.unit()};
    const auto end = drawn.pose_after(drawn.length());
    const auto found = dubins_path(word, drawn.start, end, radius);
    ASSERT_TRUE(found.has_value()) << "seed " << seed;
    EXPECT_LE(found->length(), drawn.length() + 1e-6) << "seed " << seed;
    expect_ends_at(*found, end, seed);
  }
}

}  // namespace
}  // namespace ponte::planning
