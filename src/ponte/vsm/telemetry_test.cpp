#include "ponte/vsm/telemetry.hpp"

#include "ponte/autopilot/test_frames.hpp"
#include "ponte/dli/codec.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/messages/air_and_ground_relative_states.hpp"
#include "ponte/dli/messages/body_relative_sensed_states.hpp"
#include "ponte/dli/messages/from_to_next_waypoint_states.hpp"
#include "ponte/dli/messages/heartbeat_message.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/dli/messages/subsystem_status_alert.hpp"
#include "ponte/dli/messages/subsystem_status_report.hpp"
#include "ponte/dli/messages/vehicle_id.hpp"
#include "ponte/dli/messages/vehicle_operating_mode_report.hpp"
#include "ponte/dli/messages/vehicle_operating_states.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/highres_imu.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/autopilots/scaled_imu.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ponte::vsm {
namespace {

namespace from = mavlink::autopilots;
namespace to = dli::messages;
using autopilot::testing::station_component;
using autopilot::testing::station_system;
using autopilot::testing::TestFrame;
using mavlink::ComponentId;
using mavlink::SystemId;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr WallTime start_wall = wall_time_from_unix_us(1'700'000'000'000'000);
constexpr std::uint64_t start_stamp = 753'315'200'000;  ///< ms from 2000-01-01 to 2023-11-14 22:13:20

constexpr SystemId first{1}, second{2};
constexpr ComponentId autopilot_one{1}, camera{100}, companion{191};

constexpr from::Heartbeat copter{.type = from::MAV_TYPE_QUADROTOR,
                                 .autopilot = from::MAV_AUTOPILOT_ARDUPILOTMEGA,
                                 .base_mode = 209,
                                 .custom_mode = 3,  // AUTO
                                 .system_status = from::MAV_STATE_ACTIVE};
constexpr from::Heartbeat station{.type = from::MAV_TYPE_GCS, .autopilot = from::MAV_AUTOPILOT_INVALID};
constexpr from::GlobalPositionInt lisbon{
    .lat = 387223000, .lon = -91393000, .alt = 120500, .vx = 1230, .vy = -450, .vz = -100};

/// A message that came out of the VSM.
struct Sent {
  dli::EntityId source;
  dli::EntityId destination;
  dli::MessageNumber number;
  std::vector<std::byte> data;
};

/// A VSM on a link, and a clock that only the test moves.
class Link {
 public:
  explicit Link(const TelemetryConfig& config = {}, const TelemetryRates& rates = {})
      : profile{config.profile}, telemetry{config, rates} {}

  template <class M>
  void say(const M& message, SystemId system = first, ComponentId component = autopilot_one) {
    const TestFrame frame{message, system, component};
    telemetry.on_frame(now, wall(), frame.view(), M::info, outbox);
    collect();
  }
  /// Lets time go by as an application would: `on_tick` is called when it wants to be.
  void wait(Duration time) {
    const auto end = now + time;
    while (telemetry.next_deadline() <= end) {
      now = std::max(now, telemetry.next_deadline());
      tick();
    }
    now = end;
  }
  /// The same with a heartbeat of the first vehicle every second.
  void wait_alive(int time_s) {
    for (int second_s = 0; second_s < time_s; ++second_s) {
      wait(seconds{1});
      say(copter);
    }
  }
  void tick() {
    telemetry.on_tick(now, wall(), outbox);
    collect();
  }
  void collect() {
    outbox.drain([&](const OutgoingMessage& message) {
      dli::DatagramCounters counters;
      dli::DatagramReader reader{message.bytes(), profile, counters};
      const auto view = reader.next();
      ASSERT_TRUE(view && *view);
      EXPECT_FALSE(reader.next()) << "a message is a datagram of its own";
      EXPECT_EQ(message.time, wall());
      sent.push_back(
          {(*view)->source, (*view)->destination, (*view)->number, {(*view)->data.begin(), (*view)->data.end()}});
    });
  }
  void forget() { sent.clear(); }
  [[nodiscard]] WallTime wall() const {
    return start_wall + std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
  }
  /// What was sent since the last `forget`, of one type and by one entity.
  template <class M>
  [[nodiscard]] std::vector<M> all(dli::EntityId source) const {
    std::vector<M> result;
    for (const auto& message : sent) {
      if (message.number != M::info.number || message.source != source) continue;
      const auto decoded = dli::decode<M>(message.data, profile);
      EXPECT_TRUE(decoded.has_value());
      if (decoded) result.push_back(*decoded);
    }
    return result;
  }
  template <class M>
  [[nodiscard]] std::vector<M> all() const {
    return all<M>(vehicle_id(first));
  }
  static dli::EntityId vehicle_id(SystemId system) { return {20, dli::EntityType::vehicle, system.value}; }

  dli::Profile profile;
  Telemetry telemetry;
  Outbox<OutgoingMessage> outbox{512};
  Timestamp now{};
  std::vector<Sent> sent;
};

constexpr dli::EntityId vsm_id{20, dli::EntityType::vsm, 1};

TEST(Telemetry, SendsItsHeartbeatOnceASecondWithoutAnyVehicle) {
  Link link;
  EXPECT_LE(link.telemetry.next_deadline(), link.now) << "the first one is due at once";
  link.wait(milliseconds{4999});
  const auto beats = link.all<to::HeartbeatMessage>(vsm_id);
  ASSERT_EQ(beats.size(), 5U);
  for (std::size_t i = 0; i < beats.size(); ++i) EXPECT_EQ(beats[i].time_stamp, start_stamp + i * 1000);
  EXPECT_EQ(link.sent.size(), beats.size()) << "and nothing else";
  EXPECT_EQ(link.sent[0].destination, dli::broadcast_id);
}

TEST(Telemetry, SendsItsHeartbeatWhereOnlyFramesMoveTheTime) {
  Link link;
  for (int i = 0; i < 50; ++i) {
    link.say(from::Attitude{});
    link.now += milliseconds{100};
  }
  EXPECT_EQ(link.all<to::HeartbeatMessage>(vsm_id).size(), 5U);
}

TEST(Telemetry, MakesOneInertialMessageOfEveryAttitude) {
  Link link;
  for (int i = 0; i < 10; ++i) {
    link.say(from::Attitude{.roll = 0.17453293F, .pitch = -0.08726646F, .yaw = 1.57079633F, .rollspeed = 0.1F});
    link.wait(milliseconds{20});
  }
  const auto messages = link.all<to::InertialStates>();
  ASSERT_EQ(messages.size(), 10U);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].roll, 0x071C);
    EXPECT_EQ(messages[i].pitch, -910);
    EXPECT_EQ(messages[i].heading, 0x4000);
    EXPECT_EQ(messages[i].roll_rate, 20);
    EXPECT_EQ(messages[i].time_stamp, start_stamp + i * 20);
  }
}

TEST(Telemetry, ThinsTheAttitudesOfALiveLink) {
  Link link{{}, live_rates()};
  for (int i = 0; i < 100; ++i) {  // 50 Hz for two seconds, each with another roll
    link.say(from::Attitude{.roll = 0.01F * static_cast<float>(i)});
    link.wait(milliseconds{20});
  }
  const auto count = link.all<to::InertialStates>().size();
  EXPECT_GE(count, 20U);
  EXPECT_LE(count, 23U) << "a pause of 90 ms";
}

TEST(Telemetry, TellsUnchangedFieldsOfALiveLinkOnlyOnceInAWhile) {
  Link link{{}, live_rates()};
  for (int i = 0; i < 60; ++i) {  // 12 s; only the heading moves
    link.say(from::Attitude{.roll = 0.5F, .yaw = 0.01F * static_cast<float>(i)});
    link.wait(milliseconds{200});
  }
  const auto messages = link.all<to::InertialStates>();
  ASSERT_EQ(messages.size(), 60U);
  EXPECT_EQ(std::ranges::count_if(messages, [](const auto& message) { return message.roll.has_value(); }), 3)
      << "at the start, and every five seconds";
  EXPECT_TRUE(std::ranges::all_of(messages, [](const auto& message) { return message.heading.has_value(); }));
}

TEST(Telemetry, SendsNothingWhereNothingChanges) {
  Link link{{}, live_rates()};
  for (int i = 0; i < 20; ++i) {
    link.say(from::Attitude{.roll = 0.5F});
    link.wait(milliseconds{200});
  }
  EXPECT_EQ(link.all<to::InertialStates>().size(), 1U);
}

TEST(Telemetry, RaisesAnAlertThatTheVehicleCannotTell) {
  Link link;
  link.say(copter);
  link.forget();
  link.telemetry.raise(first, {vehicle::Condition::warning, vehicle::Subsystem::comms, Text<79>{"two of them"}},
                       link.wall(), link.outbox);
  link.telemetry.raise(second, {vehicle::Condition::warning, vehicle::Subsystem::comms, Text<79>{"nobody"}},
                       link.wall(), link.outbox);
  link.collect();
  const auto alerts = link.all<to::SubsystemStatusAlert>();
  ASSERT_EQ(alerts.size(), 1U);
  EXPECT_EQ(link.sent.size(), 1U);
  EXPECT_EQ(alerts[0].text->view(), "two of them");
}

TEST(Telemetry, LeavesOutWhatIsNotKnown) {
  Link link;
  link.say(from::Attitude{.roll = 0.1F});
  link.say(from::GlobalPositionInt{});  // no position yet
  link.wait(seconds{1});
  const auto messages = link.all<to::InertialStates>();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].latitude, std::nullopt);
  EXPECT_EQ(messages[0].altitude, std::nullopt);
  EXPECT_EQ(messages[0].altitude_type, std::nullopt);
  EXPECT_EQ(messages[0].u_speed, std::nullopt);
  EXPECT_EQ(messages[0].u_accel, std::nullopt);
  EXPECT_EQ(messages[0].magnetic_variation, std::nullopt);
}

void expect_lisbon(const to::InertialStates& message) {
  EXPECT_EQ(message.latitude, 461975034);
  EXPECT_EQ(message.longitude, -109036096);
  EXPECT_EQ(message.altitude, 0x1789);
  EXPECT_EQ(message.altitude_type, 3);
  EXPECT_EQ(message.u_speed, 0xF6);
  EXPECT_EQ(message.v_speed, -90);
  EXPECT_EQ(message.w_speed, -20);
}

TEST(Telemetry, PutsThePositionIntoTheMessageOfTheNextAttitude) {
  Link link;
  link.say(lisbon);
  link.say(from::Attitude{});
  link.say(from::Attitude{});
  const auto messages = link.all<to::InertialStates>();
  ASSERT_EQ(messages.size(), 2U);
  expect_lisbon(messages[0]);
  EXPECT_TRUE(messages[0].roll);
  EXPECT_EQ(messages[1].latitude, std::nullopt) << "no new position";
}

TEST(Telemetry, LosesNoPositionThatComesBeforeTheNextAttitude) {
  Link link;
  for (int i = 0; i < 5; ++i) {
    auto position = lisbon;
    position.alt = 1000 * i;
    link.say(position);
    link.now += milliseconds{10};
  }
  link.say(from::Attitude{});
  std::vector<std::optional<std::int32_t>> altitudes;
  for (const auto& message : link.all<to::InertialStates>()) altitudes.push_back(message.altitude);
  EXPECT_THAT(altitudes, ElementsAre(0, 50, 100, 150, 200));
}

TEST(Telemetry, DoesNotWaitForAnAttitudeThatDoesNotCome) {
  Link link;
  link.say(lisbon);
  link.wait(milliseconds{99});
  EXPECT_THAT(link.all<to::InertialStates>(), IsEmpty());
  link.wait(milliseconds{1});
  ASSERT_EQ(link.all<to::InertialStates>().size(), 1U);
  expect_lisbon(link.all<to::InertialStates>()[0]);
}

TEST(Telemetry, MakesOneAirMessageOfEveryVfrHud) {
  Link link;
  link.say(copter);
  for (int i = 0; i < 3; ++i) {
    link.say(from::VfrHud{.airspeed = 20, .throttle = 55, .alt = 320.5F, .climb = -1.5F});
    link.wait(milliseconds{250});
  }
  const auto messages = link.all<to::AirAndGroundRelativeStates>();
  ASSERT_EQ(messages.size(), 3U);
  for (const auto& message : messages) {
    EXPECT_EQ(message.indicated_airspeed, 400);
    EXPECT_EQ(message.true_airspeed, std::nullopt);
    EXPECT_EQ(message.barometric_altitude, 16025);
    EXPECT_EQ(message.barometric_altitude_rate, -30);
    EXPECT_EQ(message.u_wind, std::nullopt);
  }
}

TEST(Telemetry, TellsTheAirWithoutVfrHudAfterAWhile) {
  Link link;
  link.say(lisbon);
  link.wait(milliseconds{199});
  EXPECT_THAT(link.all<to::AirAndGroundRelativeStates>(), IsEmpty());
  link.wait(milliseconds{1});
  const auto messages = link.all<to::AirAndGroundRelativeStates>();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].u_ground, 0xF6);
}

TEST(Telemetry, MakesABodyMessageOfInertialSamplesButNotMoreThanTwentyASecond) {
  Link link;
  for (int i = 0; i < 100; ++i) {
    link.say(from::HighresImu{.xacc = 1, .zgyro = 0.1F, .fields_updated = 63});
    link.wait(milliseconds{10});
  }
  const auto messages = link.all<to::BodyRelativeSensedStates>();
  EXPECT_EQ(messages.size(), 20U);
  EXPECT_EQ(messages[0].x_body_accel, 200);
  EXPECT_EQ(messages[0].yaw_rate, 1000);

  Link slow;
  for (int i = 0; i < 10; ++i) {
    slow.say(from::ScaledImu{.zacc = -1000});
    slow.wait(milliseconds{100});
  }
  EXPECT_EQ(slow.all<to::BodyRelativeSensedStates>().size(), 10U);
}

TEST(Telemetry, SaysNothingTwiceWhereTwoSensorsSayTheSame) {
  Link link;
  link.say(from::HighresImu{.xacc = 1, .fields_updated = 63});
  link.wait(milliseconds{60});
  link.say(from::ScaledImu{.xacc = 500});
  EXPECT_EQ(link.all<to::BodyRelativeSensedStates>().size(), 1U) << "the worse source is not listened to";
}

TEST(Telemetry, ReportsTheModeOnChangeAndEveryTwoSeconds) {
  Link link;
  link.say(copter);
  ASSERT_EQ(link.all<to::VehicleOperatingModeReport>().size(), 1U);
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>()[0].select_flight_path_control_mode, 11);
  link.wait_alive(10);
  const auto reports = link.all<to::VehicleOperatingModeReport>();
  EXPECT_EQ(reports.size(), 6U) << "at 0, 2, 4, 6, 8, 10 s";
  for (std::size_t i = 2; i < reports.size(); ++i)
    EXPECT_GT(reports[i].time_stamp, reports[i - 1].time_stamp) << "confirmed by the heartbeat since";

  link.forget();
  link.now += milliseconds{300};
  auto returning = copter;
  returning.custom_mode = 6;  // RTL
  link.say(returning);
  ASSERT_EQ(link.all<to::VehicleOperatingModeReport>().size(), 1U) << "at once";
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>()[0].select_flight_path_control_mode, 32);
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>()[0].time_stamp, start_stamp + 10'300);
  link.forget();
  link.wait(milliseconds{1999});
  EXPECT_THAT(link.all<to::VehicleOperatingModeReport>(), IsEmpty());
  link.wait(milliseconds{1});
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>().size(), 1U);
}

TEST(Telemetry, TellsThePhaseEverySecondAndOnChange) {
  Link link;
  link.say(copter);
  link.wait_alive(5);
  const auto states = link.all<to::VehicleOperatingStates>();
  EXPECT_EQ(states.size(), 5U) << "at once, and what a heartbeat confirms within a second";
  for (const auto& each : states) EXPECT_EQ(each.av_state, 11) << "a station that comes late needs it too";

  link.forget();
  link.now += milliseconds{300};
  auto failing = copter;
  failing.system_status = from::MAV_STATE_CRITICAL;
  link.say(failing);
  ASSERT_EQ(link.all<to::VehicleOperatingStates>().size(), 1U) << "at once";
  EXPECT_EQ(link.all<to::VehicleOperatingStates>()[0].av_state, 13);
}

TEST(Telemetry, TellsTheEnergyOnceASecond) {
  Link link;
  link.say(copter);
  link.forget();
  for (int i = 0; i < 30; ++i) {
    link.now += milliseconds{100};
    link.say(from::BatteryStatus{.id = 0, .battery_remaining = 50});
  }
  const auto states = link.all<to::VehicleOperatingStates>();
  ASSERT_EQ(states.size(), 3U);
  for (const auto& each : states) EXPECT_EQ(each.current_propulsion_energy_level, 31250);
}

TEST(Telemetry, TellsTheIdentityOnChangeAndEveryFiveSeconds) {
  Link link;
  link.say(copter);
  ASSERT_EQ(link.all<to::VehicleId>().size(), 1U);
  const auto identity = link.all<to::VehicleId>()[0];
  EXPECT_EQ(identity.vsm_id, vsm_id.value);
  EXPECT_EQ(identity.vehicle_id_update, 0x14400001U);
  EXPECT_EQ(identity.owning_id, 20);
  EXPECT_EQ(identity.vehicle_subtype, from::MAV_TYPE_QUADROTOR);
  EXPECT_EQ(identity.tail_number, std::nullopt);
  link.wait_alive(10);
  EXPECT_EQ(link.all<to::VehicleId>().size(), 3U) << "at 0, 5, 10 s";
  link.forget();
  link.say(from::MissionCurrent{.mission_id = 0x12AB});
  ASSERT_EQ(link.all<to::VehicleId>().size(), 1U);
  EXPECT_EQ(link.all<to::VehicleId>()[0].mission_id->view(), "000012ab");
}

void upload_two_items(Link& link, SystemId vehicle) {
  link.say(from::MissionCount{.target_system = vehicle.value, .count = 2}, station_system, station_component);
  for (std::uint16_t number = 0; number < 2; ++number)
    link.say(from::MissionItemInt{.target_system = vehicle.value,
                                  .seq = number,
                                  .frame = from::MAV_FRAME_GLOBAL_INT,
                                  .command = from::MAV_CMD_NAV_WAYPOINT,
                                  .x = 387223000,
                                  .y = -91393000,
                                  .z = 120.5F},
             station_system, station_component);
  link.say(from::MissionAck{.target_system = station_system.value}, vehicle);
}

TEST(Telemetry, TellsTheLegOfAMissionThatAStationUploaded) {
  Link link;
  link.say(copter);
  link.say(copter, second);
  upload_two_items(link, first);
  link.say(from::MissionCurrent{.seq = 1}, second);
  EXPECT_THAT(link.all<to::FromToNextWaypointStates>(Link::vehicle_id(second)), IsEmpty())
      << "another vehicle's mission";
  link.forget();
  link.say(from::MissionCurrent{.seq = 1});
  ASSERT_EQ(link.all<to::FromToNextWaypointStates>().size(), 1U);
  const auto leg = link.all<to::FromToNextWaypointStates>()[0];
  EXPECT_EQ(leg.to_waypoint_number, 1);
  EXPECT_EQ(leg.to_waypoint_latitude, 461975034);
  EXPECT_EQ(leg.to_waypoint_altitude, 0x1789);
  EXPECT_EQ(leg.altitude_type, 3);
  EXPECT_EQ(leg.from_waypoint_number, std::nullopt);
  EXPECT_EQ(leg.to_waypoint_time, std::nullopt);

  link.forget();
  for (int i = 0; i < 30; ++i) {
    link.wait(milliseconds{100});
    link.say(from::MissionCurrent{.seq = 1});
  }
  EXPECT_EQ(link.all<to::FromToNextWaypointStates>().size(), 3U) << "once a second while it is confirmed";
}

TEST(Telemetry, KeepsTwoVehiclesOnOneLinkApart) {
  Link link;
  auto other = copter;
  other.custom_mode = 6;
  link.say(copter, first);
  link.say(other, second);
  link.say(from::Attitude{.roll = 0.17453293F}, first);
  link.say(lisbon, second);
  link.say(from::Attitude{.roll = -0.08726646F}, second);
  EXPECT_EQ(link.telemetry.vehicle_count(), 2U);
  const auto one = link.all<to::InertialStates>(Link::vehicle_id(first));
  const auto two = link.all<to::InertialStates>(Link::vehicle_id(second));
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(two.size(), 1U);
  EXPECT_EQ(one[0].roll, 0x071C);
  EXPECT_EQ(one[0].latitude, std::nullopt);
  EXPECT_EQ(two[0].roll, -910);
  expect_lisbon(two[0]);
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>(Link::vehicle_id(first))[0].select_flight_path_control_mode, 11);
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>(Link::vehicle_id(second))[0].select_flight_path_control_mode, 32);
  EXPECT_EQ(link.telemetry.state_of(SystemId{3}), nullptr);
  ASSERT_NE(link.telemetry.state_of(second), nullptr);
  EXPECT_EQ(link.telemetry.state_of(second)->mode.value().kind, vehicle::ModeKind::return_home);
}

TEST(Telemetry, OneLostVehicleDoesNotSilenceTheOther) {
  Link link;
  link.say(copter, first);
  link.say(copter, second);
  link.forget();
  link.wait_alive(4);
  EXPECT_THAT(link.all<to::SubsystemStatusAlert>(Link::vehicle_id(first)), IsEmpty());
  EXPECT_EQ(link.all<to::SubsystemStatusAlert>(Link::vehicle_id(second)).size(), 1U);
}

TEST(Telemetry, IgnoresGroundStations) {
  // A script that follows the tutorials calls itself a station with a generic autopilot.
  from::Heartbeat generic{.type = from::MAV_TYPE_GCS, .autopilot = from::MAV_AUTOPILOT_GENERIC};
  for (const auto& heartbeat : {station, generic})
    for (const auto component : {station_component, autopilot_one}) {
      Link link;
      for (int i = 0; i < 20; ++i) {
        link.say(heartbeat, station_system, component);
        link.say(from::MissionCount{.target_system = 1, .count = 2}, station_system, component);
        link.wait(seconds{1});
      }
      EXPECT_EQ(link.telemetry.vehicle_count(), 0U);
      EXPECT_EQ(link.sent.size(), link.all<to::HeartbeatMessage>(vsm_id).size());
    }
}

TEST(Telemetry, AStationThatSpeaksBeforeItsHeartbeatSaysWhatItIsLeavesNothingBehind) {
  Link link;
  link.say(from::MissionCount{.target_system = 1, .count = 2}, station_system, autopilot_one);
  link.say(station, station_system, autopilot_one);
  link.wait(seconds{20});
  EXPECT_EQ(link.telemetry.vehicle_count(), 0U);
  EXPECT_EQ(link.telemetry.state_of(station_system), nullptr);
  EXPECT_EQ(link.sent.size(), link.all<to::HeartbeatMessage>(vsm_id).size());
  upload_two_items(link, first);
}

TEST(Telemetry, ListensToTheAutopilotAmongTheComponentsOfAVehicle) {
  auto not_autopilot = station;
  not_autopilot.type = from::MAV_TYPE_CAMERA;
  Link link;
  link.say(not_autopilot, first, camera);
  link.say(from::Attitude{.roll = 1}, first, camera);
  EXPECT_EQ(link.telemetry.vehicle_count(), 0U);
  link.say(copter);
  link.say(from::Attitude{.roll = 0.17453293F});
  link.say(not_autopilot, first, camera);
  link.say(from::Attitude{.roll = 1}, first, camera);
  EXPECT_EQ(link.telemetry.vehicle_count(), 1U);
  const auto messages = link.all<to::InertialStates>();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].roll, 0x071C);

  link.forget();
  for (int i = 0; i < 5; ++i) {
    link.wait(seconds{1});
    link.say(not_autopilot, first, camera);
  }
  EXPECT_EQ(link.all<to::SubsystemStatusAlert>().size(), 1U) << "the camera's heartbeat is not the autopilot's";
}

TEST(Telemetry, PrefersComponentOneToAnotherThatCallsItselfAnAutopilot) {
  Link link;
  link.say(copter, first, companion);
  link.say(from::Attitude{.roll = 0.17453293F}, first, companion);
  EXPECT_EQ(link.all<to::InertialStates>().size(), 1U);
  link.say(copter);
  link.say(from::Attitude{.roll = 0.17453293F}, first, companion);
  EXPECT_EQ(link.all<to::InertialStates>().size(), 1U);
  link.say(from::Attitude{.roll = 0.17453293F});
  EXPECT_EQ(link.all<to::InertialStates>().size(), 2U);
}

TEST(Telemetry, TakesNobodyForAVehicleInSystemZero) {
  Link link;
  link.say(copter, SystemId{0});
  EXPECT_EQ(link.telemetry.vehicle_count(), 0U);
}

TEST(Telemetry, HasAnEndToItsVehicles) {
  Link link;
  for (int system = 1; system <= 255; ++system) link.say(copter, SystemId{static_cast<std::uint8_t>(system)});
  EXPECT_EQ(link.telemetry.vehicle_count(), Telemetry::vehicle_limit);
}

struct AlertSeen {
  int priority;
  int type;
  bool first_time;
  friend bool operator==(const AlertSeen&, const AlertSeen&) = default;
};
std::vector<AlertSeen> alerts_in(const Link& link) {
  std::vector<AlertSeen> result;
  for (const auto& alert : link.all<to::SubsystemStatusAlert>()) {
    EXPECT_EQ(alert.text->view(), "vehicle heartbeat lost");
    EXPECT_EQ(alert.subsystem_id, 3);
    EXPECT_EQ(std::abs(alert.alert_id.value_or(0)), 157833363);
    result.push_back({alert.priority.value(), alert.type.value(), alert.alert_id.value() < 0});
  }
  return result;
}

TEST(Telemetry, AlertsAndGivesUpTheModeWhenTheHeartbeatIsLostAndClearsBothWhenItIsBack) {
  Link link;
  link.say(copter);
  link.forget();
  link.wait(milliseconds{2999});
  EXPECT_THAT(alerts_in(link), IsEmpty());
  link.wait(milliseconds{1});
  EXPECT_THAT(alerts_in(link), ElementsAre(AlertSeen{3, 2, true}));
  EXPECT_EQ(link.all<to::SubsystemStatusAlert>()[0].time_stamp, start_stamp + 3000);

  link.wait(milliseconds{6999});
  for (const auto& report : link.all<to::VehicleOperatingModeReport>())
    EXPECT_EQ(report.select_flight_path_control_mode, 11);
  link.forget();
  link.wait(milliseconds{1});
  EXPECT_THAT(alerts_in(link), ElementsAre(AlertSeen{4, 2, false}));
  ASSERT_EQ(link.all<to::VehicleOperatingModeReport>().size(), 1U);
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>()[0].select_flight_path_control_mode, 0);
  ASSERT_EQ(link.all<to::VehicleOperatingStates>().size(), 1U);
  EXPECT_EQ(link.all<to::VehicleOperatingStates>()[0].av_state, 0);

  link.forget();
  link.wait(seconds{60});
  EXPECT_THAT(alerts_in(link), IsEmpty()) << "told once";
  EXPECT_EQ(link.all<to::HeartbeatMessage>(vsm_id).size(), 60U) << "the VSM is alive";
  link.forget();
  link.say(copter);
  EXPECT_THAT(alerts_in(link), ElementsAre(AlertSeen{0, 0, false}));
  ASSERT_EQ(link.all<to::VehicleOperatingModeReport>().size(), 1U);
  EXPECT_EQ(link.all<to::VehicleOperatingModeReport>()[0].select_flight_path_control_mode, 11);
  EXPECT_EQ(link.all<to::VehicleOperatingStates>()[0].av_state, 11);
}

TEST(Telemetry, SendsTextsAsAlerts) {
  Link link;
  link.say(copter);
  link.forget();
  const std::string_view text = "Battery 1 is low 10.60V used 311 mAh";
  link.say(from::Statustext{.severity = 4, .text = text});
  link.say(from::Statustext{.severity = 7, .text = text});
  ASSERT_EQ(link.all<to::SubsystemStatusAlert>().size(), 1U);
  const auto alert = link.all<to::SubsystemStatusAlert>()[0];
  EXPECT_EQ(alert.priority, 2);
  EXPECT_EQ(alert.subsystem_id, 4);
  EXPECT_EQ(alert.type, 3);
  EXPECT_EQ(alert.persistence, 10);
  EXPECT_EQ(alert.alert_id, -371538083);
  EXPECT_EQ(alert.text->view(), text);
  EXPECT_EQ(alert.subsystem_state_report_reference, -1);
}

TEST(Telemetry, SendsSubsystemReportsOnChangeOnly) {
  constexpr std::uint32_t gps = 32, battery = 33554432;
  const from::SysStatus healthy{.onboard_control_sensors_present = gps | battery,
                                .onboard_control_sensors_enabled = gps | battery,
                                .onboard_control_sensors_health = gps | battery};
  auto without_gps = healthy;
  without_gps.onboard_control_sensors_health = battery;
  Link link;
  for (int i = 0; i < 5; ++i) link.say(healthy);
  auto reports = link.all<to::SubsystemStatusReport>();
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].subsystem_id, 4);
  EXPECT_EQ(reports[0].subsystem_state, 1);
  EXPECT_EQ(reports[1].subsystem_id, 5);
  link.forget();
  for (int i = 0; i < 5; ++i) link.say(without_gps);
  reports = link.all<to::SubsystemStatusReport>();
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0].subsystem_id, 5);
  EXPECT_EQ(reports[0].subsystem_state, 3);
}

TEST(Telemetry, SendsWhatWaitsAtTheEnd) {
  Link link;
  link.say(copter);
  link.say(lisbon);
  link.say(from::BatteryStatus{.id = 0, .battery_remaining = 50});
  link.say(from::Statustext{
      .severity = 4, .text = std::string_view{"Arming denied: Resolve system health failures firs"}, .id = 3});
  link.forget();
  link.telemetry.finish(link.now, link.wall(), link.outbox);
  link.collect();
  ASSERT_EQ(link.all<to::InertialStates>().size(), 1U);
  expect_lisbon(link.all<to::InertialStates>()[0]);
  ASSERT_EQ(link.all<to::VehicleOperatingStates>().size(), 1U);
  EXPECT_EQ(link.all<to::VehicleOperatingStates>()[0].current_propulsion_energy_level, 31250);
  EXPECT_EQ(link.all<to::AirAndGroundRelativeStates>().size(), 1U);
  EXPECT_EQ(link.all<to::SubsystemStatusAlert>().size(), 1U);
}

TEST(Telemetry, SpeaksTheEditionOfTheProfile) {
  for (const auto edition : {dli::Edition::ed3, dli::Edition::ed_a}) {
    TelemetryConfig config;
    config.profile = dli::Profile{edition};
    Link link{config};
    link.say(copter);
    link.say(from::Statustext{.severity = 4, .text = std::string_view{"low fuel"}});
    link.say(from::Attitude{});
    EXPECT_EQ(link.all<to::InertialStates>().size(), 1U);
    EXPECT_EQ(link.all<to::SubsystemStatusAlert>().size(), 1U);
  }
}

// Whatever the application calls and when: a tick at the time that it was told leaves nothing due.
TEST(Telemetry, NeverAsksToBeCalledAgainAtOnce) {
  Link link;
  link.say(copter);
  link.say(lisbon);
  for (int i = 0; i < 1000; ++i) {
    const auto deadline = link.telemetry.next_deadline();
    link.now = std::max(link.now, deadline);
    link.tick();
    ASSERT_GT(link.telemetry.next_deadline(), link.now) << i;
  }
  EXPECT_GT(link.now, Timestamp{} + seconds{100});
}

}  // namespace
}  // namespace ponte::vsm
