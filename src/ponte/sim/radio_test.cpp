#include "ponte/mavlink/autopilots/radio_status.hpp"
#include "ponte/sim/vehicle.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ponte::sim {
namespace {

using mavlink::autopilots::RadioStatus;
using std::chrono::seconds;

/// What the radio says while so much time goes by.
std::vector<RadioStatus> reports(Vehicle& vehicle, seconds from, seconds to) {
  std::vector<RadioStatus> result;
  Outbox<mavlink::FrameBuffer> out{Vehicle::frames_per_step};
  for (Timestamp now{from}; now <= Timestamp{to}; now += Airframe::step_length) {
    vehicle.on_tick(now, out);
    out.drain([&](const mavlink::FrameBuffer& buffer) {
      const auto frame = mavlink::parse_frame(buffer.bytes());
      if (!mavlink::carries<RadioStatus>(*frame)) return;
      EXPECT_EQ(frame->system.value, 51);
      EXPECT_EQ(frame->component.value, 68);
      result.push_back(mavlink::decode<RadioStatus>(*frame));
    });
  }
  return result;
}

TEST(Radio, ReportsOnceASecondAndHearsNoiseAloneOutOfReach) {
  Vehicle vehicle{{.faults = {{FaultKind::link_loss, seconds{10}, {}}}, .radio = true}};
  const auto near = reports(vehicle, seconds{0}, seconds{9});
  ASSERT_EQ(near.size(), 9U);
  EXPECT_EQ(near.back().rssi, 219) << "20 dBm less 31.7 at one metre";
  EXPECT_EQ(near.back().remrssi, near.back().rssi);
  const auto lost = reports(vehicle, seconds{11}, seconds{13});
  ASSERT_FALSE(lost.empty());
  EXPECT_EQ(lost.back().rssi, lost.back().noise);
  EXPECT_EQ(lost.back().remrssi, 0);
}

TEST(Radio, HearsLessFromFarAway) {
  Radio radio{mavlink::Version::v2};
  Outbox<mavlink::FrameBuffer> out{8};
  const auto strength = [&](double metres) {
    std::uint8_t rssi{};
    radio.report(Metres{metres}, true, out);
    out.drain([&](const mavlink::FrameBuffer& frame) {
      rssi = mavlink::decode<RadioStatus>(*mavlink::parse_frame(frame.bytes())).rssi;
    });
    return rssi;
  };
  EXPECT_EQ(strength(100), 143);
  EXPECT_EQ(strength(1000), 105);
  EXPECT_EQ(strength(1e9), 38) << "noise";
}

TEST(Radio, IsSilentInMavlink09) {
  Radio radio{mavlink::Version::v0_9};
  Outbox<mavlink::FrameBuffer> out{8};
  radio.report(Metres{1}, true, out);
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace ponte::sim
