#include "ponte/planning/formats/format.hpp"
#include "ponte/planning/formats/poi.hpp"
#include "ponte/planning/formats/random_missions.hpp"
#include "ponte/planning/formats/test_files.hpp"
#include "support/seed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// What a format can say comes back from it as it was.
namespace ponte::planning {
namespace {

using testing::IsEmpty;

constexpr int rounds = 500;

void expect_same_again(Format format, const MissionFile& file) {
  const auto writing = write_mission_file(format, file);
  ASSERT_TRUE(writing.has_value()) << name_of(format);
  EXPECT_THAT(writing->losses, IsEmpty()) << name_of(format);
  EXPECT_EQ(detect_format(writing->bytes, ""), format) << text_of(*writing);
  const auto again = read_mission_file(format, writing->bytes);
  ASSERT_EQ(refusal(again), "read") << text_of(*writing);
  ASSERT_TRUE(again->content == file) << text_of(*writing);
}

TEST(RoundTripSeeded, PointsThroughEveryFormatThatSaysAllOfThem) {
  const auto seed = chosen_seed();
  SCOPED_TRACE(testing::Message() << "PONTE_SEED=" << seed);
  RandomMissions random{seed};
  for (int i = 0; i < rounds; ++i) {
    const auto file = random.points();
    for (const auto format : {Format::geojson, Format::kml, Format::kmz}) expect_same_again(format, file);
    auto without_fences = file;
    without_fences.mission = {};
    expect_same_again(Format::csv, without_fences);
    if (HasFatalFailure()) return;
  }
}

TEST(RoundTripSeeded, PointsThroughGpxAndPoiWithWhatTheySay) {
  const auto seed = chosen_seed();
  SCOPED_TRACE(testing::Message() << "PONTE_SEED=" << seed);
  RandomMissions random{seed};
  for (int i = 0; i < rounds; ++i) {
    auto file = random.points();
    file.mission = {};
    for (auto& point : file.points) {
      if (point.altitude && point.altitude->above != vehicle::AltitudeFrame::msl) point.altitude.reset();
      point = {.place = point.place, .altitude = point.altitude, .name = point.name};
    }
    expect_same_again(Format::gpx, file);
    for (auto& point : file.points) point = {.place = point.place};
    const auto writing = write_mission_file(Format::poi, file);
    EXPECT_THAT(writing->losses, IsEmpty());
    EXPECT_TRUE(content(read_poi(writing->bytes, {.poi_layout = PoiLayout::f64_le, .altitude_above = {}})) == file);
    if (HasFatalFailure()) return;
  }
}

TEST(RoundTripSeeded, MissionsThroughPlanAndWpl) {
  const auto seed = chosen_seed();
  SCOPED_TRACE(testing::Message() << "PONTE_SEED=" << seed);
  RandomMissions random{seed};
  for (int i = 0; i < rounds; ++i) {
    expect_same_again(Format::plan, random.mission_with_zones());
    expect_same_again(Format::wpl, random.mission());
    if (HasFatalFailure()) return;
  }
}

TEST(RoundTripSeeded, WhatWasReadOnceIsWrittenTheSameForEver) {
  const auto seed = chosen_seed();
  SCOPED_TRACE(testing::Message() << "PONTE_SEED=" << seed);
  RandomMissions random{seed};
  int written = 0;
  for (int i = 0; i < rounds; ++i) {
    for (const auto& file : {random.points(), random.mission_with_zones()}) {
      for (const auto format : formats) {
        const auto first = write_mission_file(format, file);
        if (!first) continue;  // a point without an altitude has no place in a mission
        const auto reading = read_mission_file(format, first->bytes);
        if (!reading) continue;  // no item was a point
        ++written;
        const auto second = write_mission_file(format, reading->content);
        ASSERT_TRUE(second.has_value()) << name_of(format);
        EXPECT_THAT(second->losses, IsEmpty()) << name_of(format);
        ASSERT_EQ(second->bytes, first->bytes) << name_of(format);
      }
    }
  }
  EXPECT_GT(written, rounds * 8);
}

}  // namespace
}  // namespace ponte::planning
