#include "ponte/autopilot/parameter_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace ponte::autopilot {
namespace {

using ::testing::ElementsAre;

auto read(std::string_view text) { return read_parameter_file(bytes_of(text)); }

ParameterFileError error_in(std::string_view text) {
  const auto result = read(text);
  EXPECT_FALSE(result.has_value());
  return result ? ParameterFileError{} : result.error();
}

constexpr std::array parameters{Parameter{ParameterName{"RTL_ALT"}, ParameterType::int32, 1500},
                                Parameter{ParameterName{"WPNAV_SPEED"}, ParameterType::real32, double{0.1F}}};

TEST(ParameterFile, IsWrittenAsQGroundControlDoes) {
  EXPECT_EQ(write_qgroundcontrol_file(parameters, 1, 1),
            "# Onboard parameters\n#\n# Vehicle-Id Component-Id Name Value Type\n"
            "1\t1\tRTL_ALT\t1500\t6\n1\t1\tWPNAV_SPEED\t0.1\t9\n");
}

TEST(ParameterFile, IsWrittenAsMavproxyDoes) {
  EXPECT_EQ(write_mavproxy_file(parameters), "RTL_ALT          1500\nWPNAV_SPEED      0.1\n");
}

TEST(ParameterFile, IsReadInBothFormats) {
  EXPECT_THAT(read("# saved by me\n1\t1\tRTL_ALT\t1500\t6\r\n\n1\t1\tWPNAV_SPEED\t0.1\t9\n").value(),
              ElementsAre(ParameterLine{2, 1, 1, ParameterName{"RTL_ALT"}, 1500, ParameterType::int32},
                          ParameterLine{4, 1, 1, ParameterName{"WPNAV_SPEED"}, 0.1, ParameterType::real32}));
  EXPECT_THAT(read("RTL_ALT          1500.000000 # cm\n\n#NOTE: none\nWPNAV_SPEED +0.1").value(),
              ElementsAre(ParameterLine{1, {}, {}, ParameterName{"RTL_ALT"}, 1500, {}},
                          ParameterLine{4, {}, {}, ParameterName{"WPNAV_SPEED"}, 0.1, {}}));
}

TEST(ParameterFile, IsRefusedWithTheLineAndWhatWasExpected) {
  EXPECT_EQ(error_in("A 1\nB"),
            (ParameterFileError{2, "it has 1 fields", "2: name, value; or 5: vehicle, component, name, value, type"}));
  EXPECT_EQ(error_in("A x"), (ParameterFileError{1, "the value is 'x'", "a number"}));
  EXPECT_EQ(error_in("A nan"), (ParameterFileError{1, "the value is 'nan'", "a number"}));
  EXPECT_EQ(error_in("A 1e39"), (ParameterFileError{1, "the value is '1e39'", "a number"}));
  EXPECT_EQ(error_in("A-B 1"),
            (ParameterFileError{1, "the name is 'A-B'", "up to 16 letters, digits and underscores"}));
  EXPECT_EQ(error_in("A 1\n\nA 2"), (ParameterFileError{3, "the name A comes twice", "each name once"}));
  EXPECT_EQ(error_in("1 1 A 1 7"), (ParameterFileError{1, "the type is '7'", "a MAV_PARAM_TYPE: 1 to 6, or 9"}));
  EXPECT_EQ(error_in("1 1 A 1.5 6"), (ParameterFileError{1, "the value is '1.5'", "one that type 6 has"}));
  EXPECT_EQ(error_in("256 1 A 1 6"), (ParameterFileError{1, "the vehicle is '256'", "an integer from 0 to 255"}));
}

TEST(ParameterFile, MayHaveANameInEachComponent) { EXPECT_EQ(read("1 1 A 1 6\n1 2 A 2 6").value().size(), 2U); }

}  // namespace
}  // namespace ponte::autopilot
