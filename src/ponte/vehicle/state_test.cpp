#include "ponte/vehicle/state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::vehicle {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr WallTime start = wall_time_from_unix_us(1'700'000'000'000'000);

/// Something heard `after` the start, of a source whose clock is an hour ahead of that of the others.
Moment heard(std::chrono::milliseconds after, Revision revision, std::chrono::hours ahead = {}) {
  return {start + after + ahead, Timestamp{} + after, revision};
}

TEST(Fact, KeepsTheBetterSourceUntilItFallsSilent) {
  Fact<Metres> height;
  EXPECT_TRUE(height.learn(Metres{10}, heard(seconds{0}, 1), 1));
  EXPECT_TRUE(height.learn(Metres{11}, heard(seconds{1}, 2), 0));
  EXPECT_FALSE(height.learn(Metres{99}, heard(milliseconds{2999}, 3), 1));
  EXPECT_EQ(height.value(), Metres{11});
  EXPECT_FALSE(height.newer_than(2));
  EXPECT_TRUE(height.learn(Metres{12}, heard(seconds{3}, 4), 1));
  EXPECT_EQ(height.value(), Metres{12});
}

TEST(Fact, DoesNotTakeTheClockOfASourceForItsSilence) {
  constexpr std::chrono::hours ahead{1};
  Fact<Metres> better_is_ahead;
  EXPECT_TRUE(better_is_ahead.learn(Metres{10}, heard(seconds{0}, 1, ahead), 0));
  EXPECT_FALSE(better_is_ahead.learn(Metres{99}, heard(seconds{1}, 2), 1));
  EXPECT_TRUE(better_is_ahead.learn(Metres{11}, heard(seconds{5}, 3), 1));

  Fact<Metres> worse_is_ahead;
  EXPECT_TRUE(worse_is_ahead.learn(Metres{10}, heard(seconds{0}, 1), 0));
  EXPECT_FALSE(worse_is_ahead.learn(Metres{99}, heard(seconds{1}, 2, ahead), 1));
}

TEST(Fact, IsNewerThanARevisionOnlyWhenLearntAfterIt) {
  Fact<Metres> height;
  EXPECT_FALSE(height.newer_than(0));
  height.learn(Metres{1}, heard(seconds{0}, 5));
  EXPECT_TRUE(height.newer_than(4));
  EXPECT_FALSE(height.newer_than(5));
  height.forget();
  EXPECT_FALSE(height.newer_than(0));
}

TEST(Fact, IsNewsButNoChangeWhenItIsConfirmed) {
  Fact<Metres> height;
  height.learn(Metres{1}, heard(seconds{0}, 5));
  EXPECT_TRUE(height.changed_since(4));
  height.learn(Metres{1}, heard(seconds{1}, 6));
  EXPECT_TRUE(height.newer_than(5));
  EXPECT_FALSE(height.changed_since(5));
  EXPECT_EQ(height.at(), start + seconds{1});
  height.learn(Metres{2}, heard(seconds{2}, 7));
  EXPECT_TRUE(height.changed_since(6));
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
