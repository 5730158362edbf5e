#include "ponte/sim/battery.hpp"

#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

constexpr BatteryConfig config{
    .capacity_ampere_hours = 10, .full_volts = 16, .empty_volts = 14, .resistance_ohms = 0.05};

TEST(Battery, IsFullAtFirst) {
  const Battery battery{config};
  EXPECT_EQ(battery.state().volts, 16);
  EXPECT_EQ(battery.state().remaining, 1);
}

TEST(Battery, LosesChargeAndVoltage) {
  Battery battery{config};
  for (int second = 0; second < 1800; ++second) battery.drain(10, 1);
  EXPECT_NEAR(battery.state().consumed_ampere_hours, 5, 1e-9);
  EXPECT_NEAR(battery.state().remaining, 0.5, 1e-9);
  EXPECT_NEAR(battery.state().volts, 15 - 10 * 0.05, 1e-9);
  EXPECT_NEAR(battery.state().consumed_joules, 15.0 * 10 * 1800, 1800 * 0.2 * 10);
}

TEST(Battery, RecoversItsVoltageWithoutLoad) {
  Battery battery{config};
  battery.drain(20, 1);
  const double under_load = battery.state().volts;
  battery.drain(0, 1);
  EXPECT_NEAR(battery.state().volts - under_load, 20 * 0.05, 1e-9);
}

TEST(Battery, StaysEmpty) {
  Battery battery{config};
  battery.drain(10, 7200);
  EXPECT_EQ(battery.state().remaining, 0);
  EXPECT_NEAR(battery.state().volts, 14 - 10 * 0.05, 1e-9);
}

TEST(Battery, LosesChargeWithoutGivingIt) {
  Battery battery{config};
  battery.lose_all_but(0.1);
  battery.drain(0, 1);
  EXPECT_NEAR(battery.state().remaining, 0.1, 1e-9);
  EXPECT_NEAR(battery.state().volts, 14.2, 1e-9);
  EXPECT_EQ(battery.state().consumed_ampere_hours, 0);
  battery.lose_all_but(0.5);
  EXPECT_NEAR(battery.state().remaining, 0.1, 1e-9) << "it gets no fuller";
}

}  // namespace
}  // namespace ponte::sim
