#include "ponte/sim/mission_service.hpp"

#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_item.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/autopilots/mission_request_list.hpp"
#include "ponte/mavlink/autopilots/mission_write_partial_list.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Item = messages::MissionItemInt;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Item waypoint(std::uint16_t seq) {
  return {.target_system = 1,
          .target_component = 1,
          .seq = seq,
          .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
          .command = messages::MAV_CMD_NAV_WAYPOINT,
          .autocontinue = 1,
          .x = -300'699'000,
          .y = -511'209'600,
          .z = 40};
}

Item fence_corner(std::uint16_t seq) {
  auto item = waypoint(seq);
  item.command = messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION;
  item.param1 = 3;
  item.mission_type = 1;
  return item;
}

/// A vehicle with its position, and a station that transfers plans by hand.
class MissionServiceTest : public ::testing::TestWithParam<Personality> {
 protected:
  MissionServiceTest() { station_.wait(seconds{9}); }

  [[nodiscard]] bool is_px4() const { return GetParam() == Personality::px4; }

  void announce(std::uint16_t count, std::uint8_t type = 0) {
    station_.forget();
    station_.send(
        messages::MissionCount{.target_system = 1, .target_component = 1, .count = count, .mission_type = type});
  }

  std::vector<unsigned> acks() const {
    std::vector<unsigned> result;
    for (const auto& each : station_.all<messages::MissionAck>()) result.push_back(each.type);
    return result;
  }

  /// The items asked for, in whichever way.
  std::vector<unsigned> requests() const {
    std::vector<unsigned> result;
    for (const auto& each : station_.all<messages::MissionRequest>()) result.push_back(each.seq);
    for (const auto& each : station_.all<messages::MissionRequestInt>()) result.push_back(each.seq);
    return result;
  }

  /// Whether the whole plan was accepted.
  bool upload(std::span<const Item> items) {
    announce(static_cast<std::uint16_t>(items.size()), items[0].mission_type);
    for (const auto& each : items) station_.send(each);
    return acks() == std::vector<unsigned>{messages::MAV_MISSION_ACCEPTED};
  }

  std::uint16_t count(std::uint8_t type = 0) {
    station_.send(messages::MissionRequestList{.target_system = 1, .target_component = 1, .mission_type = type});
    return station_.last<messages::MissionCount>().count;
  }

  Item download(std::uint16_t seq, std::uint8_t type = 0) {
    station_.send(
        messages::MissionRequestInt{.target_system = 1, .target_component = 1, .seq = seq, .mission_type = type});
    return station_.last<Item>();
  }

  TestStation station_{{.personality = GetParam(), .fly_square = false}};
};

class ArduPilotMissions : public MissionServiceTest {};
class Px4Missions : public MissionServiceTest {};
INSTANTIATE_TEST_SUITE_P(, ArduPilotMissions, ::testing::Values(Personality::ardupilot));
INSTANTIATE_TEST_SUITE_P(, Px4Missions, ::testing::Values(Personality::px4));
INSTANTIATE_TEST_SUITE_P(Both, MissionServiceTest, ::testing::Values(Personality::ardupilot, Personality::px4));

TEST_P(MissionServiceTest, AsksForEachItemInItsOwnWay) {
  announce(3);
  station_.send(waypoint(0));
  station_.send(waypoint(1));
  EXPECT_THAT(station_.all<messages::MissionRequest>(), SizeIs(is_px4() ? 0 : 3));
  EXPECT_THAT(station_.all<messages::MissionRequestInt>(), SizeIs(is_px4() ? 3 : 0));
  EXPECT_THAT(acks(), IsEmpty());
  station_.send(waypoint(2));
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_ACCEPTED));
  EXPECT_EQ(count(), 3);
}

TEST_P(MissionServiceTest, KeepsFenceAndMissionApart) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
  ASSERT_TRUE(upload(std::array{fence_corner(0), fence_corner(1), fence_corner(2)}));
  EXPECT_EQ(count(0), 2);
  EXPECT_EQ(count(1), 3);
  EXPECT_EQ(count(2), 0);
  EXPECT_EQ(download(2, 1).command, fence_corner(2).command);
}

TEST_P(MissionServiceTest, ClearsOnePlanOrAll) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
  ASSERT_TRUE(upload(std::array{fence_corner(0), fence_corner(1), fence_corner(2)}));
  station_.send(messages::MissionClearAll{.target_system = 1, .target_component = 1, .mission_type = 0});
  EXPECT_EQ(count(0), 0);
  EXPECT_EQ(count(1), 3);
  station_.send(messages::MissionClearAll{.target_system = 1, .target_component = 1, .mission_type = 255});
  EXPECT_EQ(count(1), 0);
}

TEST_P(MissionServiceTest, TakesACountOfNothingForClearing) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
  announce(0);
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_ACCEPTED));
  EXPECT_EQ(count(), 0);
}

TEST_P(MissionServiceTest, HasOnlySoMuchRoom) {
  announce(5000);
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_NO_SPACE));
  station_.send(waypoint(0));
  EXPECT_THAT(acks(), Contains(messages::MAV_MISSION_ERROR)) << "nothing was begun";
}

TEST_P(MissionServiceTest, RefusesWhatItCannotFly) {
  const auto refusal_of = [&](Item item) {
    announce(2);
    item.seq = 0;
    station_.send(item);
    return acks();
  };
  auto item = waypoint(0);
  item.command = 30'999;
  EXPECT_THAT(refusal_of(item), ElementsAre(messages::MAV_MISSION_UNSUPPORTED));
  item = waypoint(0);
  item.x = 950'000'000;
  EXPECT_THAT(refusal_of(item), ElementsAre(messages::MAV_MISSION_INVALID_PARAM5_X));
  item = waypoint(0);
  item.y = -1'810'000'000;
  EXPECT_THAT(refusal_of(item), ElementsAre(messages::MAV_MISSION_INVALID_PARAM6_Y));
  item = waypoint(0);
  item.z = nan;
  EXPECT_THAT(refusal_of(item), ElementsAre(messages::MAV_MISSION_INVALID_PARAM7));
  item = waypoint(0);
  item.frame = 77;
  EXPECT_THAT(refusal_of(item), ElementsAre(messages::MAV_MISSION_UNSUPPORTED_FRAME));
}

TEST_P(MissionServiceTest, LetsTheSameStationBeginAnew) {
  announce(3);
  station_.send(waypoint(0));
  EXPECT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
}

TEST_P(MissionServiceTest, LetsNoSecondStationIn) {
  announce(3);
  station_.speak_as(mavlink::SystemId{254}, mavlink::ComponentId{190});
  announce(2);
  EXPECT_THAT(acks(), ElementsAre(is_px4() ? messages::MAV_MISSION_ERROR : messages::MAV_MISSION_DENIED));
}

TEST_P(ArduPilotMissions, PutHomeInTheFirstPlace) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
  const auto home = download(0);
  EXPECT_EQ(home.command, messages::MAV_CMD_NAV_WAYPOINT);
  EXPECT_EQ(home.frame, messages::MAV_FRAME_GLOBAL);
  EXPECT_NEAR(home.x, -300'689'800, 1);
  EXPECT_EQ(download(1).x, waypoint(1).x);
}

TEST_P(ArduPilotMissions, ComeBackRoundedAndInTheOldFrames) {
  auto item = waypoint(1);
  item.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT;
  item.current = 1;
  item.param1 = 3.7F;
  item.param2 = 5;
  item.param4 = nan;
  item.z = 40.129F;
  auto land = waypoint(2);
  land.command = messages::MAV_CMD_NAV_LAND;
  ASSERT_TRUE(upload(std::array{waypoint(0), item, land}));
  const auto stored = download(1);
  EXPECT_EQ(stored.frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT);
  EXPECT_EQ(stored.current, 0);
  EXPECT_EQ(stored.param1, 3);
  EXPECT_EQ(stored.param2, 0);
  EXPECT_EQ(stored.param4, 0);
  EXPECT_FLOAT_EQ(stored.z, 40.12F);
  EXPECT_EQ(download(2).param4, 1);
}

/// What the recorded ArduCopter made of -30.06898 and -51.12179.
TEST_P(ArduPilotMissions, MultiplyFloatsInSinglePrecision) {
  announce(2);
  const messages::MissionItem item{.target_system = 1,
                                   .target_component = 1,
                                   .seq = 0,
                                   .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
                                   .command = messages::MAV_CMD_NAV_WAYPOINT,
                                   .x = -30.06898F,
                                   .y = -51.12179F,
                                   .z = 40};
  auto second = item;
  second.seq = 1;
  station_.send(item);
  station_.send(second);
  ASSERT_THAT(acks(), ElementsAre(messages::MAV_MISSION_ACCEPTED));
  EXPECT_THAT(station_.texts(), Contains("got MISSION_ITEM; GCS should send MISSION_ITEM_INT"));
  EXPECT_EQ(download(1).x, -300'689'792);
  EXPECT_EQ(download(1).y, -511'217'920);
  station_.send(messages::MissionRequest{.target_system = 1, .target_component = 1, .seq = 0});
  EXPECT_THAT(station_.texts(), Contains("got MISSION_REQUEST; use MISSION_REQUEST_INT!"));
  EXPECT_FLOAT_EQ(station_.last<messages::MissionItem>().y, -51.121788F);
}

TEST_P(ArduPilotMissions, GoOnAfterAnItemOutOfOrder) {
  announce(2);
  station_.send(waypoint(1));
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_INVALID_SEQUENCE));
  station_.send(waypoint(0));
  station_.send(waypoint(1));
  EXPECT_THAT(acks(), Contains(messages::MAV_MISSION_ACCEPTED));
}

TEST_P(ArduPilotMissions, AskEverySecondAndGiveUpAfterEight) {
  announce(2);
  station_.wait(milliseconds{7900});
  EXPECT_THAT(requests(), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(acks(), IsEmpty());
  station_.wait(milliseconds{200});
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_OPERATION_CANCELLED));
  EXPECT_THAT(station_.texts(), Contains("Mission upload timeout"));
}

TEST_P(ArduPilotMissions, AreAMixtureAfterABrokenUpload) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1), waypoint(2)}));
  announce(2);
  auto moved = waypoint(0);
  station_.send(moved);
  moved.command = 30'999;
  moved.seq = 1;
  station_.send(moved);
  EXPECT_EQ(count(), 2);
}

TEST_P(ArduPilotMissions, AreOverwrittenInPart) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1), waypoint(2)}));
  station_.forget();
  station_.send(messages::MissionWritePartialList{.target_system = 1, .start_index = 2, .end_index = 2});
  EXPECT_THAT(requests(), ElementsAre(2));
  auto changed = waypoint(2);
  changed.z = 99;
  station_.send(changed);
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_ACCEPTED));
  EXPECT_EQ(download(2).z, 99);
  EXPECT_EQ(count(), 3);
  station_.forget();
  station_.send(messages::MissionWritePartialList{.target_system = 1, .start_index = 2, .end_index = 7});
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_ERROR));
}

TEST_P(ArduPilotMissions, RefuseARequestBeyondTheEnd) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
  station_.forget();
  station_.send(messages::MissionRequestInt{.target_system = 1, .target_component = 1, .seq = 99});
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_INVALID_SEQUENCE));
}

TEST_P(Px4Missions, KeepAllNumbersAndNameTheFrameOfIntegers) {
  auto item = waypoint(1);
  item.param1 = 3.7F;
  item.param4 = nan;
  ASSERT_TRUE(upload(std::array{waypoint(0), item}));
  const auto stored = download(1);
  EXPECT_EQ(stored.frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT);
  EXPECT_EQ(stored.param1, 3.7F);
  EXPECT_TRUE(std::isnan(stored.param4));
  EXPECT_EQ(download(0).current, 1);
  EXPECT_EQ(download(1).current, 0);
  station_.send(messages::MissionRequest{.target_system = 1, .target_component = 1, .seq = 1});
  EXPECT_EQ(station_.last<messages::MissionItem>().frame, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT);
}

TEST_P(Px4Missions, ChangeAtTheEndOfTheUploadOnly) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1), waypoint(2)}));
  const auto id = station_.last<messages::MissionAck>().opaque_id;
  EXPECT_NE(id, 0U);
  announce(2);
  station_.send(waypoint(0));
  station_.wait(seconds{6});
  EXPECT_EQ(count(), 3) << "the upload was given up";
  EXPECT_EQ(station_.last<messages::MissionCount>().opaque_id, id);
}

TEST_P(Px4Missions, AskFourTimesASecondAndGiveUpAfterFive) {
  announce(2);
  station_.wait(milliseconds{4990});
  EXPECT_THAT(requests(), SizeIs(::testing::AllOf(::testing::Ge(19U), ::testing::Le(21U))));
  station_.wait(milliseconds{100});
  EXPECT_THAT(station_.texts(), Contains("Operation timeout\t"));
  EXPECT_THAT(acks(), IsEmpty());
}

TEST_P(Px4Missions, AcknowledgeTheLastItemOnceMore) {
  ASSERT_TRUE(upload(std::array{waypoint(0), waypoint(1)}));
  station_.forget();
  station_.send(waypoint(1));
  EXPECT_THAT(acks(), ElementsAre(messages::MAV_MISSION_ACCEPTED));
  station_.send(waypoint(0));
  EXPECT_THAT(acks(), Contains(messages::MAV_MISSION_ERROR));
}

TEST_P(Px4Missions, PassOverAnItemOutOfOrder) {
  announce(2);
  station_.send(waypoint(1));
  EXPECT_THAT(acks(), IsEmpty());
  EXPECT_THAT(requests(), ElementsAre(0));
}

}  // namespace
}  // namespace ponte::sim
