#include "ponte/autopilot/parameter.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

TEST(ParameterValue, TravelsAsANumberToArduPilot) {
  EXPECT_EQ(encode_parameter(Stack::ardupilot_copter, ParameterType::int16, -300), -300.0F);
  EXPECT_EQ(decode_parameter(Stack::ardupilot_plane, ParameterType::int32, 1500.0F), 1500);
}

TEST(ParameterValue, TravelsAsBytesToPx4) {
  // As it was recorded: 1 is 1.4e-45.
  EXPECT_EQ(std::bit_cast<std::uint32_t>(encode_parameter(Stack::px4, ParameterType::int32, 1)), 1U);
  EXPECT_EQ(decode_parameter(Stack::px4, ParameterType::int32, std::bit_cast<float>(0xFFFF'FFFEU)), -2);
  EXPECT_EQ(encode_parameter(Stack::px4, ParameterType::real32, 2.5), 2.5F);
}

TEST(ParameterValue, GoesThereAndBackForEveryType) {
  for (const auto stack : {Stack::px4, Stack::ardupilot_copter})
    for (const auto type : {ParameterType::uint8, ParameterType::int8, ParameterType::uint16, ParameterType::int16,
                            ParameterType::uint32, ParameterType::int32, ParameterType::real32})
      EXPECT_EQ(decode_parameter(stack, type, encode_parameter(stack, type, 100)), 100);
}

TEST(IsValueOf, KnowsTheRangesAndThatIntegersAreWhole) {
  EXPECT_TRUE(is_value_of(ParameterType::int8, -128));
  EXPECT_FALSE(is_value_of(ParameterType::int8, 128));
  EXPECT_FALSE(is_value_of(ParameterType::uint16, -1));
  EXPECT_FALSE(is_value_of(ParameterType::int32, 1.5));
  EXPECT_TRUE(is_value_of(ParameterType::real32, 1.5));
  EXPECT_FALSE(is_value_of(ParameterType::real32, 1e39));
  EXPECT_FALSE(is_value_of(ParameterType::real32, std::nan("")));
}

TEST(ParameterType, IsKnownOfFourBytesAtMost) {
  EXPECT_EQ(parameter_type(9), ParameterType::real32);
  for (const std::uint8_t number : {std::uint8_t{0}, std::uint8_t{7}, std::uint8_t{10}})
    EXPECT_EQ(parameter_type(number), std::nullopt);
}

}  // namespace
}  // namespace ponte::autopilot
