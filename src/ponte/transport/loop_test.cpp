#include "ponte/transport/loop.hpp"

#include "ponte/transport/test_witness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ponte::transport {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using testing::wait_for;

TEST(Loop, BeginsItsTimeAtZero) {
  const Loop loop;
  EXPECT_GE(loop.now(), Timestamp{});
  EXPECT_LT(loop.now(), Timestamp{} + testing::patience);
}

TEST(Loop, TellsTheCalendarTime) {
  const auto before = std::chrono::system_clock::now();
  EXPECT_GE(Loop::wall() + 1us, before);
  EXPECT_LT(Loop::wall(), before + testing::patience);
}

TEST(Loop, RunsUntilItIsStopped) {
  Loop loop;
  auto calls = 0;
  loop.post([&] { ++calls; });
  loop.post([&] { loop.stop(); });
  loop.run();
  EXPECT_EQ(calls, 1);

  loop.post([&] { loop.stop(); });
  loop.run();  // a stop counts once
}

TEST(Loop, StoppedBeforeARunEndsThatRunAlone) {
  Loop loop;
  auto calls = 0;
  loop.post([&] { ++calls; });
  loop.stop();
  loop.run();
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(wait_for(loop, [&] { return calls == 1; }));
}

TEST(Loop, RunsForATime) {
  Loop loop;
  loop.run_for(5ms);
  EXPECT_GE(loop.now(), Timestamp{} + 5ms);
}

TEST(Loop, SaysWhetherAConditionWasReached) {
  Loop loop;
  EXPECT_TRUE(loop.run_until([] { return true; }, 0s));
  const auto began = loop.now();
  EXPECT_FALSE(loop.run_until([] { return false; }, 5ms));
  EXPECT_GE(loop.now(), began + 5ms);
  loop.post([&] { loop.stop(); });
  EXPECT_FALSE(loop.run_until([] { return false; }, testing::patience));
}

TEST(Loop, TakesWorkFromOtherThreads) {
  Loop loop;
  auto sum = 0;
  std::vector<std::thread> threads;
  for (auto thread = 0; thread < 4; ++thread)
    threads.emplace_back([&] {
      for (auto i = 0; i < 250; ++i) loop.post([&] { ++sum; });
    });
  EXPECT_TRUE(wait_for(loop, [&] { return sum == 1000; }));
  for (auto& each : threads) each.join();

  std::thread stopper{[&] { loop.stop(); }};
  loop.run();
  stopper.join();
}

TEST(Loop, LetsExceptionsOut) {
  Loop loop;
  loop.post([] { throw std::runtime_error{"a callback failed"}; });
  EXPECT_THROW(loop.run(), std::runtime_error);
}

TEST(Loop, CallsBackOnSignals) {
  Loop loop;
  std::vector<int> signals;
  loop.on_signal([&](int signal) { signals.push_back(signal); });
  std::raise(SIGINT);
  EXPECT_TRUE(wait_for(loop, [&] { return signals.size() == 1; }));
  std::raise(SIGTERM);
  EXPECT_TRUE(wait_for(loop, [&] { return signals.size() == 2; }));
  EXPECT_THAT(signals, ElementsAre(SIGINT, SIGTERM));

  auto others = 0;
  loop.on_signal([&](int) { ++others; });
  std::raise(SIGINT);
  EXPECT_TRUE(wait_for(loop, [&] { return others == 1; }));
  EXPECT_EQ(signals.size(), 2U);
}

TEST(Timer, CallsOnceAndNotBeforeItsTime) {
  Loop loop;
  std::vector<Timestamp> calls;
  Timer timer{loop, [&](Timestamp now) { calls.push_back(now); }};
  const auto due = loop.now() + 5ms;
  timer.set(due);
  EXPECT_EQ(timer.due(), due);
  EXPECT_TRUE(wait_for(loop, [&] { return !calls.empty(); }));
  EXPECT_GE(calls.front(), due);
  EXPECT_FALSE(timer.due());
  loop.run_for(10ms);
  EXPECT_EQ(calls.size(), 1U);
}

TEST(Timer, MovesBothWays) {
  Loop loop;
  std::vector<Timestamp> calls;
  Timer timer{loop, [&](Timestamp now) { calls.push_back(now); }};
  timer.set(loop.now() + 1h);
  timer.set(loop.now() + 2ms);
  EXPECT_TRUE(wait_for(loop, [&] { return calls.size() == 1; }));

  timer.set(loop.now() + 2ms);
  const auto later = loop.now() + 20ms;
  timer.set(later);
  EXPECT_TRUE(wait_for(loop, [&] { return calls.size() == 2; }));
  EXPECT_GE(calls.back(), later);
}

TEST(Timer, DoesNotCallWhenCleared) {
  Loop loop;
  auto calls = 0;
  Timer timer{loop, [&](Timestamp) { ++calls; }};
  timer.set(loop.now() + 2ms);
  timer.clear();
  loop.run_for(10ms);
  timer.set(loop.now() + 2ms);
  timer.set(std::nullopt);
  loop.run_for(10ms);
  EXPECT_EQ(calls, 0);
  timer.set(std::optional{loop.now()});
  EXPECT_TRUE(wait_for(loop, [&] { return calls == 1; }));
}

TEST(Timer, BearsTheEndsOfTime) {
  Loop loop;
  auto calls = 0;
  Timer timer{loop, [&](Timestamp) { ++calls; }};
  timer.set(Timestamp::max());
  loop.run_for(5ms);
  EXPECT_EQ(calls, 0);
  timer.set(Timestamp::min());
  EXPECT_EQ(calls, 0) << "never within set";
  EXPECT_TRUE(wait_for(loop, [&] { return calls == 1; }));
}

TEST(Timer, MayBeSetAndDestroyedByItsCallback) {
  Loop loop;
  auto calls = 0;
  std::unique_ptr<Timer> timer;
  timer = std::make_unique<Timer>(loop, [&](Timestamp now) {
    if (++calls < 3) {
      timer->set(now);
    } else {
      timer.reset();
    }
  });
  timer->set(loop.now());
  EXPECT_TRUE(wait_for(loop, [&] { return timer == nullptr; }));
  EXPECT_EQ(calls, 3);
}

TEST(Timer, IsSilentOnceDestroyed) {
  Loop loop;
  auto calls = 0;
  {
    Timer timer{loop, [&](Timestamp) { ++calls; }};
    timer.set(loop.now());
  }
  loop.run_for(5ms);
  EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace ponte::transport
