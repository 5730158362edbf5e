#include "ponte/sim/wind.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ponte::sim {
namespace {

TEST(Wind, GoesWhereItDoesNotComeFrom) {
  Wind wind{{.speed = MetresPerSecond{8}, .from = radians_from_degrees(270)}, 1};
  for (int i = 0; i < 100; ++i) {
    const auto air = wind.step();
    EXPECT_NEAR(air.north, 0, 1e-12);
    EXPECT_NEAR(air.east, 8, 1e-12);
    EXPECT_EQ(air.down, 0);
  }
}

TEST(Wind, GustsHaveTheirDeviationAndNoBias) {
  Wind wind{{.speed = MetresPerSecond{10}, .from = Radians{}, .gusts = 0.2}, 7};
  constexpr int steps = 500'000;  // nearly three hours: three thousand gusts
  NorthEastDown sum{};
  double squares{};
  double changes{};
  NorthEastDown before{-10, 0, 0};
  for (int i = 0; i < steps; ++i) {
    const auto air = wind.step();
    sum = sum + air;
    squares += (air.north + 10) * (air.north + 10);
    changes = std::max(changes, std::abs(air.north - before.north));
    before = air;
  }
  EXPECT_NEAR(sum.north / steps, -10, 0.15);
  EXPECT_NEAR(sum.east / steps, 0, 0.15);
  EXPECT_NEAR(std::sqrt(squares / steps), 2, 0.1);
  EXPECT_LT(changes, 0.9) << "gusts do not jump";
}

TEST(Wind, IsTheSameForTheSameSeed) {
  const WindConfig config{.speed = MetresPerSecond{5}, .from = Radians{1}, .gusts = 0.3};
  Wind a{config, 3};
  Wind b{config, 3};
  Wind other{config, 4};
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const auto air = a.step();
    EXPECT_EQ(air, b.step());
    differs |= air != other.step();
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace ponte::sim
