#include "ponte/autopilot/kept_plan.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using Plan = std::vector<WireItem>;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

WireItem waypoint() {
  return {.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
          .command = messages::MAV_CMD_NAV_WAYPOINT,
          .autocontinue = 1,
          .param1 = 2.5F,
          .param2 = 4,
          .param4 = nan,
          .x = -300'699'000,
          .y = -511'209'600,
          .z = 40.129F};
}

/// As ArduPilot has it: its own home, and the item as it keeps it.
Plan ardupilot(const WireItem& item) { return {WireItem{.command = 16, .autocontinue = 1, .z = 50.09F}, item}; }

std::optional<std::size_t> difference(const WireItem& sent, const WireItem& kept) {
  return first_difference(Stack::ardupilot_copter, PlanType::mission, ardupilot(sent), ardupilot(kept));
}

TEST(FirstDifference, OfPx4MindsAllButTheNameOfAFrame) {
  auto kept = waypoint();
  kept.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT;
  const auto check = [&] {
    return first_difference(Stack::px4, PlanType::mission, Plan{waypoint(), waypoint()}, Plan{waypoint(), kept});
  };
  EXPECT_EQ(check(), std::nullopt);
  kept.param1 = 2;
  EXPECT_EQ(check(), 1U);
  kept = waypoint();
  kept.x += 1;
  EXPECT_EQ(check(), 1U);
  kept = waypoint();
  kept.autocontinue = 0;
  EXPECT_EQ(check(), 1U);
}

TEST(FirstDifference, OfArduPilotForgivesWhatItRounds) {
  auto kept = waypoint();
  kept.param1 = 2;
  kept.param2 = 0;
  kept.param4 = 0;
  kept.z = 40.12F;
  EXPECT_EQ(difference(waypoint(), kept), std::nullopt);
  kept.z = 40.1F;
  EXPECT_EQ(difference(waypoint(), kept), 1U);
  kept = waypoint();
  kept.param1 = 3;
  EXPECT_EQ(difference(waypoint(), kept), 1U);
  kept = waypoint();
  kept.y += 1;
  EXPECT_EQ(difference(waypoint(), kept), 1U);
  kept = waypoint();
  kept.frame = messages::MAV_FRAME_GLOBAL;
  EXPECT_EQ(difference(waypoint(), kept), 1U);
}

TEST(FirstDifference, OfArduPilotMindsEveryNumberOfWhatIsNoNavigation) {
  const WireItem speed{.frame = 2, .command = messages::MAV_CMD_DO_CHANGE_SPEED, .param1 = 1, .param2 = 7.5F};
  auto kept = speed;
  kept.frame = 0;  // it has none of its own
  EXPECT_EQ(difference(speed, kept), std::nullopt);
  kept.param2 = 7;
  EXPECT_EQ(difference(speed, kept), 1U);
}

TEST(FirstDifference, OfArduPilotKnowsLargeRadiiAndLandings) {
  WireItem circle{.command = messages::MAV_CMD_NAV_LOITER_TURNS, .param1 = 3, .param3 = -257};
  auto kept = circle;
  kept.param3 = -250;
  EXPECT_EQ(difference(circle, kept), std::nullopt);
  kept.param3 = -240;
  EXPECT_EQ(difference(circle, kept), 1U);
  WireItem landing{.command = messages::MAV_CMD_NAV_LAND, .param4 = 0};
  kept = landing;
  kept.param4 = 1;
  EXPECT_EQ(difference(landing, kept), std::nullopt);
}

TEST(FirstDifference, IsTheEndOfTheShorterPlan) {
  const Plan two{waypoint(), waypoint()};
  EXPECT_EQ(first_difference(Stack::px4, PlanType::mission, two, Plan{waypoint()}), 1U);
  EXPECT_EQ(first_difference(Stack::px4, PlanType::mission, {}, two), 0U);
}

TEST(FirstDifference, TakesArduPilotsHomeAloneForAnEmptyPlan) {
  const Plan home{WireItem{.command = 16}};
  EXPECT_EQ(first_difference(Stack::ardupilot_copter, PlanType::mission, {}, home), std::nullopt);
  EXPECT_EQ(first_difference(Stack::ardupilot_copter, PlanType::rally, {}, home), 0U);
}

TEST(IsSamePlan, MindsEveryNumber) {
  auto other = waypoint();
  other.seq = 7;
  other.target_system = 1;
  other.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT;
  EXPECT_TRUE(is_same_plan(Plan{waypoint()}, Plan{other}));
  other.param1 = 2;
  EXPECT_FALSE(is_same_plan(Plan{waypoint()}, Plan{other}));
  EXPECT_FALSE(is_same_plan(Plan{waypoint()}, Plan{waypoint(), waypoint()}));
}

}  // namespace
}  // namespace ponte::autopilot
