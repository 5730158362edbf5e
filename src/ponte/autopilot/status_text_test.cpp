#include "ponte/autopilot/status_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ponte::autopilot {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using vehicle::Alert;
using enum vehicle::Condition;
using enum vehicle::Subsystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint8_t info = 6;
constexpr Timestamp start{};

/// Fifty characters, as many as a chunk has.
constexpr std::string_view whole = "Arming denied: Resolve system health failures firs";
static_assert(whole.size() == 50);

class Assembler {
 public:
  std::vector<Alert> chunk(std::uint16_t id, std::uint8_t number, std::string_view text, Timestamp now = start,
                           std::uint8_t severity = info) {
    std::vector<Alert> alerts;
    assembler.on_chunk(now, severity, id, number, text, [&](const Alert& alert) { alerts.push_back(alert); });
    return alerts;
  }
  std::vector<Alert> tick(Timestamp now) {
    std::vector<Alert> alerts;
    assembler.on_tick(now, [&](const Alert& alert) { alerts.push_back(alert); });
    return alerts;
  }

  StatusTextAssembler assembler;
};

Alert said(std::string_view text, vehicle::Subsystem subsystem = vsm, vehicle::Condition severity = nominal) {
  return {severity, subsystem, text};
}

TEST(StatusText, SeverityBecomesTheConditionOfTheMapping) {
  EXPECT_EQ(severity_of(0), emergency);
  EXPECT_EQ(severity_of(1), emergency);
  EXPECT_EQ(severity_of(2), warning);
  EXPECT_EQ(severity_of(3), warning);
  EXPECT_EQ(severity_of(4), caution);
  EXPECT_EQ(severity_of(5), nominal);
  EXPECT_EQ(severity_of(6), nominal);
  for (int debug = 7; debug <= 255; ++debug) EXPECT_EQ(severity_of(static_cast<std::uint8_t>(debug)), std::nullopt);
}

TEST(StatusText, WordsTellTheSubsystem) {
  struct Case {
    std::string_view text;
    vehicle::Subsystem subsystem;
  };
  const Case cases[]{
      {"EKF3 IMU0 is using GPS", navigation},
      {"EKF variance", navigation},
      {"GPS Glitch or Compass error", navigation},
      {"compass inconsistent", navigation},
      {"AHRS: not healthy", navigation},
      {"EKF2 reset", navigation},
      {"PreArm: Gyros inconsistent", navigation},
      {"gyro 1 failed", navigation},
      {"Accels inconsistent", navigation},
      {"Need Position Estimate", navigation},
      {"Battery 1 is low 10.60V used 311 mAh", propulsion_energy},
      {"low fuel", propulsion_energy},
      {"Motor 3 failed", engine},
      {"Motors: Emergency Stopped", engine},
      {"ESC 2 lost", engine},
      {"Engine stopped", engine},
      {"PreArm: RC not found", comms},
      {"Radio Failsafe", comms},
      {"data link lost", comms},
      {"GCS Failsafe", comms},
      {"Gimbal fault", payload},
      {"Mount: retracted", payload},
      {"camera full", payload},
      {"Parachute: Released", recovery},
      {"ArduPilot Ready", vsm},
      {"VSM restarted", vsm},
      {"Mission: 1 Takeoff", vsm},
      {"", vsm},
  };
  for (const auto& each : cases) EXPECT_EQ(subsystem_of(each.text), each.subsystem) << each.text;
  for (const auto& row : keyword_rows()) {
    const auto has_word = [&](const Case& each) { return subsystem_of(row.keyword) == each.subsystem; };
    EXPECT_TRUE(std::ranges::any_of(cases, has_word)) << row.keyword;
    EXPECT_EQ(subsystem_of(row.keyword), row.subsystem) << row.keyword;
  }
}

TEST(StatusText, PartsOfWordsTellNothing) {
  for (const auto* text : {"descending", "Source 2", "rcin", "linked", "Escape", "arc"})
    EXPECT_EQ(subsystem_of(text), vsm) << text;
  EXPECT_EQ(subsystem_of("arc rc"), comms) << "the second place of the letters is a word";
}

TEST(StatusText, WithoutIdIsToldAtOnceEvenWhenItFillsTheChunk) {
  Assembler assembler;
  EXPECT_THAT(assembler.chunk(0, 0, "GPS lost", start, 2), ElementsAre(said("GPS lost", navigation, warning)));
  EXPECT_THAT(assembler.chunk(0, 0, whole), ElementsAre(said(whole)));
  EXPECT_EQ(assembler.assembler.next_deadline(), std::nullopt);
}

TEST(StatusText, ChunksBecomeOneText) {
  Assembler assembler;
  EXPECT_THAT(assembler.chunk(7, 0, whole), IsEmpty());
  EXPECT_THAT(assembler.chunk(7, 1, "t"), ElementsAre(said("Arming denied: Resolve system health failures first")));
}

TEST(StatusText, TheWordThatTellsTheSubsystemMayStandAcrossTwoChunks) {
  Assembler assembler;
  const std::string padding(47, 'x');
  EXPECT_THAT(assembler.chunk(7, 0, padding + " GP"), IsEmpty());
  EXPECT_THAT(assembler.chunk(7, 1, "S lost"), ElementsAre(said(padding + " GPS lost", navigation)));
}

TEST(StatusText, IsCutToWhatAnAlertHolds) {
  Assembler assembler;
  const std::string text(50, 'a');
  for (std::uint8_t chunk = 0; chunk < 7; ++chunk) EXPECT_THAT(assembler.chunk(7, chunk, text), IsEmpty());
  EXPECT_THAT(assembler.chunk(7, 7, ""), ElementsAre(said(std::string(79, 'a'))));
}

TEST(StatusText, ALostChunkEndsTheText) {
  Assembler assembler;
  EXPECT_THAT(assembler.chunk(7, 0, whole), IsEmpty());
  EXPECT_THAT(assembler.chunk(7, 2, "end"), ElementsAre(said(whole), said("end")));
}

TEST(StatusText, ANewTextEndsTheOneBefore) {
  Assembler assembler;
  EXPECT_THAT(assembler.chunk(7, 0, whole), IsEmpty());
  EXPECT_THAT(assembler.chunk(8, 0, "other"), ElementsAre(said(whole), said("other")));
  EXPECT_THAT(assembler.chunk(9, 0, whole), IsEmpty());
  EXPECT_THAT(assembler.chunk(0, 0, "third"), ElementsAre(said(whole), said("third")));
}

TEST(StatusText, IsToldAfterASecondWithoutTheNextChunk) {
  Assembler assembler;
  EXPECT_EQ(assembler.assembler.next_deadline(), std::nullopt);
  EXPECT_THAT(assembler.chunk(7, 0, whole, start), IsEmpty());
  EXPECT_EQ(assembler.assembler.next_deadline(), start + seconds{1});
  EXPECT_THAT(assembler.tick(start + milliseconds{999}), IsEmpty());
  EXPECT_THAT(assembler.tick(start + seconds{1}), ElementsAre(said(whole)));
  EXPECT_THAT(assembler.tick(start + seconds{2}), IsEmpty());
}

TEST(StatusText, DropsDebugTextsAndEmptyOnes) {
  Assembler assembler;
  EXPECT_THAT(assembler.chunk(0, 0, "GPS", start, 7), IsEmpty());
  EXPECT_THAT(assembler.chunk(0, 0, ""), IsEmpty());
  EXPECT_THAT(assembler.chunk(0, 0, "\t"), IsEmpty());
}

TEST(StatusText, KeepsPrintableAsciiOnly) {
  Assembler assembler;
  EXPECT_THAT(assembler.chunk(0, 0, "Low\x01 \xC3\xA9 battery\t"),
              ElementsAre(said("Low  battery", propulsion_energy)));
}

}  // namespace
}  // namespace ponte::autopilot
