#include "ponte/planning/formats/gpx.hpp"

#include "ponte/planning/formats/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

using testing::ElementsAre;

ReadingResult read(const std::string& inside, const ReadOptions& options = {}) {
  return read_gpx(bytes_of("<gpx xmlns=\"http://www.topografix.com/GPX/1/1\">\n" + inside + "</gpx>"), options);
}

TEST(ReadGpx, AHandheldReceiver) {
  const auto reading = read_gpx(vector_file("handheld.gpx"));
  const PointOfInterest first{.place = place(-30.06898, -51.12179),
                              .altitude = vehicle::Altitude{Metres{52.4}, vehicle::AltitudeFrame::msl},
                              .name = "001"};
  const PointOfInterest second{.place = place(-30.06990, -51.12096), .name = "002"};
  EXPECT_THAT(content(reading).points, ElementsAre(first, second));
  EXPECT_THAT(remarks(reading),
              ElementsAre("line 6: <time> of points is not kept", "line 8: <sym> of points is not kept",
                          "line 5: elevations are taken as above mean sea level, since GPX does not tell",
                          "line 11: the line of 2 points is not kept, since the file has points beside it"));
}

TEST(ReadGpx, PrefersWaypointsThenTheRouteThenTheTrack) {
  const std::string route = "<rte><rtept lat='1' lon='2'/></rte>\n";
  const std::string track =
      "<trk><trkseg><trkpt lat='3' lon='4'/></trkseg><trkseg><trkpt lat='5' lon='6'/></trkseg></trk>\n";
  EXPECT_EQ(content(read(track)).points.size(), 2U);
  const auto both = read(track + route);
  ASSERT_EQ(content(both).points.size(), 1U);
  EXPECT_EQ(content(both).points[0].place, place(1, 2));
  EXPECT_THAT(remarks(both), ElementsAre("line 2: a track is not kept, since the file has a route"));
}

TEST(ReadGpx, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal(read("\n<wpt lat='90.5' lon='3'/>")),
            "line 3: latitude is 90.5: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal(read("<wpt lat='47,5' lon='3'/>")), "line 2: lat is '47,5': expected decimal degrees");
  EXPECT_EQ(refusal(read("<wpt lat='47.5'/>")), "line 2: lon is missing: expected decimal degrees");
  EXPECT_EQ(refusal(read("<wpt lat='47.5' lon='3'><ele>high</ele></wpt>")),
            "line 2: altitude is 'high': expected metres");
  EXPECT_EQ(refusal(read("<rte/>")), "line 2: <rte> has no <rtept>: expected some");
  EXPECT_EQ(refusal(read("<trk><trkseg><trkpt lat='3' lon='4'/></trkseg></trk>\n<trk><trkseg><trkpt lat='3' lon='4'/>"
                         "</trkseg></trk>")),
            "line 3: this is one of 2 lines, and there are no points: expected points, or one line");
  EXPECT_EQ(refusal(read("")), "the file: there is no point in it: expected points, a line, or areas that are fences");
}

TEST(WriteGpx, SaysNameAndElevationAndTellsTheRest) {
  MissionFile file;
  file.points.push_back({.place = place(47.5, 8.5),
                         .altitude = vehicle::Altitude{Metres{500}},
                         .dwell = vehicle::Seconds{3},
                         .name = "a&b"});
  file.points.push_back(
      {.place = place(47.6, 8.6), .altitude = vehicle::Altitude{Metres{4}, vehicle::AltitudeFrame::home}});
  const auto writing = write_gpx(file);
  EXPECT_EQ(text_of(writing),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<gpx version=\"1.1\" creator=\"ponte\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n"
            " <wpt lat=\"47.5\" lon=\"8.5\">\n  <ele>500</ele>\n  <name>a&amp;b</name>\n </wpt>\n"
            " <wpt lat=\"47.6\" lon=\"8.6\" />\n"
            "</gpx>\n");
  EXPECT_THAT(writing.losses, ElementsAre("altitude that is not above mean sea level: point 2", "dwell: point 1"));
}

}  // namespace
}  // namespace ponte::planning
