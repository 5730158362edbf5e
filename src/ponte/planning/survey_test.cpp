#include "ponte/planning/survey.hpp"

#include "ponte/core/random.hpp"
#include "ponte/planning/plane.hpp"
#include "support/seed.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ponte::planning {
namespace {

constexpr auto pi = std::numbers::pi;
const vehicle::Place home{radians_from_degrees(-30.0667), radians_from_degrees(-51.1221)};
constexpr Camera camera{Metres{0.0132}, Metres{0.0088}, Metres{0.0088}, 5472};

std::vector<vehicle::Place> on_ground(const std::vector<MapPoint>& points) {
  std::vector<vehicle::Place> places;
  for (const auto& point : points) places.push_back(Map{home}.place(point));
  return places;
}

SurveyStyle style(double side_overlap, double front_overlap) {
  return {.footprint = {Metres{60}, Metres{40}},
          .side_overlap = side_overlap,
          .front_overlap = front_overlap,
          .turnaround = Metres{20}};
}

/// A picture: its middle and the direction of its line.
struct Picture {
  MapPoint at;
  Radians course;
};

std::vector<std::vector<Picture>> pictures(const std::vector<SurveyLine>& lines) {
  std::vector<std::vector<Picture>> result;
  const Map map{home};
  for (const auto& line : lines) {
    auto& row = result.emplace_back();
    const auto begin = map.point(line.begin);
    const auto end = map.point(line.end);
    const auto along = course(begin, end);
    const auto count = std::lround(length(end - begin) / line.spacing.value);
    EXPECT_NEAR(length(end - begin), static_cast<double>(count) * line.spacing.value, 0.01);
    for (long i = 0; i <= count; ++i)
      row.push_back({displaced(begin, along, static_cast<double>(i) * line.spacing.value), along});
  }
  return result;
}

bool shows(const Picture& picture, const Footprint& footprint, const MapPoint& point) {
  constexpr auto rounding = 0.01;
  const auto offset = point - picture.at;
  const MapPoint along{std::sin(picture.course.value), std::cos(picture.course.value)};
  return std::abs(dot(offset, along)) <= footprint.along.value / 2 + rounding &&
         std::abs(cross(along, offset)) <= footprint.across.value / 2 + rounding;
}

/// How many lines show the point, and how many pictures of the line that shows it most often.
std::pair<int, int> times_shown(const std::vector<std::vector<Picture>>& rows, const Footprint& footprint,
                                const MapPoint& point) {
  int lines = 0;
  int most = 0;
  for (const auto& row : rows) {
    const auto count = static_cast<int>(
        std::ranges::count_if(row, [&](const Picture& picture) { return shows(picture, footprint, point); }));
    if (count > 0) ++lines;
    most = std::max(most, count);
  }
  return {lines, most};
}

/// A star with corners at random distances: mostly concave, and never crossing itself.
std::vector<MapPoint> random_polygon(Random& random) {
  std::vector<MapPoint> corners;
  const auto count = 3 + random.below(9);
  for (std::uint32_t i = 0; i < count; ++i)
    corners.push_back(displaced({}, Radians{2 * pi * i / count}, 80 + 300 * random.unit()));
  return corners;
}

TEST(Camera, SeesWhatItsSensorAndLensTell) {
  // 13.2 by 8.8 mm behind 8.8 mm: 1.5 times as wide as it is high above ground.
  EXPECT_NEAR(footprint(camera, Metres{100}).across.value, 150, 1e-9);
  EXPECT_NEAR(footprint(camera, Metres{100}).along.value, 100, 1e-9);
  EXPECT_NEAR(ground_sampling_distance(camera, Metres{100}).value, 150.0 / 5472, 1e-12);
  EXPECT_NEAR(height_for(camera, ground_sampling_distance(camera, Metres{73})).value, 73, 1e-9);
}

TEST(Survey, GoesAlongTheLongSideOfARectangle) {
  const auto lines = survey(on_ground({{0, 0}, {0, 500}, {100, 500}, {100, 0}}), style(0.5, 0.5));
  ASSERT_TRUE(lines.has_value());
  ASSERT_EQ(lines->size(), 4U);  // 100 m at 30 m
  EXPECT_NEAR(std::abs(std::cos(bearing((*lines)[0].begin, (*lines)[0].end).course.value)), 1, 1e-6);
  EXPECT_NEAR(bearing((*lines)[0].begin, (*lines)[0].end).length.value, 500, 0.01);
  EXPECT_EQ((*lines)[0].spacing, Metres{20});
  EXPECT_EQ((*lines)[0].run_in, Metres{20});
}

TEST(Survey, TakesTheCourseThatIsAsked) {
  auto asked = style(0.5, 0.5);
  asked.course = radians_from_degrees(90);
  const auto lines = survey(on_ground({{0, 0}, {0, 500}, {100, 500}, {100, 0}}), asked);
  ASSERT_TRUE(lines.has_value());
  EXPECT_EQ(lines->size(), 17U);
  EXPECT_NEAR(std::abs(std::sin(bearing((*lines)[0].begin, (*lines)[0].end).course.value)), 1, 1e-6);
}

TEST(Survey, SkipsWhatIsBetweenTheArmsOfAConcavePolygon) {
  // A U whose arms are 300 m apart.
  auto asked = style(0.5, 0.5);
  asked.course = radians_from_degrees(90);
  const auto lines =
      survey(on_ground({{0, 0}, {400, 0}, {400, 300}, {350, 300}, {350, 50}, {50, 50}, {50, 300}, {0, 300}}), asked);
  ASSERT_TRUE(lines.has_value());
  EXPECT_TRUE(std::ranges::any_of(
      *lines, [](const SurveyLine& line) { return bearing(line.begin, line.end).length.value < 100; }));
}

TEST(Survey, RefusesWhatIsNoArea) {
  const auto error = [](const std::vector<MapPoint>& corners) {
    const auto lines = survey(on_ground(corners), style(0.5, 0.5));
    return lines ? std::string{} : lines.error();
  };
  EXPECT_THAT(error({{0, 0}, {10, 0}}), ::testing::HasSubstr("2 corners"));
  EXPECT_THAT(error({{0, 0}, {100, 100}, {100, 0}, {0, 100}}), ::testing::HasSubstr("side 1 of the polygon meets"));
  EXPECT_THAT(error({{0, 0}, {90'000, 0}, {90'000, 90'000}}), ::testing::HasSubstr("more than 1000 lines"));
}

// A point of the polygon is shown by neighbouring lines, and by pictures of one line, as often as the overlap says:
// half of the pictures twice at 50 %; at the borders of the area at least once.
TEST(SurveySeeded, ShowsEveryPointWithTheOverlapThatIsAsked) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 20; ++seed) {
    Random random{seed};
    const auto corners = random_polygon(random);
    auto asked = style(0.8 * random.unit(), 0.8 * random.unit());
    if (random.chance(0.5)) asked.course = Radians{2 * pi * random.unit()};
    const auto lines = survey(on_ground(corners), asked);
    ASSERT_TRUE(lines.has_value()) << lines.error();
    const auto rows = pictures(*lines);
    const auto along = rows.front().front().course;
    const MapPoint across{std::cos(along.value), -std::sin(along.value)};
    double least = 0;
    double most = 0;
    for (const auto& corner : corners) {
      least = std::min(least, dot(corner, across));
      most = std::max(most, dot(corner, across));
    }
    const auto lines_wanted = static_cast<int>(std::floor(1 / (1 - asked.side_overlap) + 1e-6));
    const auto pictures_wanted = static_cast<int>(std::floor(1 / (1 - asked.front_overlap) / 2 + 0.5 + 1e-6));
    for (int i = 0; i < 400; ++i) {
      const MapPoint point{800 * (random.unit() - 0.5), 800 * (random.unit() - 0.5)};
      if (!is_inside(corners, point)) continue;
      const auto [by_lines, by_pictures] = times_shown(rows, asked.footprint, point);
      EXPECT_GE(by_pictures, std::max(pictures_wanted, 1)) << "seed " << seed;
      const auto side = dot(point, across);
      const bool is_amidst = std::min(side - least, most - side) > asked.footprint.across.value;
      EXPECT_GE(by_lines, is_amidst ? lines_wanted : 1) << "seed " << seed;
    }
  }
}

TEST(CorridorSeeded, ShowsEveryPointNearItsLine) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + 20; ++seed) {
    Random random{seed};
    std::vector<MapPoint> line{{}};
    Radians course{};
    for (int i = 0; i < 4; ++i) {
      line.push_back(displaced(line.back(), course, 150 + 200 * random.unit()));
      course = course + Radians{pi * (random.unit() - 0.5) * 1.8};
    }
    const auto asked = style(0.6, 0.6);
    const auto lines = corridor(on_ground(line), Metres{120}, asked);
    ASSERT_TRUE(lines.has_value()) << lines.error();
    const auto rows = pictures(*lines);
    for (int i = 0; i < 400; ++i) {
      const auto leg = 1 + random.below(4);
      const auto on_line = line[leg - 1] + (line[leg] - line[leg - 1]) * random.unit();
      const auto aside =
          displaced(on_line, planning::course(line[leg - 1], line[leg]) + Radians{pi / 2}, 120 * (random.unit() - 0.5));
      EXPECT_GE(times_shown(rows, asked.footprint, aside).first, 1) << "seed " << seed;
      if (leg == 4) continue;
      const auto at_bend = displaced(line[leg], Radians{2 * pi * random.unit()}, 59 * random.unit());
      EXPECT_GE(times_shown(rows, asked.footprint, at_bend).first, 1) << "seed " << seed;
    }
  }
}

TEST(Corridor, RefusesWhatIsNoLine) {
  EXPECT_FALSE(corridor({home}, Metres{50}, style(0.5, 0.5)).has_value());
  EXPECT_FALSE(corridor({home, home}, Metres{50}, style(0.5, 0.5)).has_value());
}

}  // namespace
}  // namespace ponte::planning
