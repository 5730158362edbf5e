#include "ponte/sim/mission_store.hpp"

#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using Item = MissionStore::Item;

TEST(MissionStore, KeepsThreePlansApart) {
  MissionStore store{Personality::px4};
  const std::array mission{Item{.command = 16}, Item{.command = 21}};
  store.replace(PlanType::mission, mission);
  store.put(PlanType::rally, 0, Item{.command = 5100});
  EXPECT_EQ(store.items(PlanType::mission).size(), 2U);
  EXPECT_TRUE(store.items(PlanType::fence).empty());
  EXPECT_EQ(store.items(PlanType::rally)[0].command, 5100);
}

TEST(MissionStore, NumbersWhatItHolds) {
  MissionStore store{Personality::ardupilot};
  EXPECT_EQ(store.id(PlanType::mission), 0U);
  store.put(PlanType::mission, 0, Item{.command = 16});
  const auto first = store.id(PlanType::mission);
  EXPECT_NE(first, 0U);
  store.put(PlanType::mission, 0, Item{.command = 22});
  EXPECT_NE(store.id(PlanType::mission), first);
  EXPECT_EQ(store.id(PlanType::fence), 0U);
  store.truncate(PlanType::mission, 0);
  EXPECT_EQ(store.id(PlanType::mission), 0U);
}

}  // namespace
}  // namespace ponte::sim
