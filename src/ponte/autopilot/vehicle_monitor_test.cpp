#include "ponte/autopilot/vehicle_monitor.hpp"

#include "ponte/autopilot/test_frames.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"
#include "ponte/mavlink/autopilots/nav_controller_output.hpp"
#include "ponte/mavlink/autopilots/position_target_global_int.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace ponte::autopilot {
namespace {

using namespace std::string_view_literals;
using namespace mavlink::autopilots;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::StationFrame;
using testing::TestFrame;
using vehicle::Alert;
using vehicle::Condition;
using vehicle::ModeKind;
using vehicle::Phase;
using vehicle::Subsystem;

constexpr WallTime start_wall = wall_time_from_unix_us(1'700'000'000'000'000);
constexpr std::uint8_t disarmed = 81, armed = 209;

constexpr std::uint32_t automatic = 3, guided = 4;
constexpr Heartbeat copter{.type = MAV_TYPE_QUADROTOR,
                           .autopilot = MAV_AUTOPILOT_ARDUPILOTMEGA,
                           .base_mode = armed,
                           .custom_mode = automatic,
                           .system_status = MAV_STATE_ACTIVE};

/// One vehicle and its monitor, and a clock that only the test moves.
class Flight {
 public:
  template <class M>
  void say(const M& message, mavlink::Version version = mavlink::Version::v2) {
    monitor.on_message(
        now, wall(), TestFrame{message, testing::vehicle_system, testing::autopilot_component, version}.view(), outbox);
  }
  template <class M>
  void station_says(const M& message) {
    monitor.on_station_message(StationFrame{message}.view());
  }
  void wait(Duration time) {
    now += time;
    monitor.on_tick(now, wall(), outbox);
  }
  [[nodiscard]] WallTime wall() const {
    return start_wall + std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
  }
  std::vector<Alert> alerts() {
    std::vector<Alert> result;
    outbox.drain([&](const Alert& alert) { result.push_back(alert); });
    return result;
  }
  [[nodiscard]] const vehicle::State& state() const { return monitor.state(); }
  [[nodiscard]] ModeKind mode() const { return state().mode.value().kind; }
  [[nodiscard]] Phase phase() const { return state().phase.value(); }

  VehicleMonitor monitor;
  Outbox<Alert> outbox{64};
  Timestamp now{};
};

Heartbeat in_mode(std::uint32_t custom_mode) {
  auto heartbeat = copter;
  heartbeat.custom_mode = custom_mode;
  return heartbeat;
}

const Alert missed{Condition::warning, Subsystem::comms, "vehicle heartbeat lost"sv};
const Alert lost{Condition::emergency, Subsystem::comms, "vehicle heartbeat lost"sv};
const Alert regained{Condition::no_status, Subsystem::comms, "vehicle heartbeat lost"sv};

TEST(VehicleMonitor, KnowsNothingBeforeTheFirstMessage) {
  Flight flight;
  flight.wait(hours{1});
  EXPECT_THAT(flight.alerts(), IsEmpty());
  EXPECT_EQ(flight.monitor.next_deadline(), std::nullopt);
  vehicle::visit_facts([&](auto fact, std::string_view name, std::string_view, std::string_view) {
    EXPECT_FALSE((flight.state().*fact).known()) << name;
  });
}

TEST(VehicleMonitor, LearnsModePhaseAndIdentityFromTheHeartbeat) {
  Flight flight;
  flight.say(copter);
  EXPECT_EQ(flight.state().mode.value(), (vehicle::Mode{ModeKind::mission, 0, "AUTO"sv}));
  EXPECT_EQ(flight.phase(), Phase::in_flight);
  EXPECT_EQ(flight.state().identity.value(), (vehicle::Identity{MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_QUADROTOR, {}}));
}

TEST(VehicleMonitor, TellsNoModeOrPhaseBeforeTheFirstHeartbeat) {
  Flight flight;
  flight.say(MissionCount{.count = 1});
  flight.say(MissionItemInt{.command = MAV_CMD_NAV_WAYPOINT, .x = 100'000'000});
  flight.say(MissionCurrent{.seq = 0});
  flight.say(ExtendedSysState{.landed_state = MAV_LANDED_STATE_IN_AIR});
  EXPECT_TRUE(flight.state().leg);
  EXPECT_FALSE(flight.state().mode);
  EXPECT_FALSE(flight.state().phase);
}

TEST(VehicleMonitor, TellsNoModeWhileTheHeartbeatSaysThatItsNumberIsNotValid) {
  Flight flight;
  auto heartbeat = copter;
  heartbeat.base_mode = 0;
  flight.say(heartbeat);
  EXPECT_EQ(flight.state().mode.value(), vehicle::Mode{});
}

TEST(VehicleMonitor, WarnsAfterThreeSecondsWithoutHeartbeatAndCallsItLostAfterTen) {
  Flight flight;
  flight.say(copter);
  EXPECT_EQ(flight.monitor.next_deadline(), Timestamp{} + seconds{3});
  flight.wait(seconds{3} - std::chrono::nanoseconds{1});
  EXPECT_THAT(flight.alerts(), IsEmpty());
  flight.wait(std::chrono::nanoseconds{1});
  EXPECT_THAT(flight.alerts(), ElementsAre(missed));
  EXPECT_EQ(flight.mode(), ModeKind::mission);
  EXPECT_EQ(flight.monitor.next_deadline(), Timestamp{} + seconds{10});
  flight.wait(seconds{7} - std::chrono::nanoseconds{1});
  EXPECT_THAT(flight.alerts(), IsEmpty());
  flight.wait(std::chrono::nanoseconds{1});
  EXPECT_THAT(flight.alerts(), ElementsAre(lost));
  EXPECT_EQ(flight.state().mode.value(), vehicle::Mode{});
  EXPECT_EQ(flight.phase(), Phase::unknown);
  EXPECT_EQ(flight.monitor.next_deadline(), std::nullopt);
  flight.wait(hours{1});
  EXPECT_THAT(flight.alerts(), IsEmpty()) << "told once";
}

TEST(VehicleMonitor, ClearsTheAlertAndKnowsTheModeAgainWhenTheHeartbeatIsBack) {
  Flight flight;
  flight.say(copter);
  flight.wait(seconds{12});
  EXPECT_THAT(flight.alerts(), ElementsAre(missed, lost));
  flight.say(copter);
  EXPECT_THAT(flight.alerts(), ElementsAre(regained));
  EXPECT_EQ(flight.mode(), ModeKind::mission);
  EXPECT_EQ(flight.phase(), Phase::in_flight);
  flight.wait(seconds{4});
  flight.say(copter);
  EXPECT_THAT(flight.alerts(), ElementsAre(missed, regained));
}

// Telemetry goes on while heartbeats do not get through: the mode of then is not the mode of now.
TEST(VehicleMonitor, OtherMessagesDoNotBringALostModeBack) {
  Flight flight;
  flight.say(MissionCount{.count = 1});
  flight.say(MissionItemInt{.command = MAV_CMD_NAV_WAYPOINT, .x = 100'000'000});
  flight.say(copter);
  flight.wait(seconds{10});
  flight.say(MissionCurrent{.seq = 0});
  flight.say(ExtendedSysState{.landed_state = MAV_LANDED_STATE_IN_AIR});
  flight.say(HomePosition{.altitude = 1000});
  EXPECT_EQ(flight.state().mode.value(), vehicle::Mode{});
  EXPECT_EQ(flight.phase(), Phase::unknown);
}

TEST(VehicleMonitor, KeepsTheTimeOfTheConfirmationAndTheRevisionOfTheChange) {
  Flight flight;
  flight.say(copter);
  const auto revision = flight.state().revision;
  flight.wait(seconds{1});
  flight.say(copter);
  EXPECT_EQ(flight.state().mode.at(), flight.wall());
  EXPECT_FALSE(flight.state().mode.changed_since(revision));
  EXPECT_TRUE(flight.state().mode.newer_than(revision));
  flight.say(in_mode(guided));
  EXPECT_TRUE(flight.state().mode.changed_since(revision));
}

TEST(VehicleMonitor, ALandedStateOfLongAgoIsNotBelieved) {
  Flight flight;
  flight.say(ExtendedSysState{.landed_state = MAV_LANDED_STATE_ON_GROUND});
  flight.say(copter);
  EXPECT_EQ(flight.phase(), Phase::pre_launch);
  for (int second = 0; second < 16; ++second) {
    flight.wait(seconds{1});
    flight.say(copter);
  }
  EXPECT_EQ(flight.phase(), Phase::in_flight) << "the stream of EXTENDED_SYS_STATE has ended before take-off";
}

TEST(VehicleMonitor, AnItemInProgressCanMeanMoreThanTheMode) {
  const auto mode_with = [](const Heartbeat& heartbeat, std::uint16_t command) {
    Flight flight;
    flight.say(heartbeat);
    flight.say(MissionCount{.count = 2});
    flight.say(MissionItemInt{.seq = 1, .command = command});
    flight.say(MissionCurrent{.seq = 1});
    return flight.mode();
  };
  auto grounded = copter;
  grounded.base_mode = disarmed;
  auto plane = in_mode(10);
  plane.type = MAV_TYPE_FIXED_WING;
  EXPECT_EQ(mode_with(copter, MAV_CMD_NAV_TAKEOFF), ModeKind::take_off);
  EXPECT_EQ(mode_with(grounded, MAV_CMD_NAV_TAKEOFF), ModeKind::mission);
  EXPECT_EQ(mode_with(copter, MAV_CMD_NAV_LAND), ModeKind::mission);
  EXPECT_EQ(mode_with(in_mode(guided), MAV_CMD_NAV_TAKEOFF), ModeKind::guided);
  EXPECT_EQ(mode_with(plane, MAV_CMD_NAV_LAND), ModeKind::land);
  EXPECT_EQ(mode_with(plane, MAV_CMD_NAV_TAKEOFF), ModeKind::mission);
}

TEST(VehicleMonitor, TellsTheLegAndWhenItBegan) {
  Flight flight;
  flight.say(copter);
  flight.say(HomePosition{.altitude = 50'000});
  flight.station_says(MissionCount{.target_system = 1, .count = 3});
  for (std::uint16_t number = 0; number < 3; ++number)
    flight.station_says(MissionItemInt{.seq = number,
                                       .frame = MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
                                       .command = MAV_CMD_NAV_WAYPOINT,
                                       .x = 100'000'000,
                                       .z = 40});
  flight.say(MissionAck{});
  flight.wait(seconds{1});
  flight.say(MissionItemReached{.seq = 1});
  const auto reached = flight.wall();
  flight.wait(seconds{1});
  flight.say(MissionItemReached{.seq = 1});  // PX4 repeats it
  flight.say(MissionCurrent{.seq = 2});
  ASSERT_TRUE(flight.state().leg);
  const auto& leg = flight.state().leg.value();
  ASSERT_TRUE(leg.from && leg.to);
  EXPECT_EQ(leg.from->number, 1);
  EXPECT_EQ(leg.from->reached, reached);
  EXPECT_EQ(leg.to->number, 2);
  EXPECT_EQ(leg.to->altitude_msl, Metres{90});
  EXPECT_EQ(leg.to->reached, std::nullopt);
  EXPECT_EQ(leg.next, std::nullopt);

  flight.say(HomePosition{.altitude = 60'000});
  EXPECT_EQ(flight.state().leg.value().to->altitude_msl, Metres{100});

  flight.station_says(MissionClearAll{.target_system = 1});
  flight.say(MissionAck{});
  EXPECT_FALSE(flight.state().leg) << "the mission is gone";
}

TEST(VehicleMonitor, TellsTheMissionOnBoardAsLongAsThereIsOne) {
  Flight flight;
  flight.say(MissionCurrent{.mission_id = 0x12AB});
  EXPECT_EQ(flight.state().mission_id.value(), Text<19>{"000012ab"});
  flight.say(MissionCurrent{.mission_id = 0});
  EXPECT_FALSE(flight.state().mission_id);
}

TEST(VehicleMonitor, TellsTheSerialNumberOfTheHardware) {
  Flight flight;
  flight.say(AutopilotVersion{.uid = 0x0123456789ABCDEF});
  EXPECT_EQ(flight.state().identity.value().serial, Text<15>{"123456789abcdef"});
  AutopilotVersion version{};
  version.uid2 = {0x10, 0x20, 0x30};
  flight.say(version);
  EXPECT_EQ(flight.state().identity.value().serial, Text<15>{"102030000000000"sv});
  flight.say(AutopilotVersion{});
  EXPECT_EQ(flight.state().identity.value().serial, Text<15>{"102030000000000"sv})
      << "nothing is told: nothing changes";
  flight.say(copter);
  EXPECT_EQ(flight.state().identity.value(),
            (vehicle::Identity{MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_QUADROTOR, "102030000000000"sv}));
}

Condition condition(const Flight& flight, Subsystem subsystem) {
  return flight.state().subsystems[static_cast<std::size_t>(subsystem)].value();
}

TEST(VehicleMonitor, TellsTheSubsystemsFromSensorsAndSystemStatus) {
  constexpr std::uint32_t gps = 32, battery = 33554432, extended = 2147483648;
  Flight flight;
  flight.say(copter);
  for (const auto& each : flight.state().subsystems) EXPECT_FALSE(each);
  flight.say(SysStatus{.onboard_control_sensors_present = gps | battery,
                       .onboard_control_sensors_enabled = gps | battery,
                       .onboard_control_sensors_health = battery});
  EXPECT_EQ(condition(flight, Subsystem::navigation), Condition::warning);
  EXPECT_EQ(condition(flight, Subsystem::propulsion_energy), Condition::nominal);
  EXPECT_FALSE(flight.state().subsystems[static_cast<std::size_t>(Subsystem::recovery)]);

  auto failing = copter;
  failing.system_status = MAV_STATE_CRITICAL;
  flight.say(failing);
  EXPECT_EQ(condition(flight, Subsystem::vsm), Condition::warning);
  flight.say(copter);
  EXPECT_EQ(condition(flight, Subsystem::vsm), Condition::no_status) << "it was told, so it has to be taken back";

  flight.say(SysStatus{.onboard_control_sensors_present = extended,
                       .onboard_control_sensors_enabled = extended,
                       .onboard_control_sensors_present_extended = 1,
                       .onboard_control_sensors_enabled_extended = 1});
  EXPECT_EQ(condition(flight, Subsystem::recovery), Condition::warning);
  EXPECT_EQ(condition(flight, Subsystem::navigation), Condition::no_status);
}

TEST(VehicleMonitor, ReadsExtendedSensorsOnlyWhereTheyAreSaidToBe) {
  Flight flight;
  flight.say(SysStatus{.onboard_control_sensors_present_extended = 1, .onboard_control_sensors_enabled_extended = 1});
  EXPECT_FALSE(flight.state().subsystems[static_cast<std::size_t>(Subsystem::recovery)]);
}

TEST(VehicleMonitor, TellsTextsAsAlertsLateOnesToo) {
  Flight flight;
  flight.say(Statustext{.severity = 4, .text = "Battery 1 is low"sv});
  EXPECT_THAT(flight.alerts(),
              ElementsAre(Alert{Condition::caution, Subsystem::propulsion_energy, "Battery 1 is low"sv}));

  constexpr std::string_view whole = "Arming denied: Resolve system health failures firs";
  const Alert cut{Condition::warning, Subsystem::vsm, whole};
  flight.say(Statustext{.severity = 2, .text = whole, .id = 9, .chunk_seq = 0});
  EXPECT_EQ(flight.monitor.next_deadline(), flight.now + seconds{1});
  flight.wait(seconds{1});
  EXPECT_THAT(flight.alerts(), ElementsAre(cut));

  flight.say(Statustext{.severity = 2, .text = whole, .id = 10, .chunk_seq = 0});
  flight.monitor.finish(flight.outbox);
  EXPECT_THAT(flight.alerts(), ElementsAre(cut));
}

TEST(VehicleMonitor, PrefersTheBetterSourceWhateverTheClockOfTheAutopilotSays) {
  for (const auto clock_error : {hours{-5}, hours{0}, hours{5}}) {
    Flight flight;
    flight.say(copter);
    const auto gps_us = static_cast<std::uint64_t>(unix_us(flight.wall() + clock_error));
    flight.say(SystemTime{.time_unix_usec = gps_us, .time_boot_ms = 10'000});
    flight.say(PositionTargetGlobalInt{.time_boot_ms = 10'000, .coordinate_frame = MAV_FRAME_GLOBAL_INT, .yaw = 1});
    flight.say(NavControllerOutput{.nav_bearing = 90});
    EXPECT_EQ(flight.state().commanded_heading.value(), Radians{1}) << clock_error.count();
    flight.wait(seconds{2});
    flight.say(NavControllerOutput{.nav_bearing = 90});
    EXPECT_NE(flight.state().commanded_heading.value(), Radians{1}) << clock_error.count();
  }
}

TEST(VehicleMonitor, StampsEverythingByTheClockOfTheAutopilotOnceItIsKnown) {
  Flight flight;
  flight.say(Attitude{.time_boot_ms = 9'000});
  EXPECT_EQ(flight.state().roll.at(), flight.wall());
  const auto gps_time = flight.wall() + hours{5};
  flight.say(SystemTime{.time_unix_usec = static_cast<std::uint64_t>(unix_us(gps_time)), .time_boot_ms = 10'000});
  flight.say(Attitude{.time_boot_ms = 10'100});
  EXPECT_EQ(flight.state().roll.at(), gps_time + milliseconds{100});
  flight.wait(seconds{1});
  flight.say(VfrHud{.alt = 5});
  EXPECT_EQ(flight.state().barometric_altitude.at(), gps_time + seconds{1});
  flight.say(copter);
  EXPECT_EQ(flight.state().mode.at(), gps_time + seconds{1});
}

// In MAVLink 1 HOME_POSITION has no time, and without a fix GPS_RAW_INT of ArduPilot is stamped 0: seen in recordings.
TEST(VehicleMonitor, KeepsTheClockWhenMessagesWithoutTimeComeBetween) {
  Flight flight;
  const auto gps_time = flight.wall() + hours{5};
  flight.say(SystemTime{.time_unix_usec = static_cast<std::uint64_t>(unix_us(gps_time)), .time_boot_ms = 60'000});
  flight.say(HomePosition{.altitude = 1}, mavlink::Version::v1);
  flight.say(GpsRawInt{.time_usec = 0});
  flight.say(Attitude{.time_boot_ms = 60'000});
  EXPECT_EQ(flight.state().roll.at(), gps_time);
}

TEST(VehicleMonitor, ForgetsTheClockOfALostVehicleWhichMayBootInTheMeantime) {
  Flight flight;
  flight.say(copter);
  const auto gps_time = flight.wall() + hours{5};
  flight.say(SystemTime{.time_unix_usec = static_cast<std::uint64_t>(unix_us(gps_time)), .time_boot_ms = 60'000});
  flight.wait(seconds{100});
  flight.say(Attitude{.time_boot_ms = 70'000});
  EXPECT_EQ(flight.state().roll.at(), flight.wall());
}

TEST(VehicleMonitor, AUnknownValueDoesNotTakeTheKnownOneAway) {
  Flight flight;
  flight.say(BatteryStatus{.id = 0, .battery_remaining = 60});
  const auto revision = flight.state().revision;
  flight.say(BatteryStatus{.id = 0, .battery_remaining = -1});
  EXPECT_EQ(flight.state().energy_level.value(), Percent{60});
  EXPECT_FALSE(flight.state().energy_level.newer_than(revision)) << "and it is no news";
}

}  // namespace
}  // namespace ponte::autopilot
