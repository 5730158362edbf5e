#include "ponte/sim/faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using ::testing::ElementsAre;

TEST(ParseFaults, ReadsNamesTimesAndDurations) {
  const auto faults = parse_faults("battery-low@60s,gps-loss@90s+20s,reboot@2min,motor@1.5,link-loss@0+500ms");
  ASSERT_TRUE(faults) << faults.error();
  EXPECT_THAT(*faults, ElementsAre(Fault{FaultKind::battery_low, seconds{60}, std::nullopt},
                                   Fault{FaultKind::gps_loss, seconds{90}, seconds{20}},
                                   Fault{FaultKind::reboot, minutes{2}, std::nullopt},
                                   Fault{FaultKind::motor, milliseconds{1500}, std::nullopt},
                                   Fault{FaultKind::link_loss, Duration{}, milliseconds{500}}));
}

TEST(ParseFaults, SaysWhatIsWrong) {
  const auto error = [](std::string_view text) {
    const auto faults = parse_faults(text);
    return faults ? std::string{"none"} : faults.error();
  };
  const std::string names = "battery-low, battery-critical, gps-loss, link-loss, motor, reboot";
  EXPECT_EQ(error("engine@5s"), "engine@5s: no fault is called 'engine'; there are " + names);
  EXPECT_EQ(error(""), "'': expected FAULT@TIME, as in gps-loss@90s+20s; there are " + names);
  EXPECT_EQ(error("motor"), "'motor': expected FAULT@TIME, as in gps-loss@90s+20s; there are " + names);
  EXPECT_EQ(error("motor@5s,"), "'': expected FAULT@TIME, as in gps-loss@90s+20s; there are " + names);
  for (const auto* text : {"motor@", "motor@s", "motor@-3s", "motor@5h", "motor@nan", "motor@1e99", "motor@ 5s"})
    EXPECT_EQ(error(text), std::string{text} + ": expected a time after @, as in 90s, 500ms or 2min");
  for (const auto* text : {"motor@5s+", "motor@5s+x", "motor@5s+-1s", "motor@5s+1s+1s"})
    EXPECT_EQ(error(text), std::string{text} + ": expected a duration after +, as in 20s");
  EXPECT_EQ(error("reboot@5s+3s"), "reboot@5s+3s: reboot does not pass, so it has no duration");
}

TEST(ParseFault, IsNowWithoutATime) {
  EXPECT_EQ(*parse_fault("gps-loss+20s", seconds{7}), (Fault{FaultKind::gps_loss, seconds{7}, seconds{20}}));
  EXPECT_EQ(*parse_fault("motor", seconds{7}), (Fault{FaultKind::motor, seconds{7}, std::nullopt}));
  EXPECT_EQ(parse_fault("motor@9s", seconds{7})->at, seconds{9});
}

TEST(Faults, AreThereWhileTheyLast) {
  const Faults faults{{{FaultKind::gps_loss, seconds{5}, seconds{2}}, {FaultKind::motor, seconds{3}, std::nullopt}}};
  EXPECT_FALSE(faults.is_on(FaultKind::gps_loss, milliseconds{4999}));
  EXPECT_TRUE(faults.is_on(FaultKind::gps_loss, seconds{5}));
  EXPECT_FALSE(faults.is_on(FaultKind::gps_loss, seconds{7}));
  EXPECT_TRUE(faults.is_on(FaultKind::motor, minutes{50}));
  EXPECT_FALSE(faults.is_on(FaultKind::link_loss, seconds{5}));
}

TEST(Faults, BeginOnce) {
  Faults faults{{}};
  faults.add({FaultKind::reboot, seconds{5}, std::nullopt});
  EXPECT_FALSE(faults.begins(FaultKind::reboot, milliseconds{4980}, seconds{5}));
  EXPECT_TRUE(faults.begins(FaultKind::reboot, seconds{5}, milliseconds{5020}));
  EXPECT_FALSE(faults.begins(FaultKind::reboot, milliseconds{5020}, seconds{60}));
}

}  // namespace
}  // namespace ponte::sim
