#include "ponte/sim/navigation.hpp"

#include "ponte/sim/airframe.hpp"

#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class NavigationTest : public ::testing::TestWithParam<Personality> {
 protected:
  void wait(Duration duration, bool hears) {
    for (const auto end = now_ + duration; now_ < end;) {
      now_ += Airframe::step_length;
      navigation_.step(now_, hears);
    }
  }
  Duration trust() const { return GetParam() == Personality::px4 ? seconds{5} : seconds{8}; }

  Duration now_{};
  Navigation navigation_{GetParam(), seconds{8}, 1};
};

TEST_P(NavigationTest, FindsItsPositionAfterItsStart) {
  wait(milliseconds{7980}, true);
  EXPECT_FALSE(navigation_.has_position());
  wait(milliseconds{20}, true);
  EXPECT_TRUE(navigation_.has_position());
  EXPECT_EQ(navigation_.error(), NorthEastDown{});
}

TEST_P(NavigationTest, NeverFindsItWithoutSatellites) {
  wait(seconds{60}, false);
  EXPECT_FALSE(navigation_.has_position());
  EXPECT_FALSE(navigation_.ever_had_position());
  wait(milliseconds{20}, true);
  EXPECT_TRUE(navigation_.has_position());
}

TEST_P(NavigationTest, TrustsItselfForAWhile) {
  wait(seconds{10}, true);
  wait(trust(), false);
  EXPECT_TRUE(navigation_.has_position());
  EXPECT_NEAR(horizontal(navigation_.error()),
              0.05 * std::chrono::duration<double>{trust()}.count() * std::chrono::duration<double>{trust()}.count(),
              0.1)
      << "a drift that grows by 0.1 m/s^2";
  wait(milliseconds{40}, false);
  EXPECT_FALSE(navigation_.has_position());
  EXPECT_TRUE(navigation_.ever_had_position());
}

TEST_P(NavigationTest, FindsBackToTheTruth) {
  wait(seconds{10}, true);
  wait(seconds{40}, false);
  EXPECT_GT(horizontal(navigation_.error()), 60);
  wait(milliseconds{2900}, true);
  EXPECT_FALSE(navigation_.has_position());
  wait(milliseconds{200}, true);
  EXPECT_TRUE(navigation_.has_position());
  wait(seconds{10}, true);
  EXPECT_LT(horizontal(navigation_.error()), 0.01);
}

TEST_P(NavigationTest, BridgesAShortSilence) {
  wait(seconds{10}, true);
  wait(seconds{3}, false);
  wait(milliseconds{20}, true);
  EXPECT_TRUE(navigation_.has_position());
}

INSTANTIATE_TEST_SUITE_P(Both, NavigationTest, ::testing::Values(Personality::ardupilot, Personality::px4));

}  // namespace
}  // namespace ponte::sim
