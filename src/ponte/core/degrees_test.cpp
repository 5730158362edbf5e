#include "ponte/core/degrees.hpp"

#include "ponte/core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte {
namespace {

TEST(DegreesFromRadians, GivesBackWhatAFileSays) {
  for (const double degrees :
       {0.0, 47.397742, -122.3894, 8.545594, -30.06898, 180.0, -180.0, 90.0, 1e-7, 151.2069000001})
    EXPECT_EQ(degrees_from_radians(radians_from_degrees(degrees)), degrees);
}

TEST(DegreesFromRadians, GivesBackEveryDegE7) {
  Random random{20160701};
  for (int i = 0; i < 20'000; ++i) {
    const double degrees = (static_cast<double>(random.below(3'600'000'001)) - 1.8e9) / 1e7;
    ASSERT_EQ(degrees_from_radians(radians_from_degrees(degrees)), degrees);
  }
}

TEST(DegreesFromRadians, GivesBackTheAngleOfAnyDegrees) {
  Random random{2016};
  for (int i = 0; i < 100'000; ++i) {
    const auto angle = radians_from_degrees((random.unit() - 0.5) * 360);
    ASSERT_EQ(radians_from_degrees(degrees_from_radians(angle)), angle);
  }
}

TEST(DegreesFromRadians, IsWithinOneStepOfTheAngleForAnyAngle) {
  Random random{4586};
  for (int i = 0; i < 20'000; ++i) {
    const Radians angle{(random.unit() - 0.5) * 6.2};
    const auto again = radians_from_degrees(degrees_from_radians(angle));
    ASSERT_LE(std::abs(again.value - angle.value), std::abs(angle.value) * std::numeric_limits<double>::epsilon());
  }
}

TEST(DegreesFromRadians, PassesOnWhatIsNoNumber) {
  EXPECT_TRUE(std::isnan(degrees_from_radians(Radians{std::nan("")})));
  EXPECT_TRUE(std::isinf(degrees_from_radians(Radians{std::numeric_limits<double>::infinity()})));
}

}  // namespace
}  // namespace ponte
