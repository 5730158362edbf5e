#include "ponte/autopilot/mission_copy.hpp"

#include "ponte/autopilot/test_frames.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_item.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace ponte::autopilot {
namespace {

using namespace mavlink::autopilots;
using mavlink::Version;
using testing::StationFrame;
using testing::TestFrame;
using vehicle::Waypoint;

constexpr std::uint16_t waypoint = MAV_CMD_NAV_WAYPOINT, take_off = MAV_CMD_NAV_TAKEOFF, jump = MAV_CMD_DO_JUMP,
                        go_home = MAV_CMD_NAV_RETURN_TO_LAUNCH, land = MAV_CMD_NAV_LAND,
                        change_speed = MAV_CMD_DO_CHANGE_SPEED;
constexpr std::uint8_t global = MAV_FRAME_GLOBAL, above_home = MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
                       above_terrain = MAV_FRAME_GLOBAL_TERRAIN_ALT_INT, local = MAV_FRAME_LOCAL_NED;
constexpr std::uint8_t fence = MAV_MISSION_TYPE_FENCE, all_types = MAV_MISSION_TYPE_ALL;

/// Item whose latitude in degrees is ten more than its number, so that every one is somewhere else.
MissionItemInt item(std::uint16_t number, std::uint16_t command = waypoint, std::uint8_t frame = above_home,
                    float z = 40) {
  return {.seq = number, .frame = frame, .command = command, .x = (number + 10) * 10'000'000, .y = 20'000'000, .z = z};
}
MissionItemInt without_place(MissionItemInt message) {
  message.x = message.y = 0;
  return message;
}
MissionItemInt jump_to(std::uint16_t number, float target, float repeat = -1) {
  auto message = without_place(item(number, jump, MAV_FRAME_MISSION, 0));
  message.param1 = target;
  message.param2 = repeat;
  return message;
}
Metres home(double altitude) { return Metres{altitude}; }

/// A vehicle and a station that talk, and the copy of one who listens.
class Listener {
 public:
  template <class M>
  void vehicle(const M& message, Version version = Version::v2) {
    copy.on_vehicle_message(TestFrame{message, testing::vehicle_system, testing::autopilot_component, version}.view());
  }
  template <class M>
  void station(const M& message, Version version = Version::v2) {
    copy.on_station_message(StationFrame{message, version}.view());
  }
  void answer(std::uint8_t result = MAV_MISSION_ACCEPTED, std::uint8_t type = 0) {
    vehicle(MissionAck{.target_system = 255, .type = result, .mission_type = type});
  }
  void begin_upload(std::size_t count) { station(MissionCount{.count = static_cast<std::uint16_t>(count)}); }
  void upload(const std::vector<MissionItemInt>& items) {
    begin_upload(items.size());
    for (const auto& each : items) station(each);
    answer();
  }
  void download(const std::vector<MissionItemInt>& items) {
    vehicle(MissionCount{.count = static_cast<std::uint16_t>(items.size())});
    for (const auto& each : items) vehicle(each);
  }
  void fly_to(std::uint16_t number) { vehicle(MissionCurrent{.seq = number}); }
  std::optional<Waypoint> to(std::uint16_t number, std::optional<Metres> home_altitude = Metres{100}) {
    fly_to(number);
    return copy.leg(home_altitude).to;
  }

  MissionCopy copy;
};

class Px4 : public Listener {};
class ArduPilot : public Listener {
 public:
  ArduPilot() { copy.set_first_item_is_home(true); }
};

void expect_at(const std::optional<Waypoint>& point, std::uint16_t number, double latitude_deg,
               std::optional<double> altitude) {
  ASSERT_TRUE(point);
  EXPECT_EQ(point->number, number);
  ASSERT_TRUE(point->latitude && point->longitude);
  EXPECT_NEAR(point->latitude->value, latitude_deg * 3.14159265358979 / 180, 1e-9);
  EXPECT_NEAR(point->longitude->value, 2 * 3.14159265358979 / 180, 1e-9);
  ASSERT_EQ(point->altitude_msl.has_value(), altitude.has_value());
  if (altitude) {
    EXPECT_NEAR(point->altitude_msl->value, *altitude, 1e-4);
  }
}

TEST(MissionCopy, KnowsNothingAtFirst) {
  Px4 px4;
  px4.fly_to(1);
  EXPECT_EQ(px4.copy.leg(home(0)), vehicle::Leg{});
  EXPECT_EQ(px4.copy.current_command(), std::nullopt);
}

TEST(MissionCopy, LearnsAnUploadThatTheVehicleAccepts) {
  Px4 px4;
  px4.begin_upload(2);
  px4.station(item(0));
  px4.station(item(1));
  EXPECT_EQ(px4.to(0), std::nullopt) << "not accepted yet";
  px4.answer();
  expect_at(px4.to(0), 1, 10, 140);
  expect_at(px4.to(1), 2, 11, 140);
}

TEST(MissionCopy, LearnsADownload) {
  Px4 px4;
  px4.download({item(0), item(1)});
  expect_at(px4.to(1), 2, 11, 140);
}

TEST(MissionCopy, LearnsFromMavlink1AndFromFloatItems) {
  for (const auto version : {Version::v1, Version::v2}) {
    Px4 px4;
    px4.station(MissionCount{.count = 1}, version);
    px4.station(MissionItem{.frame = above_home, .command = waypoint, .x = 10, .y = 2, .z = 40}, version);
    px4.vehicle(MissionAck{}, version);
    expect_at(px4.to(0), 1, 10, 140);

    Px4 other;
    other.vehicle(MissionCount{.count = 1}, version);
    other.vehicle(MissionItem{.frame = global, .command = waypoint, .x = 10, .y = 2, .z = 40}, version);
    expect_at(other.to(0), 1, 10, 40);
  }
}

TEST(MissionCopy, KeepsThePartsOfADownloadThatWereFetched) {
  Px4 px4;
  px4.vehicle(MissionCount{.count = 3});
  px4.vehicle(item(1));
  expect_at(px4.to(1), 2, 11, 140);
  EXPECT_EQ(px4.to(0), std::nullopt);
  EXPECT_EQ(px4.to(2), std::nullopt);
}

TEST(MissionCopy, KeepsWhatItKnowsWhileTheSameMissionIsFetchedAgain) {
  Px4 px4;
  px4.upload({item(0), item(1)});
  px4.vehicle(MissionCount{.count = 2});
  px4.vehicle(item(0));
  expect_at(px4.to(1), 2, 11, 140);
}

TEST(MissionCopy, ForgetsAMissionThatTheVehicleNoLongerHas) {
  Px4 px4;
  px4.upload({item(0), item(1)});
  px4.vehicle(MissionCount{.count = 5});
  EXPECT_EQ(px4.to(1), std::nullopt) << "somebody uploaded another mission over a link that we do not hear";
}

TEST(MissionCopy, BelievesTheVehicleWhereItTellsAnotherItem) {
  Px4 px4;
  px4.upload({item(0), item(1)});
  px4.vehicle(item(1, waypoint, global, 77));
  expect_at(px4.to(1), 2, 11, 77);
}

TEST(MissionCopy, DoesNotTakeARefusedUploadForTheMission) {
  Px4 px4;
  px4.upload({item(0)});
  px4.begin_upload(1);
  px4.station(item(0, waypoint, global, 999));
  px4.answer(MAV_MISSION_UNSUPPORTED);
  px4.answer();  // of something else
  expect_at(px4.to(0), 1, 10, 140);
}

TEST(MissionCopy, DoesNotKnowWhatARefusedUploadLeftInArduPilot) {
  ArduPilot ardupilot;
  ardupilot.upload({item(0), item(1)});
  ardupilot.begin_upload(2);
  ardupilot.answer(MAV_MISSION_OPERATION_CANCELLED);
  EXPECT_EQ(ardupilot.to(1), std::nullopt);
}

TEST(MissionCopy, GoesOnWithAnUploadAfterAnItemOutOfSequence) {
  Px4 px4;
  px4.begin_upload(2);
  px4.station(item(0));
  px4.answer(MAV_MISSION_INVALID_SEQUENCE);
  px4.station(item(1));
  px4.answer();
  expect_at(px4.to(1), 2, 11, 140);
}

TEST(MissionCopy, KnowsTheItemsOfAnUploadThatItHeard) {
  Px4 px4;
  px4.begin_upload(2);
  px4.station(item(1));
  px4.answer();
  EXPECT_EQ(px4.to(0), std::nullopt) << "this item was lost on the way to us";
  expect_at(px4.to(1), 2, 11, 140);
}

TEST(MissionCopy, BeginsAnewWhenTheStationDoes) {
  Px4 px4;
  px4.begin_upload(3);
  px4.station(item(2));
  px4.begin_upload(1);
  px4.station(item(0));
  px4.answer();
  expect_at(px4.to(0), 1, 10, 140);
  EXPECT_EQ(px4.to(2), std::nullopt);
}

TEST(MissionCopy, IgnoresFencesAndItemsBeyondTheEnd) {
  Px4 px4;
  px4.upload({item(0)});
  px4.station(MissionCount{.count = 2, .mission_type = fence});
  auto corner = item(0, waypoint, global, 5);
  corner.mission_type = fence;
  px4.station(corner);
  px4.answer(MAV_MISSION_ACCEPTED, fence);
  px4.vehicle(corner);
  px4.vehicle(MissionCount{.count = 9, .mission_type = fence});
  px4.vehicle(item(50));
  px4.station(item(50));
  expect_at(px4.to(0), 1, 10, 140);
  EXPECT_EQ(px4.to(50), std::nullopt);
}

TEST(MissionCopy, KeepsNoMissionThatIsTooLong) {
  Px4 px4;
  px4.begin_upload(MissionCopy::item_limit + 1);
  px4.station(item(0));
  px4.answer();
  EXPECT_EQ(px4.to(0), std::nullopt);
  px4.vehicle(MissionCount{.count = 65535});
  px4.vehicle(item(0));
  EXPECT_EQ(px4.to(0), std::nullopt);
}

TEST(MissionCopy, IsEmptyAfterClearing) {
  for (const auto type : {std::uint8_t{0}, all_types}) {
    Px4 px4;
    px4.upload({item(0)});
    px4.station(MissionClearAll{.mission_type = type});
    EXPECT_NE(px4.to(0), std::nullopt) << "not accepted yet";
    px4.answer(MAV_MISSION_ACCEPTED, type);
    EXPECT_EQ(px4.to(0), std::nullopt);
  }
  Px4 by_upload;
  by_upload.upload({item(0)});
  by_upload.upload({});
  EXPECT_EQ(by_upload.to(0), std::nullopt);
}

TEST(MissionCopy, IsNotClearedByARefusedOrAnotherClearing) {
  Px4 px4;
  px4.upload({item(0)});
  px4.station(MissionClearAll{.mission_type = fence});
  px4.answer(MAV_MISSION_ACCEPTED, fence);
  px4.station(MissionClearAll{});
  px4.answer(MAV_MISSION_DENIED);
  px4.answer();
  expect_at(px4.to(0), 1, 10, 140);
}

TEST(MissionCopy, AnUnansweredClearingDoesNotEmptyTheNextUpload) {
  Px4 px4;
  px4.station(MissionClearAll{});
  px4.upload({item(0)});
  expect_at(px4.to(0), 1, 10, 140);
}

TEST(MissionCopy, CountsFromHomeInArduPilotAndFromOneElsewhere) {
  ArduPilot ardupilot;
  ardupilot.download({item(0, waypoint, global, 50), item(1)});
  EXPECT_EQ(ardupilot.to(0), std::nullopt) << "home is no waypoint";
  expect_at(ardupilot.to(1), 1, 11, 140);
}

TEST(MissionCopy, HeightsAreAboveTheHomeThatTheVehicleTells) {
  ArduPilot ardupilot;
  ardupilot.download({item(0, waypoint, global, 50), item(1)});
  expect_at(ardupilot.to(1, std::nullopt), 1, 11, 90);
  expect_at(ardupilot.to(1, Metres{100}), 1, 11, 140);
}

// ArduPilot replaces an uploaded item 0 by its own home: seen in recordings.
TEST(MissionCopy, DoesNotTakeAnUploadedHomeForHome) {
  ArduPilot ardupilot;
  ardupilot.upload({item(0, waypoint, global, 7), item(1)});
  expect_at(ardupilot.to(1, std::nullopt), 1, 11, std::nullopt);
  ardupilot.download({item(0, waypoint, global, 50), item(1)});
  ardupilot.upload({item(0, waypoint, global, 7), item(1)});
  expect_at(ardupilot.to(1, std::nullopt), 1, 11, 90);
}

TEST(MissionCopy, TellsNoHeightThatIsNotAboveTheSea) {
  Px4 px4;
  px4.upload({item(0, waypoint, above_home), item(1, waypoint, above_terrain), item(2, waypoint, global, 300),
              item(3, waypoint, global, std::numeric_limits<float>::quiet_NaN())});
  expect_at(px4.to(0, std::nullopt), 1, 10, std::nullopt);
  expect_at(px4.to(1), 2, 11, std::nullopt);
  expect_at(px4.to(2, std::nullopt), 3, 12, 300);
  expect_at(px4.to(3), 4, 13, std::nullopt);
}

TEST(MissionCopy, TellsNoPlaceThatIsNone) {
  Px4 px4;
  auto far_away = item(3);
  far_away.x = std::numeric_limits<std::int32_t>::max();
  px4.upload({without_place(item(0, go_home, above_home, 0)), without_place(item(1, take_off)),
              item(2, waypoint, local), far_away, without_place(item(4, land, above_home, 0))});
  const auto expect_nowhere = [&](std::uint16_t number, std::optional<Metres> altitude) {
    EXPECT_EQ(px4.to(number), (Waypoint{.number = static_cast<std::uint16_t>(number + 1), .altitude_msl = altitude}))
        << number;
  };
  expect_nowhere(0, std::nullopt);
  expect_nowhere(1, Metres{140});
  expect_nowhere(2, std::nullopt);
  expect_nowhere(3, std::nullopt);
  expect_nowhere(4, std::nullopt);
}

std::optional<std::uint16_t> number_after(Listener& listener, std::uint16_t current) {
  listener.fly_to(current);
  const auto next = listener.copy.leg(home(0)).next;
  return next ? std::optional{next->number} : std::nullopt;
}

TEST(MissionCopy, LooksBeyondCommandsForTheNextWaypoint) {
  Px4 px4;
  px4.upload({item(0), without_place(item(1, change_speed, MAV_FRAME_MISSION)), item(2), item(3, go_home)});
  EXPECT_EQ(number_after(px4, 0), 3);
  EXPECT_EQ(number_after(px4, 2), 4);
  EXPECT_EQ(number_after(px4, 3), std::nullopt) << "the end";
}

TEST(MissionCopy, FollowsJumps) {
  Px4 px4;
  px4.upload({item(0), item(1), jump_to(2, 0), item(3)});
  EXPECT_EQ(number_after(px4, 1), 1);
  px4.upload({item(0), item(1), jump_to(2, 0, 0), item(3)});
  EXPECT_EQ(number_after(px4, 1), 4) << "no repetitions";
  px4.upload({item(0), jump_to(1, 2), jump_to(2, 3), item(3)});
  EXPECT_EQ(number_after(px4, 0), 4) << "from jump to jump";
  px4.upload({item(0), jump_to(1, 99), item(2)});
  EXPECT_EQ(number_after(px4, 0), 3) << "beyond the end";
  px4.upload({item(0), jump_to(1, -5), item(2)});
  EXPECT_EQ(number_after(px4, 0), 3) << "before the beginning";
  px4.upload({item(0), jump_to(1, std::numeric_limits<float>::quiet_NaN()), item(2)});
  EXPECT_EQ(number_after(px4, 0), 3) << "NaN";
}

TEST(MissionCopy, GivesUpOnJumpsThatLeadNowhere) {
  Px4 px4;
  px4.upload({item(0), jump_to(1, 1)});
  EXPECT_EQ(number_after(px4, 0), std::nullopt);
  px4.upload({item(0), jump_to(1, 2), jump_to(2, 1)});
  EXPECT_EQ(number_after(px4, 0), std::nullopt);
}

TEST(MissionCopy, TellsTheLegFromTheItemReachedToTheCurrentOne) {
  ArduPilot ardupilot;
  ardupilot.upload({item(0), item(1, take_off), item(2), item(3), item(4)});
  ardupilot.vehicle(MissionItemReached{.seq = 2});
  ardupilot.fly_to(3);
  const auto leg = ardupilot.copy.leg(home(100));
  expect_at(leg.from, 2, 12, 140);
  expect_at(leg.to, 3, 13, 140);
  expect_at(leg.next, 4, 14, 140);
  EXPECT_EQ(ardupilot.copy.current_command(), waypoint);
}

TEST(MissionCopy, ForgetsTheItemReachedWithTheMissionButNotWithADownload) {
  Px4 px4;
  px4.upload({item(0), item(1)});
  px4.vehicle(MissionItemReached{.seq = 0});
  px4.download({item(0), item(1)});
  EXPECT_TRUE(px4.copy.leg(home(0)).from);
  px4.upload({item(0), item(1)});
  EXPECT_FALSE(px4.copy.leg(home(0)).from);
}

}  // namespace
}  // namespace ponte::autopilot
