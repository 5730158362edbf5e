#include "ponte/autopilot/patience.hpp"

#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

using std::chrono::milliseconds;

TEST(Patience, BeginsWithItsFirstAndIsAboutThreeRoundTripsThen) {
  Patience patience{{}};
  EXPECT_EQ(patience.current(), milliseconds{500});
  patience.measured(milliseconds{200});
  EXPECT_EQ(patience.round_trip(), milliseconds{200});
  EXPECT_EQ(patience.current(), milliseconds{600});
  for (int i = 0; i < 50; ++i) patience.measured(milliseconds{200});
  EXPECT_LT(patience.current(), milliseconds{210});
}

TEST(Patience, KeepsToItsLimits) {
  Patience patience{{}};
  patience.measured(milliseconds{1});
  EXPECT_EQ(patience.current(), milliseconds{100});
  Patience slow{{}};
  slow.measured(std::chrono::minutes{1});
  EXPECT_EQ(slow.current(), milliseconds{1500});
}

TEST(Patience, IsDoubledTwiceWhenItRunsOutAndAsBeforeOnceSomethingIsMeasured) {
  Patience patience{{}};
  patience.measured(milliseconds{40});
  const auto before = patience.current();
  for (int i = 0; i < 5; ++i) patience.ran_out();
  EXPECT_EQ(patience.current(), 4 * before);
  patience.measured(milliseconds{40});
  EXPECT_LE(patience.current(), before);
}

// The other side was not answered, and asked again after 250 ms.
TEST(Patience, IsHardlyChangedByARepetition) {
  Patience patience{{}};
  patience.measured(milliseconds{20});
  patience.measured(milliseconds{270});
  EXPECT_LT(patience.current(), milliseconds{200});
  Patience other{{}};
  other.measured(milliseconds{270});
  other.measured(milliseconds{20});
  EXPECT_EQ(other.current(), milliseconds{100});
}

TEST(Patience, FollowsALinkThatHasBecomeSlow) {
  Patience patience{{}};
  patience.measured(milliseconds{20});
  for (int i = 0; i < 20; ++i) patience.measured(milliseconds{400});
  EXPECT_GT(patience.current(), milliseconds{400});
}

}  // namespace
}  // namespace ponte::autopilot
