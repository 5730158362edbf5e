#include "ponte/dlisession/alert_ids.hpp"

#include <gtest/gtest.h>

#include <string>

namespace ponte::dlisession {
namespace {

/// A text of its own class: the letters of a number, since digits do not count.
std::string text_number(int number) {
  std::string text = "text ";
  for (; number > 0; number /= 26) text += static_cast<char>('a' + number % 26);
  return text;
}

// FNV-1a of "vehicle heartbeat lost", 31 bits.
constexpr std::int32_t heartbeat_lost = 157833363;

TEST(AlertIds, AreNegativeTheFirstTimeAndPositiveAfterwards) {
  AlertIds ids;
  EXPECT_EQ(ids.id_for("vehicle heartbeat lost"), -heartbeat_lost);
  EXPECT_EQ(ids.id_for("vehicle heartbeat lost"), heartbeat_lost);
  EXPECT_EQ(ids.id_for("vehicle heartbeat lost"), heartbeat_lost);
}

TEST(AlertIds, DoNotCountNumbers) {
  AlertIds ids;
  EXPECT_EQ(ids.id_for("Battery 1 is low 10.60V used 311 mAh"), -371538083);
  EXPECT_EQ(ids.id_for("Battery 1 is low 9.75V used 1204 mAh"), 371538083);
  EXPECT_EQ(ids.id_for("Battery 2 is low -0.1V used +5 mAh"), 371538083);
}

TEST(AlertIds, DifferForDifferentTexts) {
  AlertIds ids;
  EXPECT_NE(ids.id_for("EKF variance"), ids.id_for("GPS Glitch"));
  EXPECT_LT(ids.id_for("Radio Failsafe"), 0);
}

TEST(AlertIds, AreNeverZero) {
  AlertIds ids;
  EXPECT_LT(ids.id_for(""), 0);
  EXPECT_GT(ids.id_for("12345"), 0) << "the same class as no text at all";
}

TEST(AlertIds, ForgetTheOldestClassFirst) {
  AlertIds ids;
  constexpr int capacity = static_cast<int>(AlertIds::capacity);
  for (int number = 0; number < capacity; ++number) EXPECT_LT(ids.id_for(text_number(number)), 0) << number;
  for (int number = 0; number < capacity; ++number) EXPECT_GT(ids.id_for(text_number(number)), 0) << number;
  EXPECT_LT(ids.id_for("one too many"), 0);
  EXPECT_GT(ids.id_for(text_number(1)), 0);
  EXPECT_LT(ids.id_for(text_number(0)), 0) << "forgotten";
}

}  // namespace
}  // namespace ponte::dlisession
