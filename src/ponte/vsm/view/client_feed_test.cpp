#include "ponte/vsm/view/client_feed.hpp"

#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/vsm/view/view_bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::vsm::view {
namespace {

using namespace testing;
using mavlink::autopilots::Attitude;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view watch_all = R"({"kind":"watch","vehicle":"14:40:00:01","traffic":true})";

class FeedBench : public ViewBench {
 public:
  void tick() { tick_of(feed); }
  void tick_of(ClientFeed& any) {
    now += ClientFeed::crossing_period;
    view.on_tick(now);
    any.on_tick(now);
  }
  void add_event(const std::string& text) { view.events().add({.time = wall, .text = text}); }

  /// Everything that is due.
  std::vector<json> taken() {
    std::vector<json> messages;
    while (const auto text = feed.take(now)) messages.push_back(json::parse(*text));
    return messages;
  }
  std::vector<std::string> kinds() {
    std::vector<std::string> result;
    for (const auto& message : taken()) result.push_back(message["kind"]);
    return result;
  }

  ClientFeed feed{view, Role::watch, true, "1.2.3"};
};

TEST(ClientFeed, BeginsWithHelloStatusEventsAndStudy) {
  FeedBench bench;
  bench.add_event("before");
  ClientFeed late{bench.view, Role::command, false, "1.2.3"};
  const auto hello = json::parse(*late.take(bench.now));
  EXPECT_EQ(hello, json({{"kind", "hello"}, {"version", "1.2.3"}, {"role", "command"}, {"session", false}}));
  EXPECT_EQ(json::parse(*late.take(bench.now))["kind"], "status");
  EXPECT_EQ(json::parse(*late.take(bench.now))["events"][0]["text"], "before");
  EXPECT_EQ(json::parse(*late.take(bench.now))["kind"], "study");
  EXPECT_EQ(late.take(bench.now), nullptr);
}

TEST(ClientFeed, SendsTelemetryToWhoAsksForIt) {
  FeedBench bench;
  bench.taken();
  bench.cross(Attitude{});
  bench.tick();
  EXPECT_THAT(bench.kinds(), ElementsAre("timing")) << "nothing was asked for yet";
  EXPECT_TRUE(bench.feed.on_message(bench.now, watch_all));
  bench.cross(Attitude{});
  bench.tick();
  EXPECT_THAT(bench.kinds(), ElementsAre("crossings"));
  for (int i = 0; i < 7; ++i) bench.tick();
  EXPECT_THAT(bench.kinds(), ElementsAre("traffic"));
}

TEST(ClientFeed, CoalescesToFifteenTimesASecond) {
  FeedBench bench;
  EXPECT_TRUE(bench.feed.on_message(bench.now, R"({"kind":"watch","vehicle":"14:40:00:01","traffic":false})"));
  bench.taken();
  std::size_t messages = 0;
  std::uint64_t newest = 0;
  for (int i = 0; i < 1000; ++i) {
    bench.cross(Attitude{});
    bench.now += 1ms;
    if (i % 66 == 0) {
      bench.view.on_tick(bench.now);
      bench.feed.on_tick(bench.now);
    }
    for (const auto& message : bench.taken()) {
      if (message["kind"] != "crossings") continue;
      ++messages;
      EXPECT_EQ(message["crossings"].size(), 1U);
      newest = message["crossings"][0]["number"];
    }
  }
  EXPECT_GE(messages, 10U);
  EXPECT_LE(messages, 20U);
  EXPECT_GT(newest, 900U);
  EXPECT_EQ(bench.feed.dropped(), 0U);
}

TEST(ClientFeed, ASlowClientLosesTelemetryAndIsToldSo) {
  FeedBench bench;
  EXPECT_TRUE(bench.feed.on_message(bench.now, watch_all));
  bench.taken();
  for (int i = 0; i < 30; ++i) {  // two seconds without taking anything
    bench.cross(Attitude{.roll = static_cast<float>(i)});
    bench.add_event(std::to_string(i));
    bench.tick();
  }
  EXPECT_GE(bench.feed.dropped(), 30U);
  const auto messages = bench.taken();
  std::vector<std::string> kinds;
  for (const auto& message : messages) {
    kinds.push_back(message["kind"]);
  }
  ASSERT_THAT(kinds, ElementsAre("status", "events", "dropped", "crossings", "traffic", "timing"));
  EXPECT_EQ(messages[1]["events"].size(), 30U) << "no event is lost";
  EXPECT_EQ(messages[2]["count"], bench.feed.dropped());
  EXPECT_EQ(messages[3]["crossings"][0]["mavlink"]["fields"]["roll"], 29);
  EXPECT_FALSE(bench.feed.has_lost_events());
}

TEST(ClientFeed, AQuietBridgeIsNoReasonToCountDrops) {
  FeedBench bench;
  EXPECT_TRUE(bench.feed.on_message(bench.now, watch_all));
  bench.taken();
  for (int i = 0; i < 10; ++i) bench.tick();
  EXPECT_EQ(bench.feed.dropped(), 0U);
}

TEST(ClientFeed, EveryEventIsToldOnce) {
  FeedBench bench;
  bench.taken();
  std::uint64_t next = 1;
  for (int i = 0; i < 500; ++i) {
    bench.add_event("x");
    if (i % 7 != 0) continue;
    for (const auto& message : bench.taken()) {
      if (message["kind"] != "events") continue;
      for (const auto& event : message["events"]) EXPECT_EQ(event["number"], next++);
    }
  }
  EXPECT_EQ(next, 499U) << "the last were not taken yet";
}

TEST(ClientFeed, NoticesThatEventsAreGone) {
  FeedBench bench;
  bench.taken();
  for (std::size_t i = 0; i < EventLog::capacity; ++i) bench.add_event("x");
  EXPECT_FALSE(bench.feed.has_lost_events());
  bench.add_event("one more");
  EXPECT_TRUE(bench.feed.has_lost_events());
}

TEST(ClientFeed, TellsTheStatusEverySecondAndWhenItChanges) {
  FeedBench bench;
  bench.taken();
  bench.view.set_situation({.converts = false});
  const auto changed = bench.taken();
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0]["conversion"], false);
  EXPECT_TRUE(bench.taken().empty());
  bench.now += 1s;
  EXPECT_THAT(bench.kinds(), ElementsAre("status"));
}

TEST(ClientFeed, RefusesWhatItDoesNotUnderstand) {
  for (const std::string_view text :
       {"", "{", "[]", "null", R"({"kind":"watch"})", R"({"kind":"watch","vehicle":null,"traffic":1})",
        R"({"kind":"watch","vehicle":"14:40","traffic":true})", R"({"kind":"watch","vehicle":7,"traffic":true})",
        R"({"kind":"fly","vehicle":null,"traffic":true})", R"({"kind":"watch","vehicle":null,"traffic":true,"x":1})"}) {
    FeedBench bench;
    bench.taken();
    EXPECT_TRUE(bench.feed.on_message(bench.now, text));
    const auto answer = bench.taken();
    ASSERT_EQ(answer.size(), 1U) << text;
    EXPECT_EQ(answer[0]["kind"], "refusal");
    EXPECT_THAT(answer[0]["detail"].get<std::string>(), HasSubstr("expected"));
  }
}

TEST(ClientFeed, TwentyMessagesASecondAreEnough) {
  FeedBench bench;
  for (unsigned i = 0; i < ClientFeed::messages_per_second; ++i) EXPECT_TRUE(bench.feed.on_message(bench.now, watch_all));
  EXPECT_FALSE(bench.feed.on_message(bench.now, watch_all));
  EXPECT_TRUE(bench.feed.on_message(bench.now + 1s, watch_all));
}

TEST(ClientFeed, ClientsThatAreToldTheSameShareTheText) {
  FeedBench bench;
  ClientFeed other{bench.view, Role::watch, true, "1.2.3"};
  while (other.take(bench.now)) {
  }
  bench.taken();
  EXPECT_TRUE(bench.feed.on_message(bench.now, watch_all));
  EXPECT_TRUE(other.on_message(bench.now, watch_all));
  bench.cross(Attitude{});
  bench.tick();
  other.on_tick(bench.now);
  EXPECT_EQ(bench.feed.take(bench.now), other.take(bench.now));
}

}  // namespace
}  // namespace ponte::vsm::view
