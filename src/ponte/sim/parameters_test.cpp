#include "ponte/sim/parameters.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ponte::sim {
namespace {

class ParameterTables : public ::testing::TestWithParam<Personality> {};

TEST_P(ParameterTables, HaveEachNameOnceAndNoneTooLong) {
  std::set<std::string_view> names;
  for (const auto& each : parameter_table(GetParam(), AirframeType::copter).rows) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_LE(each.name.size(), 16U) << each.name;
  }
}

TEST_P(ParameterTables, HaveDefaultsThatFitTheirTypes) {
  const Parameters parameters{GetParam()};
  for (std::size_t i = 0; i < parameters.size(); ++i)
    EXPECT_FLOAT_EQ(static_cast<float>(parameters.value(i)), static_cast<float>(parameters.info(i).default_value))
        << parameters.info(i).name;
}

INSTANTIATE_TEST_SUITE_P(Both, ParameterTables, ::testing::Values(Personality::ardupilot, Personality::px4));

TEST(Parameters, HaveTheDefaultsOfTheRealAutopilots) {
  const Parameters ardupilot{Personality::ardupilot};
  EXPECT_EQ(ardupilot.value("RTL_ALT"), 1500);
  EXPECT_EQ(ardupilot.value("FS_GCS_ENABLE"), 0);
  EXPECT_EQ(ardupilot.value("BATT_LOW_VOLT"), 10.5);
  EXPECT_EQ(ardupilot.size(), 1348U) << "as recorded";
  const Parameters px4{Personality::px4};
  EXPECT_EQ(px4.value("RTL_RETURN_ALT"), 30);
  EXPECT_EQ(px4.value("COM_DL_LOSS_T"), 10);
  EXPECT_EQ(px4.size(), 918U) << "as recorded";
  EXPECT_EQ(px4.find("RTL_ALT"), std::nullopt);
}

TEST(Parameters, RoundAndLimitToTheType) {
  Parameters parameters{Personality::ardupilot};
  parameters.set("FS_GCS_ENABLE", 2.6);  // int8
  EXPECT_EQ(parameters.value("FS_GCS_ENABLE"), 3);
  parameters.set("FS_GCS_ENABLE", 1000);
  EXPECT_EQ(parameters.value("FS_GCS_ENABLE"), 127);
  parameters.set("BATT_LOW_VOLT", 10.1);  // a float
  EXPECT_EQ(parameters.value("BATT_LOW_VOLT"), double{10.1F});
  parameters.set("BATT_LOW_VOLT", 1e300);
  EXPECT_GT(parameters.value("BATT_LOW_VOLT"), 1e38);
}

}  // namespace
}  // namespace ponte::sim
