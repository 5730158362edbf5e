#include "ponte/autopilot/link_quality.hpp"

#include "ponte/autopilot/test_station.hpp"
#include "ponte/core/random.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/radio_status.hpp"

#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using namespace std::chrono_literals;
using testing::start;

class Bench {
 public:
  void hear(Timestamp now, unsigned sequence, std::uint8_t system = 1) {
    const testing::TestFrame frame{messages::Attitude{}, mavlink::SystemId{system}, testing::autopilot_component,
                                   mavlink::Version::v2, static_cast<std::uint8_t>(sequence)};
    quality.on_message(now, frame.view());
  }
  double loss(Timestamp now) { return quality.loss(now).value_or(Percent{-1}).value; }

  LinkQuality quality{{testing::vehicle_system, testing::autopilot_component, Stack::px4}};
};

TEST(LinkQuality, CountsTheGapsInTheSequenceNumbers) {
  Bench bench;
  EXPECT_FALSE(bench.quality.loss(start));
  for (unsigned i = 0; i < 1000; ++i)
    if (i % 4 != 3) bench.hear(start + i * 5ms, i);
  EXPECT_NEAR(bench.loss(start + 5s), 25, 0.2);
  EXPECT_NEAR(bench.quality.frames_per_second(start + 5s), 75, 0.1);
}

TEST(LinkQuality, DoesNotCallLateOrRepeatedFramesLost) {
  Bench bench;
  for (const unsigned sequence : {0U, 1U, 4U, 2U, 3U, 3U, 5U, 5U}) bench.hear(start, sequence);
  EXPECT_EQ(bench.loss(start), 0);
  EXPECT_DOUBLE_EQ(bench.quality.frames_per_second(start), 0.6);
}

TEST(LinkQuality, ForgetsWhatWasBeforeTheWindow) {
  Bench bench;
  bench.hear(start, 0);
  bench.hear(start, 100);
  for (unsigned i = 0; i < 100; ++i) bench.hear(start + 11s, 101 + i);
  EXPECT_EQ(bench.loss(start + 11s), 0);
  EXPECT_FALSE(bench.quality.loss(start + 1h)) << "nothing has come";
}

TEST(LinkQuality, CountsOneSenderOnlyAndNoStartAnewOfIt) {
  Bench bench;
  bench.hear(start, 0);
  bench.hear(start, 200, 2);
  bench.hear(start, 1);
  bench.quality.on_reboot();
  bench.hear(start, 150);
  bench.hear(start, 151);
  EXPECT_EQ(bench.loss(start), 0);
}

TEST(LinkQuality, IsRightForRandomLosses) {
  Random random{1};
  for (const double chance : {0.02, 0.1, 0.3}) {
    Bench bench;
    for (unsigned i = 0; i < 4000; ++i)
      if (!random.chance(chance)) bench.hear(start + i * 2ms, i);
    EXPECT_NEAR(bench.loss(start + 8s), 100 * chance, 2);
  }
}

TEST(LinkQuality, KnowsWhatARadioSaysOfBothEnds) {
  Bench bench;
  const testing::TestFrame frame{
      messages::RadioStatus{.rssi = 120, .remrssi = 90, .txbuf = 100, .noise = 50, .remnoise = 60, .rxerrors = 3},
      mavlink::SystemId{51}, mavlink::ComponentId{68}};
  bench.quality.on_message(start, frame.view());
  const auto radio = bench.quality.radio(start + 5s);
  ASSERT_TRUE(radio);
  EXPECT_EQ(radio->margin(), 30);
  EXPECT_EQ(radio->receive_errors, 3);
  EXPECT_FALSE(bench.quality.radio(start + 11s));

  const testing::TestFrame partly{messages::RadioStatus{.rssi = 120, .remrssi = 255, .noise = 50, .remnoise = 60},
                                  mavlink::SystemId{51}, mavlink::ComponentId{68}};
  bench.quality.on_message(start, partly.view());
  EXPECT_FALSE(bench.quality.radio(start)->remote_signal);
  EXPECT_FALSE(bench.quality.radio(start)->margin());
}

}  // namespace
}  // namespace ponte::autopilot
