#include "ponte/vsm/series.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace ponte::vsm {
namespace {

TEST(Summarise, GivesTheFiguresOfASmallSeries) {
  const auto summary = summarise(std::array{4.0, 2.0, 9.0, 5.0});
  EXPECT_EQ(summary.count, 4U);
  EXPECT_DOUBLE_EQ(summary.mean, 5.0);
  EXPECT_DOUBLE_EQ(summary.median, 4.5);
  EXPECT_DOUBLE_EQ(summary.min, 2.0);
  EXPECT_DOUBLE_EQ(summary.max, 9.0);
  EXPECT_DOUBLE_EQ(summary.peak_to_peak(), 7.0);
  // Deviations -1, -3, 4, 0: squares 26, over 3.
  EXPECT_DOUBLE_EQ(summary.standard_deviation, std::sqrt(26.0 / 3));
  // Sample numbers less their mean: -1.5, -0.5, 0.5, 1.5: products 1.5 + 1.5 + 2 + 0 = 5, squares 5.
  EXPECT_DOUBLE_EQ(summary.slope, 1.0);
  EXPECT_DOUBLE_EQ(summary.intercept, 2.5);
}

TEST(Summarise, FindsTheLineThatAllPointsAreOn) {
  const auto summary = summarise(std::array{7.0, 4.0, 1.0, -2.0, -5.0});
  EXPECT_DOUBLE_EQ(summary.slope, -3.0);
  EXPECT_DOUBLE_EQ(summary.intercept, 10.0);
}

TEST(Summarise, InterpolatesPercentiles) {
  std::vector<double> hundred_and_one;
  for (int i = 100; i >= 0; --i) hundred_and_one.push_back(i);
  const auto exact = summarise(hundred_and_one);
  EXPECT_DOUBLE_EQ(exact.p95, 95.0);
  EXPECT_DOUBLE_EQ(exact.p99, 99.0);
  const auto between = summarise(std::array{10.0, 20.0, 30.0});
  EXPECT_DOUBLE_EQ(between.p95, 29.0);
  EXPECT_DOUBLE_EQ(between.p99, 29.8);
}

TEST(Summarise, ASingleValueHasNeitherSpreadNorTrend) {
  const auto summary = summarise(std::array{3.0});
  EXPECT_EQ(summary.mean, 3.0);
  EXPECT_EQ(summary.p99, 3.0);
  EXPECT_EQ(summary.standard_deviation, 0.0);
  EXPECT_EQ(summary.slope, 0.0);
  EXPECT_EQ(summary.intercept, 3.0);
}

TEST(Summarise, EqualValuesHaveNoSpread) {
  const auto summary = summarise(std::array{2.0, 2.0, 2.0});
  EXPECT_EQ(summary.standard_deviation, 0.0);
  EXPECT_EQ(summary.slope, 0.0);
}

TEST(Quantile, ReachesBothEnds) {
  const std::array ascending{1.0, 2.0, 4.0};
  EXPECT_EQ(quantile(ascending, 0), 1.0);
  EXPECT_EQ(quantile(ascending, 1), 4.0);
}

}  // namespace
}  // namespace ponte::vsm
