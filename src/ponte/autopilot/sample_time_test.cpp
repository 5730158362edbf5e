#include "ponte/autopilot/sample_time.hpp"

#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr WallTime received = wall_time_from_unix_us(1'700'000'000'000'000);
/// The autopilot's clock is an hour behind that of the receiver, and it booted 100 s ago.
constexpr std::uint64_t gps_us = 1'699'996'400'000'000;
constexpr WallTime gps_time = received - hours{1};
constexpr std::uint32_t boot_ms = 100'000;

SampleClock clock_with_gps_time() {
  SampleClock clock;
  clock.on_system_time(gps_us, boot_ms, received);
  return clock;
}

TEST(SampleClock, TakesTheTimeOfReceptionUntilItKnowsBetter) {
  SampleClock clock;
  EXPECT_EQ(clock.from_boot_ms(boot_ms, received), received);
  EXPECT_EQ(clock.from_usec(boot_ms * 1000ULL, received), received);
  EXPECT_EQ(clock.from_reception(received), received);
}

TEST(SampleClock, TurnsTimesSinceBootIntoCalendarTime) {
  auto clock = clock_with_gps_time();
  EXPECT_EQ(clock.from_boot_ms(boot_ms, received), gps_time);
  EXPECT_EQ(clock.from_boot_ms(boot_ms + 250, received), gps_time + milliseconds{250});
  EXPECT_EQ(clock.from_usec((boot_ms + 250) * 1000ULL, received), gps_time + milliseconds{250});
}

TEST(SampleClock, PutsMessagesWithoutStampOnTheSameClock) {
  const auto clock = clock_with_gps_time();
  EXPECT_EQ(clock.from_reception(received), gps_time);
  EXPECT_EQ(clock.from_reception(received + seconds{3}), gps_time + seconds{3});
}

TEST(SampleClock, LeavesCalendarTimesAsTheyAre) {
  constexpr std::uint64_t utc_us = 1'600'000'000'123'456;
  EXPECT_EQ(SampleClock{}.from_usec(utc_us, received), wall_time_from_unix_us(utc_us));
  EXPECT_EQ(clock_with_gps_time().from_usec(utc_us, received), wall_time_from_unix_us(utc_us));
}

TEST(SampleClock, DoesNotBelieveAnAutopilotWithoutGpsTime) {
  for (const std::uint64_t no_time : {std::uint64_t{0}, std::uint64_t{5'000'000}, std::uint64_t{946'684'799'999'999},
                                      std::uint64_t{4'102'444'800'000'000}, UINT64_MAX}) {
    SampleClock clock;
    clock.on_system_time(no_time, boot_ms, received);
    EXPECT_EQ(clock.from_boot_ms(boot_ms, received), received) << no_time;
    EXPECT_EQ(clock.from_usec(UINT64_MAX, received), received);
  }
}

TEST(SampleClock, FallsBackToReceptionWhenTheGpsTimeGoes) {
  auto clock = clock_with_gps_time();
  clock.on_system_time(0, boot_ms + 1000, received + seconds{1});
  EXPECT_EQ(clock.from_boot_ms(boot_ms + 1000, received + seconds{1}), received + seconds{1});
  EXPECT_EQ(clock.from_reception(received), received);
}

TEST(SampleClock, ForgetsTheCalendarWhenTheAutopilotBootsAgain) {
  auto clock = clock_with_gps_time();
  EXPECT_EQ(clock.from_boot_ms(400, received + seconds{2}), received + seconds{2});
  EXPECT_EQ(clock.from_boot_ms(90'000, received + seconds{92}), received + seconds{92}) << "old offset used again";
  clock.on_system_time(gps_us + 100'000'000, 95'000, received + seconds{97});
  EXPECT_EQ(clock.from_boot_ms(95'000, received + seconds{97}), gps_time + seconds{100});
}

TEST(SampleClock, ForgetsTheCalendarWhenTheMillisecondsBeginAnew) {
  SampleClock clock;
  clock.on_system_time(gps_us, 4'294'967'290, received);
  EXPECT_EQ(clock.from_boot_ms(4'294'967'295, received), gps_time + milliseconds{5});
  EXPECT_EQ(clock.from_boot_ms(4, received + milliseconds{10}), received + milliseconds{10});
}

TEST(SampleClock, TakesOvertakenMessagesForNoReboot) {
  auto clock = clock_with_gps_time();
  EXPECT_EQ(clock.from_boot_ms(boot_ms - 1000, received), gps_time - seconds{1});
  EXPECT_EQ(clock.from_boot_ms(boot_ms, received), gps_time);
}

// GPS_RAW_INT of ArduPilot without a fix and HOME_POSITION in MAVLink 1 are stamped 0, HOME_POSITION of PX4 with the
// time when home was set, AOA_SSA of ArduPilot with 32 bits of microseconds: seen in recordings.
TEST(SampleClock, TakesUselessStampsForNoReboot) {
  auto clock = clock_with_gps_time();
  for (const std::uint64_t useless : {0ULL, 1ULL, 4'388'000ULL, 98'999'000ULL}) {
    EXPECT_EQ(clock.from_usec(useless, received + seconds{1}), gps_time + seconds{1}) << useless;
    EXPECT_EQ(clock.from_boot_ms(boot_ms + 1000, received + seconds{1}), gps_time + seconds{1}) << useless;
  }
}

}  // namespace
}  // namespace ponte::autopilot
