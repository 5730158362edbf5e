#include "ponte/vsm/view/bridge_view.hpp"

#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/vsm/view/view_bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace ponte::vsm::view {
namespace {

using namespace testing;
using mavlink::autopilots::Attitude;
using mavlink::autopilots::BatteryStatus;
using mavlink::autopilots::Heartbeat;
using mavlink::autopilots::Statustext;
using dli::messages::HeartbeatMessage;
using dli::messages::InertialStates;

TEST(BridgeView, KeepsTheNewestCrossingOfEachMessage) {
  ViewBench bench;
  for (int i = 0; i < 10; ++i) bench.cross(Attitude{.roll = static_cast<float>(i)});
  bench.cross(Heartbeat{});
  const auto crossings = bench.crossings();
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_EQ(crossings[1]["mavlink"]["name"], "ATTITUDE");
  EXPECT_EQ(crossings[1]["mavlink"]["fields"]["roll"], 9);
  EXPECT_EQ(crossings[1]["number"], 10);
  EXPECT_EQ(crossings[1]["stages_ns"], json({{"decoded", 10'000}})) << "nothing was translated";
}

TEST(BridgeView, TellsOnlyWhatIsNew) {
  ViewBench bench;
  bench.cross(Attitude{});
  const auto told = bench.view.last_crossing();
  EXPECT_TRUE(bench.crossings(told).empty());
  bench.cross(Heartbeat{});
  EXPECT_EQ(bench.crossings(told).size(), 1U);
}

TEST(BridgeView, ACrossingThatBecameAMessageGoesBeforeALaterOneThatDidNot) {
  ViewBench bench;
  bench.cross(Attitude{.roll = 1}, {sent(vehicle_id, InertialStates{.roll = 100})});
  bench.cross(Attitude{.roll = 2});
  const auto crossings = bench.crossings();
  ASSERT_EQ(crossings.size(), 1U);
  EXPECT_EQ(crossings[0]["mavlink"]["fields"]["roll"], 1);
  EXPECT_EQ(crossings[0]["dli"][0]["fields"]["roll"]["raw"], 100);
  EXPECT_EQ(crossings[0]["stages_ns"], json({{"decoded", 10'000}, {"translated", 20'000}, {"sent", 30'000}}));
}

TEST(BridgeView, BatteriesAreToldApartByTheirInstance) {
  ViewBench bench;
  bench.cross(BatteryStatus{.id = 0, .battery_remaining = 80});
  bench.cross(BatteryStatus{.id = 1, .battery_remaining = 70});
  bench.cross(BatteryStatus{.id = 1, .battery_remaining = 69});
  const auto rows = bench.traffic()["mavlink"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["count"], 1);
  EXPECT_EQ(rows[1]["count"], 2);
  EXPECT_EQ(rows[1]["last"]["instance"], json({{"field", "id"}, {"value", 1}}));
  EXPECT_EQ(rows[1]["last"]["fields"]["battery_remaining"], 69);
}

TEST(BridgeView, FieldsThatAreLeftOutAreHeld) {
  ViewBench bench;
  bench.cross(Attitude{}, {sent(vehicle_id, InertialStates{.roll = 100, .pitch = -5})});
  bench.cross(Attitude{}, {sent(vehicle_id, InertialStates{.roll = 101})});
  const auto message = bench.crossings()[0]["dli"][0];
  EXPECT_EQ(message["fields"].size(), 1U);
  EXPECT_EQ(message["fields"]["roll"]["raw"], 101);
  EXPECT_EQ(message["held"].size(), 1U);
  EXPECT_EQ(message["held"]["pitch"]["raw"], -5);
}

TEST(BridgeView, MessagesOfTheClockHaveNoFrame) {
  ViewBench bench;
  bench.view.on_clock(bench.now, std::vector{sent(vsm_id, HeartbeatMessage{.time_stamp = 1}),
                                             sent(dli::EntityId{20, dli::EntityType::vehicle, 2}, InertialStates{.roll = 1})});
  const auto crossings = bench.crossings();
  ASSERT_EQ(crossings.size(), 1U) << "the other vehicle is not watched";
  EXPECT_FALSE(crossings[0].contains("mavlink"));
  EXPECT_EQ(crossings[0]["dli"][0]["number"], 16002);
  EXPECT_EQ(bench.traffic()["dli"].size(), 2U);
}

TEST(BridgeView, CountsLossesAndRejectsByReason) {
  ViewBench bench;
  bench.cross(Heartbeat{});
  const std::vector<std::byte> noise(7);
  bench.view.on_skipped(radio, noise, mavlink::SkipReason::noise);
  bench.view.on_skipped(radio, noise, mavlink::SkipReason::noise);
  bench.view.on_skipped(radio, Bytes{noise}.first(1), mavlink::SkipReason::checksum);
  bench.view.on_skipped(radio, Bytes{noise}.first(1), mavlink::SkipReason::checksum);
  bench.view.on_refused("bad checksum", 40);
  const auto traffic = bench.traffic();
  EXPECT_EQ(traffic["senders"][0]["received"], 1);
  EXPECT_EQ(traffic["rejects"].size(), 3U);
  const std::set<json> rejects{traffic["rejects"].begin(), traffic["rejects"].end()};
  EXPECT_TRUE(rejects.contains({{"side", "mavlink"}, {"link", 1}, {"reason", "noise"}, {"count", 1}, {"bytes", 14}}));
  EXPECT_TRUE(
      rejects.contains({{"side", "mavlink"}, {"link", 1}, {"reason", "bad checksum"}, {"count", 2}, {"bytes", 2}}));
  EXPECT_TRUE(rejects.contains({{"side", "dli"}, {"reason", "bad checksum"}, {"count", 1}, {"bytes", 40}}));
  EXPECT_EQ(bench.status()["mavlink"]["rejected"], 3);
  EXPECT_EQ(bench.status()["dli"]["rejected"], 1);
}

TEST(BridgeView, InventedIdsMakeNothingGrow) {
  ViewBench bench;
  for (unsigned system = 0; system < 256; ++system)
    for (unsigned component = 0; component < 32; ++component)
      bench.cross(Heartbeat{}, {}, mavlink::SystemId{static_cast<std::uint8_t>(system)},
                  mavlink::ComponentId{static_cast<std::uint8_t>(component)});
  auto since = std::uint64_t{};
  std::size_t rows = 0;
  auto rejects = json::array();
  while (since < bench.view.traffic_revision()) {
    bench.view.on_tick(bench.now);
    const auto news = bench.view.traffic(since, bench.now);
    EXPECT_LT(news.text->size(), BridgeView::traffic_size + 10'000);
    const auto traffic = json::parse(*news.text);
    rows += traffic["mavlink"].size();
    EXPECT_LE(traffic["senders"].size(), mavlink::LinkStatistics::capacity);
    rejects.insert(rejects.end(), traffic["rejects"].begin(), traffic["rejects"].end());
    ASSERT_GT(news.until, since);
    since = news.until;
  }
  EXPECT_EQ(rows, MavlinkTable::row_limit);
  ASSERT_EQ(rejects.size(), 1U);
  EXPECT_EQ(rejects[0]["reason"], "the table is full");
  EXPECT_EQ(rejects[0]["count"], 256 * 32 - MavlinkTable::row_limit);
}

TEST(BridgeView, RowsThatFallSilentAreToldOnceMore) {
  ViewBench bench;
  for (int i = 0; i < 50; ++i, bench.now += 100ms) bench.cross(Heartbeat{});
  EXPECT_NEAR(bench.traffic()["mavlink"][0]["rate_hz"].get<double>(), 10, 0.5);
  const auto told = bench.view.traffic_revision();
  bench.now += 2 * RateMeter::span;
  EXPECT_EQ(bench.traffic(told)["mavlink"][0]["rate_hz"], 0);
  EXPECT_TRUE(bench.traffic(bench.view.traffic_revision()).is_null());
}

TEST(BridgeView, ForgetsALinkThatIsGone) {
  ViewBench bench;
  bench.cross(Heartbeat{});
  bench.view.on_skipped(radio, std::vector<std::byte>(3), mavlink::SkipReason::noise);
  bench.view.set_situation({.converts = true});
  const auto traffic = bench.traffic();
  EXPECT_TRUE(traffic["mavlink"].empty());
  EXPECT_TRUE(traffic["senders"].empty());
  EXPECT_TRUE(traffic["rejects"].empty());
  EXPECT_TRUE(bench.crossings().empty());
}

TEST(BridgeView, TellsWhatVehiclesSay) {
  ViewBench bench;
  bench.cross(Statustext{.severity = 4, .text = Text<50>{"Battery low"}});
  bench.cross(Statustext{.severity = 2, .text = Text<50>{"from nobody we know"}}, {}, mavlink::SystemId{9});
  JsonText text;
  bench.view.events().append_from(text, 1);
  const auto events = json::parse(text.text())["events"];
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0]["text"], "Battery low");
  EXPECT_EQ(events[0]["severity"], "warning");
  EXPECT_EQ(events[0]["vehicle"], "14:40:00:01");
  EXPECT_EQ(events[0]["number"], 1);
}

TEST(BridgeView, MeasuresTheStagesOfWhatWasTranslated) {
  ViewBench bench;
  bench.cross(Attitude{}, {sent(vehicle_id, InertialStates{.roll = 100})});
  bench.cross(Heartbeat{});
  bench.view.on_tick(bench.now);
  const auto timing = json::parse(*bench.view.timing());
  EXPECT_EQ(timing["total"]["count"], 1);
  EXPECT_EQ(timing["total"]["max_ns"], 30'000);
  EXPECT_EQ(timing["decode"]["p50_ns"], 10'000);
  EXPECT_EQ(timing["total"]["buckets"].size(), timing["bounds_ns"].size() + 1);
  bench.view.restart_times();
  bench.view.on_tick(bench.now);
  EXPECT_EQ(json::parse(*bench.view.timing())["total"]["count"], 0);
}

TEST(EventLog, KeepsTheNewestAndGoesOnCounting) {
  EventLog log;
  EXPECT_EQ(log.first_for_newcomers(), 1U);
  for (std::size_t i = 0; i < EventLog::capacity + 5; ++i) log.add({.text = std::string(1000, 'x')});
  EXPECT_EQ(log.last(), EventLog::capacity + 5);
  EXPECT_EQ(log.first(), 6U);
  EXPECT_EQ(log.first_for_newcomers(), log.last() - 199);
  JsonText text;
  log.append_from(text, log.last());
  EXPECT_EQ(json::parse(text.text())["events"][0]["number"], log.last());
  EXPECT_EQ(json::parse(text.text())["events"][0]["text"].get<std::string>().size(), EventLog::text_size_max);
}

}  // namespace
}  // namespace ponte::vsm::view
