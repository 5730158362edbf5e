#include "ponte/planning/formats/kml.hpp"

#include "ponte/planning/formats/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A KML whose placemark, from line 2 on, holds this.
ReadingResult read_placemark(const std::string& inside) {
  return read_kml(
      bytes_of("<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Placemark>" + inside + "</Placemark></kml>"));
}

TEST(ReadKml, AFolderOfGoogleEarth) {
  const auto reading = read_kml(vector_file("google_earth.kml"));
  const auto file = content(reading);
  const PointOfInterest first{.place = place(47.39775, 8.54565), .name = "Mast & line 1"};
  const PointOfInterest second{.place = place(47.3981, 8.5461),
                               .altitude = vehicle::Altitude{Metres{35}, vehicle::AltitudeFrame::terrain},
                               .dwell = vehicle::Seconds{4.5},
                               .name = "Mast 2"};
  EXPECT_THAT(file.points, ElementsAre(first, second));
  EXPECT_EQ(file.points[1].where, at_line(26));
  ASSERT_EQ(file.mission.fence_polygons.size(), 1U);
  EXPECT_FALSE(file.mission.fence_polygons[0].inclusion);
  EXPECT_EQ(file.mission.fence_polygons[0].corners.size(), 3U);
  EXPECT_THAT(remarks(reading),
              ElementsAre("line 21: the value 'owner' of ExtendedData is not kept",
                          "line 33: the line of 3 points is not kept, since the file has points beside it"));
}

TEST(ReadKml, AnAltitudeClampedToTheGroundIsNone) {
  const auto reading = read_placemark("<Point><coordinates>8.5,47.5,40</coordinates></Point>");
  EXPECT_EQ(content(reading).points.at(0).altitude, std::nullopt);
  EXPECT_THAT(remarks(reading), ElementsAre("line 2: the altitude 40 is not kept: altitudeMode is clampToGround"));
}

TEST(ReadKml, ALineWithoutPointsIsThePath) {
  const auto reading = read_placemark(
      "<LineString><altitudeMode>absolute</altitudeMode><coordinates>8.5,47.5,500\n8.6,47.6,510 "
      "</coordinates></LineString>");
  const auto points = content(reading).points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].altitude, (vehicle::Altitude{Metres{510}, vehicle::AltitudeFrame::msl}));
  EXPECT_EQ(points[1].where, at_line(3));
}

TEST(ReadKml, SaysWhatIsWrongAndWhere) {
  const auto refusal_of = [](const std::string& inside) { return refusal(read_placemark(inside)); };
  EXPECT_EQ(refusal_of("\n<Point><coordinates>8.5,97.5</coordinates></Point>"),
            "line 3: latitude is 97.5: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal_of("<Point><coordinates>8.5, 47.5</coordinates></Point>"),
            "line 2: coordinates has '8.5,': expected longitude,latitude or longitude,latitude,altitude");
  EXPECT_EQ(refusal_of("<Point><coordinates>8.5</coordinates></Point>"),
            "line 2: coordinates has '8.5': expected longitude,latitude without spaces between");
  EXPECT_EQ(refusal_of("<Point><coordinates/></Point>"), "line 2: <Point> has no coordinates: expected some");
  EXPECT_EQ(refusal_of("<Point><coordinates>1,2 3,4</coordinates></Point>"),
            "line 2: the point has 2 positions: expected one");
  EXPECT_EQ(refusal_of("<name>nothing</name>"),
            "the file: there is no point in it: expected points, a line, or areas that are fences");
  EXPECT_EQ(refusal(read_kml(bytes_of("<gpx/>"))), "line 1: the root is <gpx>: expected <kml>");
  EXPECT_THAT(refusal(read_kml(bytes_of("<kml>\n<Placemark>\n</kml>"))), HasSubstr("line 3: Start-end tags mismatch"));
}

TEST(ReadKml, RefusesADoctypeWithItsEntities) {
  const std::string bomb =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE kml [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]>\n<kml>&b;</kml>";
  EXPECT_EQ(refusal(read_kml(bytes_of(bomb))), "line 2: it has a DOCTYPE: expected none");
}

TEST(ReadKml, IsNotImpressedByDepth) {
  std::string deep = "<kml>";
  for (int i = 0; i < 100'000; ++i) deep += "<Folder>";
  EXPECT_THAT(refusal(read_kml(bytes_of(deep))), HasSubstr("expected XML"));
  for (int i = 0; i < 100'000; ++i) deep += "</Folder>";
  EXPECT_THAT(refusal(read_kml(bytes_of(deep + "</kml>"))), HasSubstr("there is no point in it"));
}

MissionFile three_points() {
  MissionFile file;
  file.points.push_back({.place = place(47.5, 8.5), .name = "a < b & c"});
  file.points.push_back({.place = place(-0.0000001, -179.9999999),
                         .altitude = vehicle::Altitude{Metres{40.25}, vehicle::AltitudeFrame::home},
                         .dwell = vehicle::Seconds{0.5},
                         .priority = 7,
                         .sensor_quality = 0.25});
  file.points.push_back(
      {.place = place(90, 180), .altitude = vehicle::Altitude{Metres{-3}, vehicle::AltitudeFrame::msl}});
  return file;
}

TEST(WriteKml, IsReadAsItWas) {
  const auto writing = write_kml(three_points());
  EXPECT_THAT(writing.losses, IsEmpty());
  EXPECT_EQ(content(read_kml(writing.bytes)), three_points());
}

TEST(WriteKmz, IsReadAsItWasAndAlwaysTheSame) {
  const auto writing = write_kmz(three_points());
  EXPECT_THAT(writing.losses, IsEmpty());
  EXPECT_EQ(content(read_kmz(writing.bytes)), three_points());
  EXPECT_EQ(write_kmz(three_points()).bytes, writing.bytes);
}

TEST(ReadKmz, RefusesWhatIsNoArchiveOfAKml) {
  EXPECT_THAT(refusal(read_kmz(bytes_of(std::string_view{"PK\x03\x04 and no more"}))),
              HasSubstr("a zip archive with a .kml file"));
  EXPECT_THAT(refusal(read_kmz({})), HasSubstr("a zip archive with a .kml file"));
  auto broken = write_kmz(three_points()).bytes;
  broken[60] ^= std::byte{0xFF};
  EXPECT_THAT(refusal(read_kmz(broken)), HasSubstr("doc.kml: "));
}

TEST(ReadKmz, TakesTheFirstKmlAndTellsOfTheRest) {
  const auto reading = read_kmz(vector_file("other_files.kmz"));
  EXPECT_THAT(remarks(reading), ElementsAre("the file: 2 other files of the archive beside sub/Doc.KML are not kept"));
  EXPECT_EQ(content(reading).points.size(), 1U);
}

TEST(ReadKmz, StopsUnpackingABomb) {
  EXPECT_THAT(refusal(read_kmz(vector_file("bomb.kmz"))), HasSubstr("doc.kml unpacks to more than 64 MiB"));
}

}  // namespace
}  // namespace ponte::planning
