#include "ponte/planning/formats/wpl.hpp"

#include "ponte/planning/formats/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using vehicle::Action;
using vehicle::AltitudeFrame;

std::vector<Action> actions(const ReadingResult& reading) {
  std::vector<Action> result;
  for (const auto& item : content(reading).mission.items) result.push_back(item.action);
  return result;
}

ReadingResult read(const std::string& lines) { return read_wpl(bytes_of("QGC WPL 110\n" + lines)); }

TEST(ReadWpl, AFileOfMissionPlanner) {
  const auto reading = read_wpl(vector_file("mission_planner.waypoints"));
  EXPECT_EQ(content(reading).mission.home, (vehicle::Home{place(-35.363261, 149.16523), Metres{584.08}}));
  EXPECT_THAT(
      actions(reading),
      ElementsAre(
          Action{vehicle::TakeOffItem{.altitude = {Metres{20}, AltitudeFrame::home}, .yaw = Radians{}}},
          Action{vehicle::WaypointItem{
              .place = place(-35.363005, 149.164329), .altitude = {Metres{20}, AltitudeFrame::home}, .yaw = Radians{}}},
          Action{vehicle::LoiterItem{.place = place(-35.362111, 149.165257),
                                     .altitude = {Metres{30}, AltitudeFrame::home},
                                     .lasts = vehicle::Turns{2},
                                     .radius = Metres{25}}},
          Action{vehicle::WaypointItem{.place = place(-35.362611, 149.166257),
                                       .altitude = {Metres{30}, AltitudeFrame::terrain},
                                       .dwell = vehicle::Seconds{5},
                                       .yaw = Radians{}}},
          Action{vehicle::JumpItem{.target = 1}}, Action{vehicle::OtherItem{201, 3, {0, 0, 0, 0, -35.363, 149.165, 0}}},
          Action{vehicle::ReturnItem{}}));
  EXPECT_THAT(remarks(reading), IsEmpty());
}

TEST(ReadWpl, AHomeThatIsNotSetIsNone) {
  const auto file = content(read_wpl(vector_file("home_not_set.waypoints")));
  EXPECT_EQ(file.mission.home, std::nullopt);
  EXPECT_EQ(file.mission.items.size(), 1U);
}

TEST(ReadWpl, Version120HasNoHome) {
  const auto reading = read_wpl(vector_file("qgroundcontrol_120.txt"));
  EXPECT_EQ(content(reading).mission.home, std::nullopt);
  ASSERT_EQ(actions(reading).size(), 2U);
  EXPECT_EQ(std::get<vehicle::LandItem>(actions(reading)[1]).yaw, std::nullopt);
}

TEST(ReadWpl, SpacesDecimalCommasAndGaps) {
  const auto reading = read_wpl(vector_file("decimal_commas.waypoints"));
  EXPECT_THAT(remarks(reading), ElementsAre("line 2: its numbers are written with decimal commas"));
  ASSERT_EQ(actions(reading).size(), 3U);
  EXPECT_EQ(std::get<vehicle::WaypointItem>(actions(reading)[1]).place, place(47.39775, 8.54565));
  EXPECT_EQ(actions(reading)[2], (Action{vehicle::JumpItem{.target = 1, .times = 3}}));
}

TEST(ReadWpl, ACommentNamesTheItemAfterIt) {
  const auto items = content(read("# the mast\n1 0 3 16 0 0 0 0 47 8 40 0\n2 0 3 20 0 0 0 0 0 0 0 1\n")).mission.items;
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].name, "the mast");
  EXPECT_TRUE(items[0].waits);
  EXPECT_EQ(items[1].name, "");
  EXPECT_FALSE(items[1].waits);
}

TEST(ReadWpl, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal(read_wpl(bytes_of(std::string_view{"QGC WPL 100\n"}))),
            "line 1: the first line is 'QGC WPL 100': expected QGC WPL 110, or 120");
  EXPECT_EQ(refusal(read("1\t0\t3\t16\t0\t0\t0\t0\t97\t8\t40\t1\n")),
            "line 2: latitude is 97: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(refusal(read("1\t0\t3\t16\t0\t0\t0\t0\t149.1\t-35.3\t40\t1\n")),
            "line 2: latitude is 149.1: expected -90 to 90; latitude and longitude look swapped");
  EXPECT_EQ(
      refusal(read("\n1\t0\t3\t16\t0\t0\t0\t47\t8\t40\t1\n")),
      "line 3: it has 11 fields: expected 12: index, current, frame, command, four parameters, latitude, longitude, "
      "altitude, autocontinue");
  EXPECT_EQ(refusal(read("1 0 3 16 0 0 0 0 47 8 high 1\n")), "line 2: altitude is 'high': expected a number");
  EXPECT_EQ(refusal(read("1 0 3 70000 0 0 0 0 47 8 4 1\n")),
            "line 2: command is 70000: expected an integer from 0 to 65535");
  EXPECT_EQ(refusal(read("1 0 3 16 0 0 0 0 47 8 4 2\n")), "line 2: autocontinue is 2: expected an integer from 0 to 1");
  EXPECT_EQ(refusal(read("1 0 3 16 0 0 0 0 47 8 4 1\n1 0 3 20 0 0 0 0 0 0 0 1\n")),
            "line 3: the item number 1 comes twice: expected each number once");
  EXPECT_EQ(refusal(read("1 0 3 177 5 1 0 0 0 0 0 1\n")),
            "line 2: it jumps to item 5, which there is not: expected the number of an item");
  EXPECT_EQ(refusal(read("1 0 3 177 1 -3 0 0 0 0 0 1\n")),
            "line 2: it jumps -3 times: expected a number of times up to 65535, or -1");
}

TEST(WriteWpl, AsMissionPlannerReadsIt) {
  MissionFile file;
  file.mission.home = vehicle::Home{place(-35.363261, 149.16523), Metres{584.08}};
  file.mission.items.push_back({.action = vehicle::TakeOffItem{.altitude = {Metres{20}, AltitudeFrame::home}}});
  file.mission.items.push_back({.action = vehicle::WaypointItem{.place = place(-35.363005, 149.164329),
                                                                .altitude = {Metres{20.5}, AltitudeFrame::home}},
                                .waits = true,
                                .name = "mast"});
  file.mission.items.push_back({.action = vehicle::JumpItem{.target = 1, .times = 2}});
  file.mission.rally_points.push_back({place(-35, 149), {Metres{30}, AltitudeFrame::home}});
  file.mission.cruise_speed = MetresPerSecond{15};
  const auto writing = write_wpl(file);
  ASSERT_TRUE(writing.has_value());
  EXPECT_EQ(text_of(*writing),
            "QGC WPL 110\n"
            "0\t1\t0\t16\t0\t0\t0\t0\t-35.363261\t149.16523\t584.08\t1\n"
            "1\t0\t3\t22\t0\t0\t0\tNaN\t0\t0\t20\t1\n"
            "2\t0\t3\t16\t0\t0\t0\tNaN\t-35.363005\t149.164329\t20.5\t0\n"
            "3\t0\t2\t177\t2\t2\t0\t0\t0\t0\t0\t1\n");
  EXPECT_THAT(writing->losses, ElementsAre("cruise speed", "name: item 2", "rally: point 1"));
}

TEST(WriteWpl, WhatIsAbsentInALocalFrameStaysAbsent) {
  const auto mission = content(read("1\t0\t1\t16\t0\t0\t0\t0\t40\tNaN\t-20\t1\n")).mission;
  const auto writing = write_wpl({.mission = mission});
  ASSERT_TRUE(writing.has_value());
  EXPECT_THAT(text_of(*writing), testing::HasSubstr("1\t0\t1\t16\t0\t0\t0\t0\t40\tNaN\t-20\t1\n"));
}

TEST(WriteWpl, APointNeedsAnAltitude) {
  MissionFile file;
  file.points.push_back({.place = place(47, 8), .priority = 3, .where = at_line(7)});
  const auto refused = write_wpl(file);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error(),
            (FormatError{at_line(7), "point 1 has no altitude", "one for each waypoint of a mission (--altitude)"}));
  file.points[0].altitude = vehicle::Altitude{Metres{40}, AltitudeFrame::home};
  const auto writing = write_wpl(file);
  ASSERT_TRUE(writing.has_value());
  EXPECT_THAT(writing->losses, ElementsAre("priority: point 1"));
}

}  // namespace
}  // namespace ponte::planning
