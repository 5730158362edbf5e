#include "ponte/autopilot/subsystem_health.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace ponte::autopilot {
namespace {

using vehicle::Condition;
using vehicle::Subsystem;
using enum vehicle::Condition;
using enum vehicle::Subsystem;

constexpr std::uint64_t bit(unsigned number) { return std::uint64_t{1} << number; }

std::optional<Condition> condition(Subsystem subsystem, const SensorBits& bits, bool armed = false) {
  return conditions_from(bits, armed)[static_cast<std::size_t>(subsystem)];
}

/// The condition of the only subsystem that has one.
struct Only {
  Subsystem subsystem;
  Condition condition;
  friend bool operator==(const Only&, const Only&) = default;
};
std::optional<Only> only(const SubsystemConditions& conditions) {
  std::optional<Only> result;
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (conditions[i]) {
      EXPECT_FALSE(result) << "two subsystems";
      result = Only{static_cast<Subsystem>(i), *conditions[i]};
    }
  return result;
}

TEST(SubsystemHealth, EveryBitBelongsToTheSubsystemOfTheTable) {
  struct Case {
    unsigned bit;
    Subsystem subsystem;
    Condition when_unhealthy;
  };
  const Case cases[]{
      {0, navigation, warning},  {1, navigation, warning},         {2, navigation, warning},  {3, navigation, warning},
      {4, navigation, warning},  {5, navigation, warning},         {6, navigation, warning},  {7, navigation, warning},
      {8, navigation, warning},  {9, navigation, warning},         {10, navigation, warning}, {11, navigation, warning},
      {12, navigation, warning}, {13, navigation, warning},        {14, navigation, warning}, {15, engine, warning},
      {16, comms, warning},      {17, navigation, warning},        {18, navigation, warning}, {19, navigation, warning},
      {20, navigation, warning}, {21, navigation, warning},        {22, navigation, warning}, {23, engine, warning},
      {24, electrical, warning}, {25, propulsion_energy, warning}, {26, navigation, warning}, {27, comms, warning},
      {28, vsm, caution},        {29, navigation, warning},        {30, engine, warning},     {32, recovery, warning},
  };
  std::set<unsigned> tested;
  for (const auto& each : cases) {
    const auto mask = bit(each.bit);
    tested.insert(each.bit);
    EXPECT_EQ(only(conditions_from({mask, mask, mask}, false)), (Only{each.subsystem, nominal})) << each.bit;
    EXPECT_EQ(only(conditions_from({mask, mask, 0}, false)), (Only{each.subsystem, each.when_unhealthy})) << each.bit;
    EXPECT_EQ(only(conditions_from({0, mask, 0}, false)), std::nullopt) << "not fitted: " << each.bit;
    EXPECT_EQ(only(conditions_from({mask, 0, 0}, false)), std::nullopt) << "switched off: " << each.bit;
  }
  for (const auto& row : sensor_rows()) EXPECT_TRUE(tested.contains(row.bit)) << "no test for " << row.name;
  EXPECT_EQ(tested.size(), sensor_rows().size());
}

TEST(SubsystemHealth, SaysNothingWithoutSensors) {
  for (const auto& each : conditions_from({0, ~std::uint64_t{0}, ~std::uint64_t{0}}, false))
    EXPECT_EQ(each, std::nullopt);
  EXPECT_EQ(only(conditions_from({bit(31), bit(31), 0}, false)), std::nullopt) << "31 is no sensor";
}

TEST(SubsystemHealth, TheWorstSensorCounts) {
  const auto mask = bit(0) | bit(5) | bit(21);
  EXPECT_EQ(condition(navigation, {mask, mask, mask}), nominal);
  EXPECT_EQ(condition(navigation, {mask, mask, bit(0) | bit(21)}), warning);
}

TEST(SubsystemHealth, ASecondSensorIsACautionWhileTheFirstIsHealthy) {
  for (unsigned first = 0; first < 3; ++first) {
    const auto second = first + 17;
    const auto both = bit(first) | bit(second);
    EXPECT_EQ(condition(navigation, {both, both, bit(first)}), caution) << second;
    EXPECT_EQ(condition(navigation, {both, both, bit(second)}), warning) << second;
    EXPECT_EQ(condition(navigation, {both, both, 0}), warning) << second;
    EXPECT_EQ(condition(navigation, {bit(second), bit(second), bit(first)}), warning) << "first not fitted " << second;
  }
}

TEST(SubsystemHealth, ThePrearmCheckCountsWhileDisarmedOnly) {
  EXPECT_EQ(condition(vsm, {bit(28), bit(28), 0}, false), caution);
  EXPECT_EQ(condition(vsm, {bit(28), bit(28), 0}, true), std::nullopt);
}

TEST(SubsystemHealth, OfTheWholeVehicleIsInTheSystemStatus) {
  for (const auto ordinary : std::to_array<std::uint8_t>({0, 1, 2, 3, 4, 7, 255}))
    EXPECT_EQ(condition_of_state(ordinary), std::nullopt);
  EXPECT_EQ(condition_of_state(5), warning);
  EXPECT_EQ(condition_of_state(6), emergency);
}

}  // namespace
}  // namespace ponte::autopilot
