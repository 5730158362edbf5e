#include "ponte/planning/formats/csv.hpp"

#include "ponte/planning/formats/csv_rows.hpp"
#include "ponte/planning/formats/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ReadingResult read(std::string_view text, const ReadOptions& options = {}) { return read_csv(bytes_of(text), options); }

TEST(SplitCsv, KnowsQuotesAndLines) {
  const auto rows = split_csv("a,\"b,\"\"c\"\"\nd\",e\r\n\r\n , \n\"f\",,g", ',');
  ASSERT_TRUE(rows.has_value());
  ASSERT_EQ(rows->size(), 2U);
  EXPECT_THAT((*rows)[0].cells, ElementsAre("a", "b,\"c\"\nd", "e"));
  EXPECT_THAT((*rows)[1].cells, ElementsAre("f", "", "g"));
  EXPECT_EQ((*rows)[1].line, 5U);
}

TEST(ReadCsv, FindsColumnsByManyNames) {
  for (const auto* text : {"latitude,longitude\n47.5,8.5\n", "LON,LAT\n8.5,47.5\n", "id\tlng\tlat\n1\t8.5\t47.5",
                           "Latitude (deg);Longitude [deg]\r\n47,5;8,5\r\n", "\xEF\xBB\xBFy,x\n47.5,8.5"}) {
    const auto points = content(read(text)).points;
    ASSERT_EQ(points.size(), 1U) << text;
    EXPECT_EQ(points[0].place, place(47.5, 8.5)) << text;
    EXPECT_EQ(points[0].where, at_line(2)) << text;
  }
}

TEST(ReadCsv, ASpreadsheet) {
  const auto reading = read_csv(vector_file("spreadsheet.csv"));
  const PointOfInterest church{.place = place(47.39775, 8.54565),
                               .altitude = vehicle::Altitude{Metres{55.5}, vehicle::AltitudeFrame::terrain},
                               .dwell = vehicle::Seconds{2.5},
                               .priority = 3,
                               .sensor_quality = 0.8,
                               .name = "Kirche; Süd"};
  const PointOfInterest bridge{.place = place(47.3981, 8.5461), .name = "Brücke"};
  EXPECT_THAT(content(reading).points, ElementsAre(church, bridge));
  EXPECT_THAT(remarks(reading), ElementsAre("line 1: the column 'colour' is not kept"));
}

TEST(ReadCsv, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal(read("47.5,8.5\n47.6,8.6\n")),
            "line 1: the first line names no latitude and longitude: expected a header such as "
            "latitude,longitude,altitude");
  EXPECT_EQ(refusal(read("")),
            "line 1: the first line names no latitude and longitude: expected a header such as "
            "latitude,longitude,altitude");
  EXPECT_EQ(refusal(read("lat,lon\n")), "line 1: there is nothing but the header: expected a row for each point");
  EXPECT_EQ(refusal(read("lat,lon\n47.5,8.5\n91,8\n")),
            "line 3: latitude is 91: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal(read("lat,lon\n-122.4,37.8\n")),
            "line 2: latitude is -122.4: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal(read("lat,lon\n47.5,180.5\n")), "line 2: longitude is 180.5: expected -180 to 180");
  EXPECT_EQ(refusal(read("lat,lon\n47°30',8.5\n")), "line 2: latitude is '47°30'': expected decimal degrees");
  EXPECT_EQ(refusal(read("lat,lon\nnan,8.5\n")), "line 2: latitude is 'nan': expected decimal degrees");
  EXPECT_EQ(refusal(read("lat,lon\n47.5\n")), "line 2: latitude or longitude is missing: expected decimal degrees");
  EXPECT_EQ(refusal(read("lat,lon\n47,5,8,5\n")),
            "line 2: it has 4 cells, the header 2: expected as many as the header; with decimal commas, semicolons "
            "between the cells");
  EXPECT_EQ(refusal(read("lat;lon\n47,5;8.5\n")),
            "line 2: '8.5' has another decimal mark than the numbers before it: expected the same mark in all numbers");
  EXPECT_EQ(refusal(read("lat,lon,LAT\n1,2,3\n")),
            "line 1: the column latitude comes twice: expected each column once");
  EXPECT_EQ(refusal(read("lat,lon,name\n1,2,\"a\n3,4,b\n")), "line 2: a quote is not closed: expected a closing quote");
  EXPECT_EQ(refusal(read("lat,lon,dwell_s\n1,2,-3\n")), "line 2: dwell_s is '-3': expected a number of at least 0");
  EXPECT_EQ(refusal(read("lat,lon,sensor_quality\n1,2,1.5\n")),
            "line 2: sensor_quality is '1.5': expected a number from 0 to 1");
  EXPECT_EQ(refusal(read("lat,lon,name\n1,2,Z\xFCrich\n")),
            "line 2: the byte 0xfc begins no character: expected text in UTF-8");
  EXPECT_EQ(refusal(read("lat,lon,name\n1,2,a\x01\n")),
            "line 2: the name holds the control character 1: expected text");
}

TEST(ReadCsv, AnAltitudeMustCountFromSomewhere) {
  const auto* text = "lat,lon,alt\n47.5,8.5,40\n";
  EXPECT_EQ(
      refusal(read(text)),
      "line 2: the altitude 40 counts from no one knows where: expected altitude_above to be msl, home or terrain "
      "(or --altitude-above)");
  const auto points = content(read(text, {.poi_layout = {}, .altitude_above = vehicle::AltitudeFrame::home})).points;
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].altitude, (vehicle::Altitude{Metres{40}, vehicle::AltitudeFrame::home}));
}

TEST(ReadCsv, DoubtsPlacesThatHardlyAreMeant) {
  EXPECT_THAT(remarks(read("lat,lon\n47.397,8.545\n47.398,8.546\n8.547,47.399\n47.397,8.545\n0,0\n40,100\n47.4,8.5\n")),
              ElementsAre("line 4: 8.547, 47.399 looks swapped: the other way round it lies near the middle of all, "
                          "47.397, 8.545",
                          "line 5: 47.397, 8.545 is the place of line 2 again",
                          "line 6: 0, 0 lies in the Atlantic; is a place missing?",
                          "line 7: 40, 100 lies far from the middle of all, 47.397, 8.545"));
  EXPECT_THAT(remarks(read("lat,lon\n-17,179.99\n-17,-179.99\n-17.01,179.98\n")), IsEmpty());
}

TEST(WriteCsv, QuotesWhatNeedsIt) {
  MissionFile file;
  file.points.push_back(
      {.place = place(47.5, 1e-7), .altitude = vehicle::Altitude{Metres{40.5}}, .name = "a \"b\", c"});
  const auto writing = write_csv(file);
  EXPECT_EQ(text_of(writing),
            "name,latitude,longitude,altitude,altitude_above,dwell_s,priority,sensor_quality\n"
            "\"a \"\"b\"\", c\",47.5,0.0000001,40.5,msl,,,\n");
  EXPECT_THAT(writing.losses, IsEmpty());
}

}  // namespace
}  // namespace ponte::planning
