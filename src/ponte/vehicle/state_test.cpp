#include "ponte/vehicle/state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::vehicle {
namespace {

using std::chrono::seconds;

constexpr WallTime start = wall_time_from_unix_us(1'700'000'000'000'000);

TEST(Fact, KeepsTheBetterSourceUntilItFallsSilent) {
  Fact<Metres> height;
  EXPECT_TRUE(height.learn(Metres{10}, start, 1, 1));
  EXPECT_TRUE(height.learn(Metres{11}, start + seconds{1}, 2, 0));
  EXPECT_FALSE(height.learn(Metres{99}, start + seconds{2}, 3, 1));
  EXPECT_EQ(height.value(), Metres{11});
  EXPECT_TRUE(height.learn(Metres{12}, start + seconds{3}, 4, 1));
  EXPECT_EQ(height.value(), Metres{12});
}

TEST(Fact, IsNewerThanARevisionOnlyWhenLearntAfterIt) {
  Fact<Metres> height;
  EXPECT_FALSE(height.newer_than(0));
  height.learn(Metres{1}, start, 5);
  EXPECT_TRUE(height.newer_than(4));
  EXPECT_FALSE(height.newer_than(5));
  height.forget();
  EXPECT_FALSE(height.newer_than(0));
}

TEST(State, NamesItsFacts) {
  EXPECT_EQ(name_of(&State::roll), "roll");
  EXPECT_EQ(name_of(&State::mode), "mode");
  EXPECT_EQ(unit_symbol<Radians>(), "rad");
  EXPECT_EQ(unit_symbol<Mode>(), "");
}

TEST(Vocabulary, HasANameForEveryValue) {
  EXPECT_EQ(name_of(ModeKind::other), "other");
  EXPECT_EQ(name_of(Phase::critical), "critical");
  EXPECT_EQ(name_of(Subsystem::vsm), "vsm");
  EXPECT_EQ(name_of(Condition::failed), "failed");
}

}  // namespace
}  // namespace ponte::vehicle
