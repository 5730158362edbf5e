#include "ponte/dli/scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ponte::dli {
namespace {

using std::numbers::pi;

constexpr auto infinity = std::numeric_limits<double>::infinity();
constexpr auto nan = std::numeric_limits<double>::quiet_NaN();

std::int32_t bam_from_degrees(double degrees, std::uint8_t width) {
  return bam_from_radians(degrees * (pi / 180), width).value();
}

TEST(Bam, HasTheWorkedValues) {
  EXPECT_EQ(bam_from_degrees(10, 2), 0x071C);
  EXPECT_EQ(bam_from_degrees(-5, 2), -910);
  EXPECT_EQ(bam_from_degrees(90, 2), 0x4000);
  EXPECT_EQ(bam_from_degrees(-2.5, 2), -455);
  EXPECT_EQ(bam_from_degrees(38.7223, 4), 0x1B892DFA);
  EXPECT_EQ(bam_from_degrees(-9.1393, 4), -109036096);
}

TEST(Bam, WrapsAtHalfATurnInEveryWidth) {
  for (std::uint8_t width = 1; width <= 4; ++width) {
    const auto least = static_cast<std::int32_t>(-(std::int64_t{1} << (8U * width - 1U)));
    EXPECT_EQ(bam_from_radians(pi, width), least) << int{width};
    EXPECT_EQ(bam_from_radians(-pi, width), least) << int{width};
    EXPECT_EQ(bam_from_radians(3 * pi, width), least) << int{width};
    EXPECT_EQ(bam_from_radians(pi - bam_scale(width), width), -(least + 1)) << int{width};
    EXPECT_EQ(bam_from_radians(pi + bam_scale(width), width), least + 1) << int{width};
    EXPECT_EQ(bam_from_radians(pi - 0.4 * bam_scale(width), width), least) << "rounds up to half a turn";
    EXPECT_EQ(bam_from_radians(2 * pi, width), 0) << int{width};
    EXPECT_EQ(bam_from_radians(-0.4 * bam_scale(width), width), 0) << int{width};
    EXPECT_EQ(bam_from_radians(-0.6 * bam_scale(width), width), -1) << int{width};
    EXPECT_DOUBLE_EQ(radians_from_bam(least, width), -pi);
    EXPECT_LT(radians_from_bam(-(least + 1), width), pi);
  }
  EXPECT_EQ(bam_from_degrees(270, 2), -0x4000);
  EXPECT_EQ(bam_from_degrees(-270, 2), 0x4000);
}

TEST(Bam, RefusesWhatIsNoAngle) {
  for (const auto value : {nan, infinity, -infinity})
    EXPECT_EQ(bam_from_radians(value, 2), fail(ScaleError::not_a_number));
}

TEST(Bam, WrapsEvenTheLargestAngle) {
  EXPECT_TRUE(bam_from_radians(std::numeric_limits<double>::max(), 4));
  EXPECT_TRUE(bam_from_radians(-1e300, 1));
}

TEST(Bam, KeepsEveryRawValueThroughRadians) {
  for (std::int32_t raw = -128; raw < 128; ++raw) ASSERT_EQ(bam_from_radians(radians_from_bam(raw, 1), 1), raw);
  for (std::int32_t raw = -32768; raw < 32768; ++raw) ASSERT_EQ(bam_from_radians(radians_from_bam(raw, 2), 2), raw);
  for (std::int32_t raw = -8388608; raw < 8388608; raw += 97)
    ASSERT_EQ(bam_from_radians(radians_from_bam(raw, 3), 3), raw);
  for (std::int64_t raw = -2147483648; raw < 2147483648; raw += 99991) {
    const auto value = static_cast<std::int32_t>(raw);
    ASSERT_EQ(bam_from_radians(radians_from_bam(value, 4), 4), value);
  }
}

TEST(Scaled, RoundsToTheNearestAndHalvesAwayFromZero) {
  const auto range = signed_range(2);
  EXPECT_EQ(scaled_from(0.1, 0.005, range), (Scaled{20, false}));
  EXPECT_EQ(scaled_from(120.5, 0.02, signed_range(3)), (Scaled{0x1789, false}));
  EXPECT_EQ(scaled_from(12.3, 0.05, range), (Scaled{0xF6, false}));
  EXPECT_EQ(scaled_from(314.159265, 0.5, unsigned_range(2)), (Scaled{628, false}));
  EXPECT_EQ(scaled_from(50, 0.0016, unsigned_range(2)), (Scaled{31250, false}));
  EXPECT_EQ(scaled_from(2.5, 1, range), (Scaled{3, false}));
  EXPECT_EQ(scaled_from(-2.5, 1, range), (Scaled{-3, false}));
  EXPECT_EQ(scaled_from(2.4, 1, range), (Scaled{2, false}));
  EXPECT_EQ(scaled_from(-0.4, 1, unsigned_range(1)), (Scaled{0, false}));
}

TEST(Scaled, SaturatesAtBothEndsOfEveryWidthAndSaysSo) {
  for (std::uint8_t width = 1; width <= 5; ++width) {
    for (const auto range : {unsigned_range(width), signed_range(width)}) {
      const auto first = static_cast<double>(range.first);
      const auto last = static_cast<double>(range.last);
      EXPECT_EQ(scaled_from(first, 1, range), (Scaled{range.first, false}));
      EXPECT_EQ(scaled_from(last, 1, range), (Scaled{range.last, false}));
      EXPECT_EQ(scaled_from(last + 0.4, 1, range), (Scaled{range.last, false}));
      EXPECT_EQ(scaled_from(first - 1, 1, range), (Scaled{range.first, true}));
      EXPECT_EQ(scaled_from(last + 0.5, 1, range), (Scaled{range.last, true}));
      EXPECT_EQ(scaled_from(infinity, 1, range), (Scaled{range.last, true}));
      EXPECT_EQ(scaled_from(-infinity, 1, range), (Scaled{range.first, true}));
    }
  }
}

TEST(Scaled, RefusesWhatHasNoNumberOrNoScale) {
  EXPECT_EQ(scaled_from(nan, 1, signed_range(2)), fail(ScaleError::not_a_number));
  EXPECT_EQ(scaled_from(1, 0, signed_range(2)), fail(ScaleError::unknown_scale));
}

TEST(RawFromValue, WrapsAnglesAndSaturatesTheRest) {
  FieldInfo field{};
  field.width = 2;
  field.type = FieldType::bam;
  EXPECT_EQ(raw_from_value(field, bam_scale(2), pi), (Scaled{-32768, false}));
  EXPECT_EQ(raw_from_value(field, bam_scale(2), infinity), fail(ScaleError::not_a_number));
  field.type = FieldType::signed_integer;
  EXPECT_EQ(raw_from_value(field, 0.005, -1000), (Scaled{-32768, true}));
  field.type = FieldType::unsigned_integer;
  EXPECT_EQ(raw_from_value(field, 0.5, -0.3), (Scaled{0, true}));
  EXPECT_EQ(raw_from_value(field, 0, 5), fail(ScaleError::unknown_scale));
}

}  // namespace
}  // namespace ponte::dli
