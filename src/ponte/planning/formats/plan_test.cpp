#include "ponte/planning/formats/plan.hpp"

#include "ponte/planning/formats/test_files.hpp"
#include "ponte/planning/formats/wpl.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using vehicle::Action;
using vehicle::AltitudeFrame;

/// A plan with these items, which begin in line 3.
ReadingResult read_items(const std::string& items) {
  return read_plan(bytes_of("{\"fileType\": \"Plan\", \"version\": 1,\n\"mission\": {\"version\": 2, \"items\": [\n" +
                            items + "]}}"));
}

std::string simple_item(const std::string& command, const std::string& params, const std::string& more = {}) {
  return "{\"type\": \"SimpleItem\", \"autoContinue\": true, \"command\": " + command +
         ", \"frame\": 3, \"params\": [" + params + "]" + more + "}";
}

TEST(ReadPlan, ASurveyOfQGroundControl) {
  const auto reading = read_plan(vector_file("survey.plan"));
  const auto mission = content(reading).mission;
  EXPECT_EQ(mission.home, (vehicle::Home{place(47.3977419, 8.545594), Metres{487.989}}));
  EXPECT_EQ(mission.cruise_speed, MetresPerSecond{15});
  EXPECT_EQ(mission.hover_speed, MetresPerSecond{5});
  EXPECT_EQ(mission.autopilot, 12);
  EXPECT_EQ(mission.airframe, 2);
  ASSERT_EQ(mission.items.size(), 10U);
  EXPECT_EQ(mission.items[0].action, (Action{vehicle::TakeOffItem{.place = place(47.3977419, 8.545594),
                                                                  .altitude = {Metres{40}, AltitudeFrame::home}}}));
  EXPECT_EQ(mission.items[3].action, (Action{vehicle::CameraDistanceItem{Metres{25}, true}}));
  EXPECT_TRUE(mission.items[6].waits);
  EXPECT_EQ(mission.items[7].action, (Action{vehicle::JumpItem{.target = 6, .times = 2}}));
  EXPECT_TRUE(std::holds_alternative<vehicle::OtherItem>(mission.items[8].action));
  ASSERT_EQ(mission.patterns.size(), 1U);
  EXPECT_EQ(mission.patterns[0].kind, "survey");
  EXPECT_EQ(mission.patterns[0].first, 2U);
  EXPECT_EQ(mission.patterns[0].count, 4U);
  EXPECT_THAT(mission.fence_circles, ElementsAre(vehicle::FenceCircle{place(47.3977, 8.5456), Metres{450.5}, true}));
  ASSERT_EQ(mission.fence_polygons.size(), 1U);
  EXPECT_FALSE(mission.fence_polygons[0].inclusion);
  EXPECT_THAT(mission.rally_points,
              ElementsAre(vehicle::RallyPoint{place(47.3972, 8.5455), {Metres{30}, AltitudeFrame::home}}));
  EXPECT_THAT(remarks(reading), IsEmpty());
}

TEST(WritePlan, KeepsASurveyWordForWord) {
  const auto file = content(read_plan(vector_file("survey.plan")));
  const auto writing = write_plan(file);
  ASSERT_TRUE(writing.has_value());
  EXPECT_THAT(writing->losses, IsEmpty());
  EXPECT_THAT(text_of(*writing), HasSubstr(file.mission.patterns[0].text));
  EXPECT_EQ(content(read_plan(writing->bytes)), file);
}

TEST(WritePlan, ASurveyAsItsItemsElsewhere) {
  auto file = content(read_plan(vector_file("survey.plan")));
  const auto writing = write_wpl(file);
  ASSERT_TRUE(writing.has_value());
  EXPECT_EQ(content(read_wpl(writing->bytes)).mission.items, file.mission.items);
  EXPECT_THAT(writing->losses,
              ElementsAre("that items 3 to 6 are a pattern survey", "cruise speed", "hover speed",
                          "kind of autopilot and airframe", "fence: circle 1", "fence: polygon 1", "rally: point 1"));
}

TEST(ReadPlan, APatternThatDoesNotTellItsItemsIsKept) {
  const auto reading = read_items(
      "{\"type\": \"ComplexItem\", \"complexItemType\": \"fwLandingPattern\", \"altitudesAreRelative\": true}");
  const auto file = content(reading);
  ASSERT_EQ(file.mission.patterns.size(), 1U);
  EXPECT_EQ(file.mission.patterns[0].count, 0U);
  EXPECT_EQ(content(read_plan(write_plan(file)->bytes)), file);
  EXPECT_THAT(write_wpl(file)->losses,
              ElementsAre("the whole pattern fwLandingPattern, whose file does not tell what items it makes"));
}

TEST(ReadPlan, TellsWhatItDoesNotKeep) {
  const auto reading = read_items(simple_item("16", "0,0,0,0,47,8,40", ",\n\"AltitudeMode\": 3, \"colour\": \"red\""));
  EXPECT_THAT(remarks(reading), ElementsAre("line 4: 'colour' is not kept",
                                            "line 4: that the altitude was calculated from terrain is not kept"));
}

TEST(ReadPlan, SaysWhatIsWrongAndWhere) {
  const auto refusal_of = [](const std::string& items) { return refusal(read_items(items)); };
  EXPECT_EQ(refusal_of(simple_item("16", "0,0,0,0,97,8,40")),
            "line 3: latitude is 97: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal_of(simple_item("16", "0,0,0,0")), "line 3: params has 4 numbers: expected 7");
  EXPECT_EQ(refusal_of(simple_item("16", "0,0,0,\n\"0\",47,8,40")), "line 4: a parameter is '0': expected a number");
  EXPECT_EQ(refusal_of(simple_item("16.5", "0,0,0,0,47,8,40")),
            "line 3: command is 16.5: expected an integer from 0 to 65535");
  EXPECT_EQ(refusal_of(simple_item("177", "9,1,0,0,0,0,0")),
            "line 3: it jumps to item 9, which there is not: expected the number of an item");
  EXPECT_EQ(refusal_of("{\"type\": \"Item\"}"), "line 3: type is 'Item': expected \"SimpleItem\" or \"ComplexItem\"");
  EXPECT_EQ(refusal_of("7"), "line 3: it is 7: expected an object with 'type'");
  EXPECT_EQ(refusal(read_plan(bytes_of(std::string_view{"{\"fileType\": \"Plan\", \"version\": 2}"}))),
            "line 1: the version of the plan is 2: expected 1");
  EXPECT_EQ(refusal(read_plan(bytes_of(std::string_view{"{\"fileType\": \"Rally\"}"}))),
            "line 1: fileType is 'Rally': expected \"Plan\"");
  EXPECT_EQ(refusal(read_plan(bytes_of(std::string_view{"{\"fileType\": \"Plan\",\n\"version\": 1}"}))),
            "line 1: 'mission' is missing: expected an object that has it");
  EXPECT_THAT(refusal(read_plan(bytes_of(std::string_view{"{\"fileType\": \"Plan\",\n\"version\": 1e999}"}))),
              HasSubstr("line 2: "));
}

TEST(WritePlan, APlanOfPoints) {
  MissionFile file;
  file.points.push_back({.place = place(47.5, 8.5),
                         .altitude = vehicle::Altitude{Metres{40}, AltitudeFrame::home},
                         .dwell = vehicle::Seconds{3},
                         .name = "mast"});
  const auto writing = write_plan(file);
  ASSERT_TRUE(writing.has_value());
  EXPECT_THAT(writing->losses, ElementsAre("name: item 1"));
  EXPECT_THAT(text_of(*writing), HasSubstr("\"plannedHomePosition\": [null, null, null]"));
  EXPECT_THAT(
      text_of(*writing),
      HasSubstr("{\"type\": \"SimpleItem\", \"AMSLAltAboveTerrain\": null, \"Altitude\": 40, \"AltitudeMode\": 1, "
                "\"autoContinue\": true, \"command\": 16, \"doJumpId\": 1, \"frame\": 3, \"params\": [3, 0, 0, null, "
                "47.5, 8.5, 40]}"));
}

}  // namespace
}  // namespace ponte::planning
