#include "ponte/planning/formats/geojson.hpp"

#include "ponte/planning/formats/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ReadingResult read(std::string_view text) { return read_geojson(bytes_of(text)); }

TEST(ReadGeoJson, PointsWithProperties) {
  const auto reading = read(R"({"type": "Feature", "geometry": {"type": "Point", "coordinates": [8.5, 47.5, 1]},
    "properties": {"name": "mast", "altitude": 40, "altitude_above": "home", "dwell_s": 3, "colour": "red"}})");
  const PointOfInterest mast{.place = place(47.5, 8.5),
                             .altitude = vehicle::Altitude{Metres{40}, vehicle::AltitudeFrame::home},
                             .dwell = vehicle::Seconds{3},
                             .name = "mast"};
  EXPECT_THAT(content(reading).points, ElementsAre(mast));
  EXPECT_THAT(remarks(reading), ElementsAre("line 2: the property 'colour' is not kept"));
}

TEST(ReadGeoJson, BareGeometriesOfEveryKind) {
  EXPECT_EQ(content(read(R"({"type": "Point", "coordinates": [8, 47]})")).points.size(), 1U);
  EXPECT_EQ(content(read(R"({"type": "MultiPoint", "coordinates": [[8, 47], [9, 47]]})")).points.size(), 2U);
  EXPECT_EQ(content(read(R"({"type": "LineString", "coordinates": [[8, 47], [9, 47]]})")).points.size(), 2U);
  EXPECT_EQ(content(read(R"({"type": "MultiLineString", "coordinates": [[[8, 47], [9, 47]]]})")).points.size(), 2U);
  EXPECT_EQ(
      content(read(R"({"type": "GeometryCollection", "geometries": [{"type": "Point", "coordinates": [8, 47]}]})"))
          .points.size(),
      1U);
}

TEST(ReadGeoJson, ALineAndAFenceFromAMapPage) {
  const auto reading = read_geojson(vector_file("drawn.geojson"));
  const auto file = content(reading);
  ASSERT_EQ(file.points.size(), 3U);
  EXPECT_EQ(file.points[2].altitude, (vehicle::Altitude{Metres{500}, vehicle::AltitudeFrame::msl}));
  EXPECT_EQ(file.points[2].where, at_line(7));
  ASSERT_EQ(file.mission.fence_polygons.size(), 1U);
  EXPECT_TRUE(file.mission.fence_polygons[0].inclusion);
  EXPECT_THAT(file.mission.fence_polygons[0].corners,
              ElementsAre(place(47.39, 8.54), place(47.39, 8.55), place(47.40, 8.55)));
  EXPECT_THAT(remarks(reading),
              ElementsAre(HasSubstr("line 9: a polygon is not kept"), HasSubstr("line 1: its altitudes are taken as")));
}

TEST(ReadGeoJson, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal(read("{\n\"type\": \"Point\",\n\"coordinates\": [8.5,\n\n147.5]}")),
            "line 3: latitude is 147.5: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal(read(R"({"type": "Point", "coordinates": [-33.9, 151.2]})")),
            "line 1: latitude is 151.2: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal(read("{\"type\": \"Point\",\n\"coordinates\": [8.5, \"47.5\"]}")),
            "line 2: latitude is '47.5': expected a number");
  EXPECT_EQ(refusal(read(R"({"type": "Point", "coordinates": [8.5]})")),
            "line 1: a position has 1 numbers: expected longitude, latitude and perhaps altitude");
  EXPECT_EQ(refusal(read(R"({"type": "Circle", "coordinates": []})")),
            "line 1: type is 'Circle': expected a type of RFC 7946");
  EXPECT_EQ(refusal(read(R"({"type": "FeatureCollection", "features": []})")),
            "the file: there is no point in it: expected points, a line, or areas that are fences");
  EXPECT_EQ(refusal(read(R"({"type": "MultiLineString", "coordinates": [[[8, 47], [9, 47]],
    [[8, 48], [9, 48]]]})")),
            "line 2: this is one of 2 lines, and there are no points: expected points, or one line");
  EXPECT_THAT(refusal(read("{\"type\": \"Point\",\n\"coordinates\": [8.5, 47.5")), HasSubstr("line 2: "));
  EXPECT_THAT(refusal(read(R"({"type": "Point", "type": "Point", "coordinates": [8, 47]})")),
              HasSubstr("'type' comes twice in one object"));
  EXPECT_THAT(refusal(read(std::string(100'000, '['))),
              HasSubstr("it is nested too deeply: expected at most 64 levels"));
  EXPECT_EQ(refusal(read(R"({"type": "Feature", "properties": {"fence": "exclusion"}, "geometry": {"type": "Polygon",
    "coordinates": [[[8, 47], [9, 47], [9, 48]]]}})")),
            "line 2: the ring of a polygon is not closed: expected the last position to be the first again");
}

TEST(WriteGeoJson, AFeatureToALineLongitudeFirst) {
  MissionFile file;
  file.points.push_back({.place = place(47.5, 8.5), .altitude = vehicle::Altitude{Metres{500}}, .priority = 2});
  file.points.push_back({.place = place(47.6, 8.6),
                         .altitude = vehicle::Altitude{Metres{40}, vehicle::AltitudeFrame::home},
                         .name = "mast"});
  EXPECT_EQ(text_of(write_geojson(file)), R"({"type":"FeatureCollection","features":[
{"type":"Feature","geometry":{"type":"Point","coordinates":[8.5,47.5,500]},"properties":{"altitude":500,"altitude_above":"msl","priority":2}},
{"type":"Feature","geometry":{"type":"Point","coordinates":[8.6,47.6]},"properties":{"name":"mast","altitude":40,"altitude_above":"home"}}
]}
)");
}

}  // namespace
}  // namespace ponte::planning
