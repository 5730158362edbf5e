#include "ponte/vsm/latency_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::vsm {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr Timestamp start{7s};
constexpr WallTime wall = wall_time_from_unix_us(1'700'000'000'000'000);

/// Direct 5 + 20 = 25 us, converted 15.5 + 30 = 45.5 us.
constexpr LatencySample first{.time = wall,
                              .sequence = 255,
                              .received = start,
                              .decoded = start + 5us,
                              .translated = start + 8us,
                              .sent = start + 15'500ns,
                              .present_direct = 20us,
                              .present_converted = 30us};
/// Direct 6 + 20 = 26 us, converted 10 + 10 = 20 us.
constexpr LatencySample second{.time = wall + 100ms,
                               .sequence = 0,
                               .received = start + 100ms,
                               .decoded = start + 100ms + 6us,
                               .translated = start + 100ms + 7us,
                               .sent = start + 100ms + 10us,
                               .present_direct = 20us,
                               .present_converted = 10us};

LatencyStudy study_of_both() { return {.samples = {first, second}}; }

TEST(LatencySample, CountsThePresentationOfEachWay) {
  EXPECT_EQ(first.direct(), 25us);
  EXPECT_EQ(first.converted(), 45'500ns);
  EXPECT_EQ(first.delay(), 20'500ns);
}

TEST(LatencySample, MayBeFasterConverted) { EXPECT_EQ(second.delay(), -6us); }

TEST(LatencyQuantities, TellEachTimeOfASample) {
  std::vector<std::pair<std::string_view, double>> values;
  for (const auto& quantity : latency_quantities())
    values.emplace_back(quantity.name, series_of({.samples = {first}}, quantity.of).at(0));
  using Value = std::pair<std::string_view, double>;
  EXPECT_THAT(values, ElementsAre(Value{"direct", 25}, Value{"converted", 45.5}, Value{"delay", 20.5},
                                  Value{"decode", 5}, Value{"translate", 3}, Value{"send", 7.5},
                                  Value{"present_direct", 20}, Value{"present_converted", 30}));
}

TEST(Passes, WhenEveryDelayIsBelowTheLimit) {
  auto study = study_of_both();
  study.limit = 20'501ns;
  EXPECT_TRUE(passes(study));
}

TEST(Passes, NotWhenOneDelayReachesTheLimitThoughTheMeanDoesNot) {
  auto study = study_of_both();
  study.limit = 20'500ns;
  EXPECT_FALSE(passes(study));
}

TEST(Passes, NotWithoutSamples) { EXPECT_FALSE(passes({})); }

TEST(LatencyStudy, IsWrittenAsCsv) {
  EXPECT_EQ(
      csv_text(study_of_both()),
      "index,time_us,sequence,received_us,decoded_us,translated_us,sent_us,present_direct_us,present_converted_us,"
      "direct_us,converted_us,delay_us\n"
      "1,1700000000000000,255,0,5,8,15.5,20,30,25,45.5,20.5\n"
      "2,1700000000100000,0,100000,6,7,10,20,10,26,20,-6\n");
}

TEST(LatencyStudy, WritesASampleAsJson) {
  JsonText json;
  append_sample(json, study_of_both(), 2);
  EXPECT_EQ(json.text(),
            R"({"index":2,"time_us":1700000000100000,"sequence":0,"received_us":100000,"decoded_us":6,)"
            R"("translated_us":7,"sent_us":10,"present_direct_us":20,"present_converted_us":10,"direct_us":26,)"
            R"("converted_us":20,"delay_us":-6})");
}

TEST(LatencyStudy, WritesVerdictSummariesConditionsAndSamplesAsOneObject) {
  auto study = study_of_both();
  study.wakeups_late_us = {50, 70};
  study.conditions = {{"kernel", "6.1"}};
  JsonText json;
  append_study(json, study);
  EXPECT_THAT(json.text(), StartsWith(R"({"limit_ms":500,"pass":true,"summary":{"direct":{"count":2,"mean_us":25.5,)"));
  EXPECT_THAT(json.text(), HasSubstr(R"("delay":{"count":2,"mean_us":7.25,"median_us":7.25,"p95_us":)"));
  EXPECT_THAT(json.text(), HasSubstr(R"("peak_to_peak_us":26.5,"slope_us_per_sample":-26.5,"intercept_us":47})"));
  EXPECT_THAT(json.text(), HasSubstr(R"(},"wakeups_late":{"count":2,"mean_us":60,)"));
  EXPECT_THAT(json.text(), HasSubstr(R"(},"conditions":{"kernel":"6.1"},"samples":[{"index":1,)"));
  EXPECT_THAT(json.text(), EndsWith(R"("delay_us":-6}]})"));
}

TEST(LatencyStudy, SaysNothingOfATimerThatNobodyWatched) {
  JsonText json;
  append_study(json, study_of_both());
  EXPECT_THAT(json.text(), Not(HasSubstr("wakeups_late")));
}

}  // namespace
}  // namespace ponte::vsm
