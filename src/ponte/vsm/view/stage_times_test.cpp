#include "ponte/vsm/view/stage_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace ponte::vsm::view {
namespace {

using namespace std::chrono_literals;

TEST(Histogram, HasNothingAtFirst) {
  const Histogram empty;
  EXPECT_EQ(empty.count(), 0U);
  EXPECT_EQ(empty.max_ns(), 0U);
  EXPECT_EQ(empty.percentile_ns(0.99), 0U);
}

TEST(Histogram, PercentilesAreExactToSevenPerCentAndNeverTooShort) {
  Histogram times;
  for (int us = 1; us <= 1000; ++us) times.add(std::chrono::microseconds{us});
  for (const auto& [share, exact_ns] : {std::pair{0.5, 500'000.0}, {0.95, 950'000.0}, {0.99, 990'000.0}}) {
    const auto found = static_cast<double>(times.percentile_ns(share));
    EXPECT_GE(found, exact_ns) << share;
    EXPECT_LE(found, exact_ns * 1.07) << share;
  }
  EXPECT_EQ(times.percentile_ns(1), 1'000'000U);
  EXPECT_EQ(times.max_ns(), 1'000'000U);
}

TEST(Histogram, EveryDurationHasABucket) {
  Histogram times;
  times.add(-5ns);
  times.add(1us);  // a bound belongs to its bucket
  times.add(1us + 1ns);
  times.add(5s);
  times.add(5s + 1ns);
  times.add(Duration::max());
  const auto& buckets = times.buckets();
  EXPECT_EQ(buckets[0], 2U);
  EXPECT_EQ(buckets[1], 1U);
  EXPECT_EQ(buckets[Histogram::bounds_ns.size() - 1], 1U);
  EXPECT_EQ(buckets.back(), 2U);
  EXPECT_EQ(std::accumulate(buckets.begin(), buckets.end(), std::uint64_t{}), times.count());
  EXPECT_EQ(times.percentile_ns(1), static_cast<std::uint64_t>(Duration::max().count()));
}

TEST(Histogram, BoundsAscendFromAMicrosecondToFiveSeconds) {
  EXPECT_EQ(Histogram::bounds_ns.front(), 1000U);
  EXPECT_EQ(Histogram::bounds_ns.back(), 5'000'000'000U);
  EXPECT_TRUE(std::ranges::is_sorted(Histogram::bounds_ns));
}

}  // namespace
}  // namespace ponte::vsm::view
