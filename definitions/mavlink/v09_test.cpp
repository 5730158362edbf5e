#include "ponte/core/hex.hpp"
#include "ponte/core/random.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/field_value.hpp"
#include "ponte/mavlink/route_filter.hpp"
#include "ponte/mavlink/v09/all.hpp"
#include "ponte/mavlink/v09/dialect.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <vector>

namespace ponte::mavlink::v09 {
namespace {

using Buffer = std::vector<std::byte>;

template <Message M>
Buffer encoded(const M& message, std::uint8_t sequence) {
  std::array<std::byte, max_frame_size> out{};
  const auto size = encode(
      message,
      {.version = Version::v0_9, .system = SystemId{1}, .component = ComponentId{1}, .sequence = sequence}, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size.value())};
}

/// What the C headers of 2011 make of these messages of one sender, in this order (the team's notes on MAVLink, 1.4).
template <Message M>
void expect_golden(const M& message, std::uint8_t sequence, std::string_view hex) {
  const auto golden = bytes(hex);
  EXPECT_EQ(to_hex(encoded(message, sequence)), to_hex(golden)) << M::info.name;
  const auto frame = parse_frame(golden);
  ASSERT_TRUE(frame.has_value()) << M::info.name;
  EXPECT_EQ(dialect.find(frame->message), &M::info);
  EXPECT_EQ(decode<M>(*frame), message) << M::info.name;
}

TEST(MavlinkV09, GoldenFrames) {
  expect_golden(Heartbeat{.type = MAV_QUADROTOR, .autopilot = MAV_AUTOPILOT_ARDUPILOTMEGA}, 0,
                "55 03 00 01 01 00  02 03 02  f1 45");
  expect_golden(Attitude{.usec = 1'000'000,
                         .roll = 0.1F,
                         .pitch = 0.2F,
                         .yaw = 0.3F,
                         .rollspeed = 0.01F,
                         .pitchspeed = 0.02F,
                         .yawspeed = 0.03F},
                1,
                "55 20 01 01 01 1e  00 00 00 00 00 0f 42 40  3d cc cc cd  3e 4c cc cd  3e 99 99 9a  3c 23 d7 0a  "
                "3c a3 d7 0a  3c f5 c2 8f  24 c6");
  expect_golden(Waypoint{.target_system = 1,
                         .target_component = 1,
                         .seq = 3,
                         .frame = 0,
                         .command = 16,
                         .current = 0,
                         .autocontinue = 1,
                         .x = 47.5F,
                         .y = 8.5F,
                         .z = 100},
                2,
                "55 24 02 01 01 27  01 01 00 03 00 10 00 01  00 00 00 00  00 00 00 00  00 00 00 00  00 00 00 00  "
                "42 3e 00 00  41 08 00 00  42 c8 00 00  42 50");
  expect_golden(SysStatus{.mode = MAV_MODE_LOCKED,
                          .nav_mode = MAV_NAV_HOLD,
                          .status = MAV_STATE_STANDBY,
                          .load = 400,
                          .vbat = 11100,
                          .battery_remaining = 900,
                          .packet_drop = 5},
                3, "55 0b 03 01 01 22  01 02 03  01 90  2b 5c  03 84  00 05  c8 ce");
  expect_golden(
      ParamValue{
          .param_id = std::string_view{"RATE_RLL_P"}, .param_value = 0.15F, .param_count = 200, .param_index = 3},
      4, "55 17 04 01 01 16  52 41 54 45 5f 52 4c 4c 5f 50 00 00 00 00 00  3e 19 99 9a  00 c8  00 03  2a c6");
}

TEST(MavlinkV09, EveryMessageOfTheClassDocumentationAndOneMore) {
  std::set<std::uint32_t> ids;
  for (const auto* message : dialect.messages) ids.insert(message->id.value);
  EXPECT_EQ(ids.size(), 70U);
  EXPECT_EQ(dialect.messages.size(), 71U) << "OPTICAL_FLOW has two layouts";
}

TEST(MavlinkV09, EveryMessageComesBackAsItWas) {
  Random random{9};
  std::size_t count = 0;
  for_each_message([&]<class M>() {
    ++count;
    for (int round = 0; round < 20; ++round) {
      Buffer payload(M::info.full_length);
      random.fill(payload);
      const auto frame = encoded(decode<M>(payload), 7);
      const auto view = parse_frame(frame);
      ASSERT_TRUE(view.has_value()) << M::info.name;
      EXPECT_EQ(to_hex(view->payload), to_hex(payload)) << M::info.name;
      EXPECT_TRUE(carries<M>(*view)) << M::info.name;
    }
  });
  EXPECT_EQ(count, dialect.messages.size());
}

TEST(MavlinkV09, FieldsAreReadByNameAsByType) {
  const auto frame = encoded(GpsRawInt{.usec = 5, .fix_type = 3, .lat = -387'000'000, .hdg = 270.5F}, 0);
  const auto view = parse_frame(frame);
  ASSERT_TRUE(view.has_value());
  const auto value = [&](std::size_t field) { return read_element(GpsRawInt::fields[field], view->payload); };
  EXPECT_EQ(value(0), FieldValue{std::uint64_t{5}});
  EXPECT_EQ(value(2), FieldValue{std::int64_t{-387'000'000}});
  EXPECT_EQ(value(8), FieldValue{270.5F});
}

TEST(MavlinkV09, BothLayoutsOfOpticalFlow) {
  const Dialect both{"both", {}, &dialect};
  const auto shorter = encoded(OpticalFlowShort{.time = 1, .flow_x = 2, .flow_y = 3, .quality = 4}, 0);
  const auto longer = encoded(OpticalFlow{.time = 1, .sensor_id = 2, .flow_x = -3, .flow_y = 4, .quality = 5}, 0);
  EXPECT_EQ(shorter.size(), 8U + 15U);
  EXPECT_EQ(longer.size(), 8U + 18U);
  EXPECT_EQ(find_message(both, *parse_frame(shorter)), &OpticalFlowShort::info);
  EXPECT_EQ(find_message(both, *parse_frame(longer)), &OpticalFlow::info);
}

TEST(MavlinkV09, WhatSetsUpOrRebootsAVehicleIsRiskyForARouter) {
  std::set<std::string_view> risky;
  for (const auto& action : enum_info::MAV_ACTION.entries) {
    const auto frame = encoded(Action{.target = 1, .action = static_cast<std::uint8_t>(action.value)}, 0);
    if (is_risky(*parse_frame(frame))) risky.insert(action.name);
  }
  EXPECT_EQ(risky, (std::set<std::string_view>{"MAV_ACTION_SHUTDOWN", "MAV_ACTION_REBOOT", "MAV_ACTION_STORAGE_READ",
                                               "MAV_ACTION_STORAGE_WRITE", "MAV_ACTION_CALIBRATE_RC",
                                               "MAV_ACTION_CALIBRATE_GYRO", "MAV_ACTION_CALIBRATE_MAG",
                                               "MAV_ACTION_CALIBRATE_ACC", "MAV_ACTION_CALIBRATE_PRESSURE"}));
}

/// Whatever their payload, and although SERIAL_CONTROL, COMMAND_LONG and the like have their ids in later versions.
TEST(MavlinkV09, NothingButActionAndPreflightCommandsIsRiskyForARouter) {
  for (unsigned id = 0; id <= 255; ++id) {
    if (id == Action::info.id.value) continue;
    for (unsigned value = 0; value <= 255; ++value) {
      const Buffer payload(Command::info.full_length, static_cast<std::byte>(value));
      const FrameView frame{.version = Version::v0_9, .message = MessageId{id}, .payload = payload};
      const bool is_preflight = id == Command::info.id.value && value >= 241 && value <= 246;
      ASSERT_EQ(is_risky(frame), is_preflight) << id << " " << value;
    }
  }
}

}  // namespace
}  // namespace ponte::mavlink::v09
