#include "ponte/planning/formats/poi.hpp"

#include "ponte/planning/formats/test_files.hpp"
#include "ponte/core/random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Degrees {
  double latitude;
  double longitude;
};
const std::vector<Degrees> porto_alegre{{-30.06898, -51.12179}, {-30.06990, -51.12096}, {-30.07020, -51.12475}};

template <class Number, bool big_endian>
std::vector<std::byte> file_of(const std::vector<Degrees>& points) {
  std::vector<std::byte> bytes(points.size() * 2 * sizeof(Number));
  auto* at = bytes.data();
  for (const auto& [latitude, longitude] : points)
    for (const double value : {latitude, longitude}) {
      if constexpr (big_endian)
        store_be(at, static_cast<Number>(value));
      else
        store_le(at, static_cast<Number>(value));
      at += sizeof(Number);
    }
  return bytes;
}

TEST(ReadPoi, TellsTheFourLayoutsApart) {
  for (const auto& bytes : {file_of<double, false>(porto_alegre), file_of<double, true>(porto_alegre)}) {
    const auto points = content(read_poi(bytes)).points;
    ASSERT_EQ(points.size(), porto_alegre.size());
    EXPECT_EQ(points[2].place, place(-30.07020, -51.12475));
    EXPECT_EQ(points[2].where, at_byte(32));
  }
  for (const auto& bytes : {file_of<float, false>(porto_alegre), file_of<float, true>(porto_alegre)}) {
    const auto points = content(read_poi(bytes)).points;
    ASSERT_EQ(points.size(), porto_alegre.size());
    EXPECT_EQ(points[2].place, place(double{-30.07020F}, double{-51.12475F}));
  }
}

TEST(ReadPoi, TheTestMissionOf2016) {
  const auto reading = read_poi(vector_file("path_2016.poi"));
  EXPECT_EQ(content(reading).points.size(), 8U);
  EXPECT_THAT(remarks(reading), ElementsAre("byte 32: -30.0699, -51.12096 is the place of byte 16 again",
                                            "byte 80: -30.06775, -51.12594 is the place of byte 64 again",
                                            "byte 96: -30.06775, -51.12594 is the place of byte 64 again"));
}

TEST(ReadPoi, RoundDoublesAreNotTakenForFloats) {
  // The lower halves of such doubles are 0, which as a float is a latitude.
  const auto points = content(read_poi(file_of<double, false>({{47.5, 8.5}, {47.25, 8.75}}))).points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].place, place(47.5, 8.5));
}

TEST(ReadPoi, RefusesWhatCanBeReadInTwoWaysUntilItIsTold) {
  // As doubles, these two pairs of floats are one pair of coordinates.
  const auto bytes = file_of<float, false>({{48.85F, 2.35F}, {48.86F, 2.36F}});
  EXPECT_EQ(refusal(read_poi(bytes)),
            "byte 0: its values are coordinates as f64-le and as f32-le: expected to be told which (--poi-layout)");
  EXPECT_EQ(content(read_poi(bytes, {.poi_layout = PoiLayout::f32_le, .altitude_above = {}})).points.size(), 2U);
  EXPECT_EQ(content(read_poi(bytes, {.poi_layout = PoiLayout::f64_le, .altitude_above = {}})).points.size(), 1U);
}

TEST(ReadPoi, IsNeverWrongAboutTheLayout) {
  Random random{2016};
  int refused = 0;
  constexpr int rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    std::vector<Degrees> degrees;
    for (auto count = 1 + random.below(4); count > 0; --count)
      degrees.push_back(
          {std::round((random.unit() - 0.5) * 180e5) / 1e5, std::round((random.unit() - 0.5) * 360e5) / 1e5});
    if (random.chance(0.1)) degrees[0].latitude = 0;
    const auto expected = degrees[0];
    const auto check = [&](const ReadingResult& reading) {
      if (!reading && ++refused > 0) return;
      ASSERT_EQ(reading->content.points.size(), degrees.size());
      EXPECT_NEAR(reading->content.points[0].place.latitude.value, place(expected.latitude, 0).latitude.value, 1e-6);
    };
    check(read_poi(file_of<double, false>(degrees)));
    check(read_poi(file_of<double, true>(degrees)));
    check(read_poi(file_of<float, false>(degrees)));
    check(read_poi(file_of<float, true>(degrees)));
  }
  EXPECT_LT(refused, 4 * rounds / 10);
}

TEST(ReadPoi, SaysWhenLongitudeComesFirst) {
  const auto bytes = file_of<double, false>({{151.2, -33.8}, {151.3, -33.9}});
  EXPECT_THAT(refusal(read_poi(bytes)), HasSubstr("read as f64-le, latitude and longitude look swapped"));
}

TEST(ReadPoi, RefusesWhatIsNone) {
  EXPECT_EQ(refusal(read_poi({})), "the file: it is empty: expected pairs of latitude and longitude");
  auto bytes = file_of<double, false>(porto_alegre);
  bytes.pop_back();
  EXPECT_EQ(refusal(read_poi(bytes)), "byte 40: 7 bytes remain: expected pairs of 8 bytes");
  EXPECT_THAT(refusal(read_poi(file_of<double, false>({{std::nan(""), 3}}))),
              HasSubstr("its values are no coordinates"));
  EXPECT_THAT(
      refusal(read_poi(file_of<double, false>({{91, 8}}), {.poi_layout = PoiLayout::f64_le, .altitude_above = {}})),
      HasSubstr("byte 0: latitude is 91"));
}

TEST(WritePoi, WritesDoublesAndTellsWhatItLeavesOut) {
  MissionFile file;
  file.points.push_back({.place = place(-30.06898, -51.12179), .priority = 2, .name = "mast"});
  file.points.push_back({.place = place(-30.06990, -51.12096)});
  file.points.push_back({.place = place(-30.07020, -51.12475), .altitude = vehicle::Altitude{}});
  const auto writing = write_poi(file);
  EXPECT_EQ(writing.bytes, (file_of<double, false>(porto_alegre)));
  EXPECT_THAT(writing.losses, ElementsAre("altitude: point 3", "name: point 1", "priority: point 1"));
}

}  // namespace
}  // namespace ponte::planning
