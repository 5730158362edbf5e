#include "ponte/planning/formats/format.hpp"

#include "ponte/planning/formats/test_files.hpp"

#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

std::string detected(std::string_view text, std::string_view name) {
  const auto format = detect_format(bytes_of(text), name);
  return format ? std::string{name_of(*format)} : to_text(format.error().where) + ": " + format.error().what;
}

TEST(DetectFormat, KnowsEveryFileByItsContentWhateverItsName) {
  const std::pair<const char*, Format> files[]{{"path_2016.poi", Format::poi},
                                               {"survey.plan", Format::plan},
                                               {"mission_planner.waypoints", Format::wpl},
                                               {"home_not_set.waypoints", Format::wpl},
                                               {"qgroundcontrol_120.txt", Format::wpl},
                                               {"decimal_commas.waypoints", Format::wpl},
                                               {"spreadsheet.csv", Format::csv},
                                               {"google_earth.kml", Format::kml},
                                               {"handheld.gpx", Format::gpx},
                                               {"drawn.geojson", Format::geojson},
                                               {"other_files.kmz", Format::kmz}};
  for (const auto& [name, format] : files)
    for (const auto* told : {"", "a.kml", "b.csv", "c.poi"})
      EXPECT_EQ(detect_format(vector_file(name), told), format) << name;
}

TEST(DetectFormat, TheNameDecidesOnlyWhatIsOpen) {
  EXPECT_EQ(detected("a,b\n1,2\n", "x.csv"), "csv");
  EXPECT_EQ(detected("{\"fileType\": \"Plan\", \"coordinates\": []}", "x.geojson"), "geojson");
}

TEST(DetectFormat, SaysWhatIsAmbiguous) {
  const std::string open = "line 1: neither the text nor the name of the file tells its format";
  EXPECT_EQ(detected("{\"fileType\": \"Plan\", \"coordinates\": []}", "x"), open);
  EXPECT_EQ(detected("hello\n", "x.txt"), open);
  EXPECT_EQ(detected("<html/>", ""), open);
  EXPECT_EQ(detected("", "x.csv"), "the file: it is empty");
}

TEST(FormatOfName, IgnoresCase) {
  EXPECT_EQ(format_of_name("/A/B.WAYPOINTS"), Format::wpl);
  EXPECT_EQ(format_of_name("route.kml"), Format::kml);
  EXPECT_EQ(format_of_name("route.txt"), std::nullopt);
  for (const auto format : formats) EXPECT_EQ(format_named(name_of(format)), format);
}

}  // namespace
}  // namespace ponte::planning
