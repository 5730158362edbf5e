#include "ponte/dli/time.hpp"

#include <gtest/gtest.h>

namespace ponte::dli {
namespace {

using namespace std::chrono;
using namespace std::chrono_literals;

constexpr WallTime noon_of_the_worked_example{sys_days{2016y / February / 14} + 12h};
constexpr WallTime wrap{dli_epoch + milliseconds{1099511627776}};

TEST(TimeStamp, CountsMillisecondsSince2000) {
  EXPECT_EQ(time_stamp_from(dli_epoch), 0U);
  EXPECT_EQ(unix_ms(dli_epoch), 946684800000);
  EXPECT_EQ(time_stamp_from(noon_of_the_worked_example), 0x7674D72E00U);
  EXPECT_EQ(time_stamp_from(dli_epoch + 1999us), 1U);
}

TEST(TimeStamp, IsRefusedBefore2000) {
  EXPECT_EQ(time_stamp_from(dli_epoch - 1us), std::nullopt);
  EXPECT_EQ(time_stamp_from(WallTime{}), std::nullopt);
}

TEST(TimeStamp, BeginsAgainAt0InNovember2034) {
  EXPECT_EQ(floor<days>(wrap), sys_days{2034y / November / 3});
  EXPECT_EQ(time_stamp_from(wrap - 1ms), 0xFFFFFFFFFFU);
  EXPECT_EQ(time_stamp_from(wrap), 0U);
  EXPECT_EQ(time_stamp_from(wrap + 5ms), 5U);
}

TEST(WallTimeFromStamp, IsTheTimeNearestToThePresent) {
  const auto now = noon_of_the_worked_example;
  EXPECT_EQ(wall_time_from(0x7674D72E00, now), now);
  EXPECT_EQ(wall_time_from(0, now), dli_epoch);
  EXPECT_EQ(wall_time_from(0xFFFFFFFFFF, WallTime{sys_days{2034y / January / 1}}), wrap - 1ms);
  EXPECT_EQ(wall_time_from(0xFFFFFFFFFF, wrap + 1s), wrap - 1ms) << "sent before the wrap, received behind it";
  EXPECT_EQ(wall_time_from(3, wrap - 1s), wrap + 3ms) << "from a sender whose clock is ahead";
  EXPECT_EQ(wall_time_from(3, wrap + 1s), wrap + 3ms);
  EXPECT_EQ(wall_time_from((std::uint64_t{1} << 40U) + 3, dli_epoch), dli_epoch + 3ms) << "only 40 bits count";
}

TEST(WallTimeFromStamp, IsNeverBefore2000) {
  EXPECT_EQ(wall_time_from(0xFFFFFFFFFF, dli_epoch), wrap - 1ms);
  EXPECT_EQ(wall_time_from(7, WallTime{}), dli_epoch + 7ms);
}

TEST(WallTimeFromStamp, ReturnsEveryTimeToTheMillisecond) {
  for (auto time = dli_epoch; time < WallTime{sys_days{2080y / January / 1}}; time += 31h + 7ms)
    ASSERT_EQ(wall_time_from(*time_stamp_from(time), time + 100h), time);
}

}  // namespace
}  // namespace ponte::dli
