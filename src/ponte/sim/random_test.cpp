#include "ponte/sim/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ponte::sim {
namespace {

// The first numbers of the reference implementation of SplitMix64 with the seed 1234567.
static_assert(random_bits(1234567, 0) == 6457827717110365317U);
static_assert(random_bits(1234567, 1) == 3203168211198807973U);
static_assert(random_bits(1234567, 4) == 16408922859458223821U);

TEST(RandomNormal, HasMeanZeroAndDeviationOne) {
  constexpr int draws = 100'000;
  double sum{};
  double squares{};
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    const double value = random_normal(7, draw);
    EXPECT_LT(std::abs(value), 3.5);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / draws, 0, 0.01);
  EXPECT_NEAR(squares / draws, 1, 0.02);
}

TEST(RandomNormal, DependsOnSeedAndDraw) {
  EXPECT_EQ(random_normal(1, 2), random_normal(1, 2));
  EXPECT_NE(random_normal(1, 2), random_normal(1, 3));
  EXPECT_NE(random_normal(1, 2), random_normal(2, 2));
}

}  // namespace
}  // namespace ponte::sim
