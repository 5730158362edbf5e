// What programs write although nobody expects it, where no other test of the format has it.

#include "ponte/planning/formats/csv.hpp"
#include "ponte/planning/formats/geojson.hpp"
#include "ponte/planning/formats/kml.hpp"
#include "ponte/planning/formats/plan.hpp"
#include "ponte/planning/formats/test_files.hpp"
#include "ponte/planning/formats/wpl.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Without the zero that ends a literal.
Bytes bytes_in(std::string_view text) { return bytes_of(std::span{text.data(), text.size()}); }

// Files from before RFC 7946 name a coordinate system.
TEST(Quirks, AGeoJsonThatNamesItsCoordinateSystemIsReadWithARemark) {
  const auto reading = read_geojson(
      bytes_in("{\"type\":\"Point\",\"bbox\":[8,47,9,48],\n\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"x\"}},"
               "\"coordinates\":[8.5,47.5]}"),
      {});
  EXPECT_THAT(content(reading).points, ElementsAre(PointOfInterest{.place = place(47.5, 8.5)}));
  EXPECT_THAT(remarks(reading), ElementsAre(HasSubstr("line 2: 'crs' is not looked at")));
}

TEST(Quirks, APlaceOnTheOtherSideOfTheAntimeridianIsNear) {
  const auto reading =
      read_geojson(bytes_in("{\"type\":\"MultiPoint\",\"coordinates\":[[179.999,-17],[-179.999,-17]]}"), {});
  EXPECT_EQ(content(reading).points.size(), 2U);
  EXPECT_THAT(remarks(reading), IsEmpty());
}

TEST(Quirks, ATrackOfGoogleEarthIsToldOf) {
  const auto reading = read_kml(
      bytes_in("<kml xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n"
               "<Placemark><Point><coordinates>8.5,47.5</coordinates></Point></Placemark>\n"
               "<Placemark><gx:Track><gx:coord>8.5 47.5 0</gx:coord></gx:Track></Placemark></kml>"));
  EXPECT_EQ(content(reading).points.size(), 1U);
  EXPECT_THAT(remarks(reading), ElementsAre(HasSubstr("line 3: <gx:Track> is not kept")));
}

// A position without an altitude, as importers crashed on.
TEST(Quirks, AnAbsoluteKmlAltitudeThatIsMissingIsZero) {
  const auto reading = read_kml(
      bytes_in("<kml><Placemark><Point><altitudeMode>absolute</altitudeMode><coordinates>8.5,47.5</coordinates>"
               "</Point></Placemark></kml>"));
  EXPECT_EQ(content(reading).points.at(0).altitude, (vehicle::Altitude{Metres{0}, vehicle::AltitudeFrame::msl}));
}

TEST(Quirks, APolygonIsAnAreaWhereAnAreaIsAskedFor) {
  const ReadOptions asks{.bare_polygons_are_inclusions = true};
  const auto map_page = content(
      read_geojson(bytes_in("{\"type\":\"Polygon\",\"coordinates\":[[[8,47],[8.1,47],[8.1,47.1],[8,47]]]}"), asks));
  ASSERT_EQ(map_page.mission.fence_polygons.size(), 1U);
  EXPECT_TRUE(map_page.mission.fence_polygons[0].inclusion);
  const auto google_earth = content(
      read_kml(bytes_in("<kml><Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>8,47 8.1,47 8.1,47.1 8,47"
                        "</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></kml>"),
               asks));
  EXPECT_EQ(google_earth.mission.fence_polygons, map_page.mission.fence_polygons);
}

// Home is no item of a .plan and item 0 of a .waypoints; a detour through either leaves one of it.
TEST(Quirks, HomeIsNotDoubledOnTheWayThroughBothMissionFormats) {
  const auto file = content(read_wpl(vector_file("mission_planner.waypoints")));
  const auto plan = write_plan(file);
  ASSERT_TRUE(plan.has_value());
  const auto back = content(read_plan(plan->bytes));
  EXPECT_EQ(back.mission.items.size(), file.mission.items.size());
  const auto again = write_wpl(back);
  ASSERT_TRUE(again.has_value());
  const auto lines = std::ranges::count(text_of(*again), '\n');
  EXPECT_EQ(static_cast<std::size_t>(lines), 2 + file.mission.items.size());  // the first line, and home
}

// A kind of complex item that did not exist when this was written.
TEST(Quirks, AComplexItemOfTheFutureIsKeptAsItIs) {
  const std::string plan =
      "{\"fileType\":\"Plan\",\"version\":1,\"groundStation\":\"x\",\"mission\":{\"version\":2,\"firmwareType\":12,"
      "\"vehicleType\":2,\"cruiseSpeed\":15,\"hoverSpeed\":5,\"plannedHomePosition\":[47.3,8.5,400],\"items\":[\n"
      "{\"type\":\"ComplexItem\",\"complexItemType\":\"spiral2030\",\"version\":9,\"turns\":4}]},\n"
      "\"geoFence\":{\"version\":2,\"circles\":[],\"polygons\":[]},\"rallyPoints\":{\"version\":2,\"points\":[]}}";
  const auto reading = read_plan(bytes_in(plan));
  ASSERT_EQ(content(reading).mission.patterns.size(), 1U);
  EXPECT_EQ(content(reading).mission.patterns[0].kind, "spiral2030");
  const auto writing = write_plan(content(reading));
  ASSERT_TRUE(writing.has_value());
  EXPECT_THAT(text_of(*writing), HasSubstr("spiral2030"));
}

// The MAVLink guide's own example has a place near Zurich with latitude and longitude the other way round.
TEST(Quirks, OneSwappedPlaceAmongOthersIsDoubted) {
  const auto reading =
      read_wpl(bytes_in("QGC WPL 110\n"
                        "0\t1\t0\t16\t0\t0\t0\t0\t47.376\t8.548\t400\t1\n"
                        "1\t0\t3\t16\t0\t0\t0\t0\t47.3761\t8.5481\t50\t1\n"
                        "2\t0\t3\t16\t0\t0\t0\t0\t8.548\t47.376\t50\t1\n"
                        "3\t0\t3\t16\t0\t0\t0\t0\t47.3763\t8.5483\t50\t1\n"));
  EXPECT_THAT(remarks(reading), ElementsAre(HasSubstr("line 4: 8.548, 47.376 looks swapped")));
}

TEST(Quirks, DegreesMinutesAndSecondsAreRefusedByLineAndValue) {
  EXPECT_THAT(refusal(read_csv(bytes_in("lat,lon\n47.5,8.5\n47 23 45N,8.5\n"), {})), HasSubstr("line 3: latitude is"));
}

}  // namespace
}  // namespace ponte::planning
