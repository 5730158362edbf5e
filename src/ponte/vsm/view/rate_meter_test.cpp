#include "ponte/vsm/view/rate_meter.hpp"

#include <gtest/gtest.h>

namespace ponte::vsm::view {
namespace {

using namespace std::chrono_literals;

TEST(RateMeter, TellsTheRateOfTheLastSeconds) {
  RateMeter meter;
  Timestamp now{};
  EXPECT_EQ(meter.hz(now), 0);
  for (int i = 0; i < 100; ++i) meter.on_message(now += 100ms);
  EXPECT_NEAR(meter.hz(now), 10, 0.01);
  for (int i = 0; i < 100; ++i) meter.on_message(now += 20ms);
  EXPECT_GT(meter.hz(now), 10) << "it looks back on slow and fast times";
  EXPECT_LT(meter.hz(now), 50);
  for (int i = 0; i < 300; ++i) meter.on_message(now += 20ms);
  EXPECT_NEAR(meter.hz(now), 50, 0.5);
  EXPECT_EQ(meter.count(), 500U);
}

TEST(RateMeter, FallsToZeroInASilence) {
  RateMeter meter;
  Timestamp now{};
  for (int i = 0; i < 100; ++i) meter.on_message(now += 100ms);
  EXPECT_LT(meter.hz(now + 2s), 10);
  EXPECT_GT(meter.hz(now + 2s), 0);
  EXPECT_FALSE(meter.is_silent(now + 2 * RateMeter::span - 1ns));
  EXPECT_TRUE(meter.is_silent(now + 2 * RateMeter::span));
  EXPECT_EQ(meter.hz(now + 2 * RateMeter::span), 0);
}

}  // namespace
}  // namespace ponte::vsm::view
