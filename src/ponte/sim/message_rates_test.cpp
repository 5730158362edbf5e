#include "ponte/sim/message_rates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace ponte::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Row {
  Rate rate;
};
constexpr std::array rows{Row{{Stream::none, 1s}}, Row{{Stream::extra1}}, Row{{Stream::extra1}},
                          Row{{Stream::position}}, Row{{Stream::none}}};
enum Message : std::size_t { heartbeat, attitude, simulation, position, home };

class MessageRatesTest : public ::testing::Test {
 protected:
  /// How often each message is due in the steps up to `until`.
  std::vector<int> due(Duration until) {
    std::vector<int> counts(rows.size());
    while (now_ < until) {
      now_ += 20ms;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rates_.take_due(i, now_)) ++counts[i];
    }
    return counts;
  }

  MessageRates rates_{std::span<const Row>{rows}};
  Duration now_{};
};

TEST_F(MessageRatesTest, SendsOnlyTheHeartbeatUnasked) { EXPECT_THAT(due(10s), ElementsAre(10, 0, 0, 0, 0)); }

TEST_F(MessageRatesTest, StartsAndStopsTheMessagesOfAStream) {
  rates_.request_stream(Stream::extra1, 4, now_);
  EXPECT_THAT(due(10s), ElementsAre(10, 40, 40, 0, 0));
  rates_.request_stream(Stream::extra1, 0, now_);
  EXPECT_THAT(due(20s), ElementsAre(10, 0, 0, 0, 0));
}

TEST_F(MessageRatesTest, StartsAllStreamsTogetherButNotWhatIsInNone) {
  rates_.request_stream(Stream::all, 2, now_);
  EXPECT_THAT(due(10s), ElementsAre(10, 20, 20, 20, 0));
}

TEST_F(MessageRatesTest, IgnoresUnknownStreams) {
  rates_.request_stream(static_cast<Stream>(99), 2, now_);
  rates_.request_stream(Stream::none, 2, now_);
  EXPECT_THAT(due(10s), ElementsAre(10, 0, 0, 0, 0));
}

TEST_F(MessageRatesTest, SendsOneMessageOftenerThanItsStream) {
  rates_.request_stream(Stream::extra1, 2, now_);
  rates_.set_interval(attitude, 100ms, now_);
  EXPECT_THAT(due(10s), ElementsAre(10, 100, 20, 0, 0));
  rates_.reset_interval(attitude, now_);
  EXPECT_THAT(due(20s), ElementsAre(10, 20, 20, 0, 0));
  rates_.set_interval(attitude, std::nullopt, now_);
  EXPECT_THAT(due(30s), ElementsAre(10, 0, 20, 0, 0));
}

TEST_F(MessageRatesTest, LetsALaterStreamRequestWin) {
  rates_.set_interval(attitude, 100ms, now_);
  rates_.request_stream(Stream::all, 1, now_);
  EXPECT_THAT(due(10s), ElementsAre(10, 10, 10, 10, 0));
}

TEST_F(MessageRatesTest, KeepsTheAverageOfAnIntervalBetweenTwoSteps) {
  rates_.set_interval(home, 30ms, now_);
  EXPECT_THAT(due(30s), ElementsAre(30, 0, 0, 0, 1000));
}

TEST_F(MessageRatesTest, SendsNothingOftenerThanItChanges) {
  rates_.request_stream(Stream::position, 65535, now_);
  EXPECT_THAT(due(10s), ElementsAre(10, 0, 0, 500, 0));
}

TEST_F(MessageRatesTest, IsNotHeldUpByAStationThatAsksAgainAndAgain) {
  int count{};
  for (int tenth = 1; tenth <= 100; ++tenth) {
    rates_.set_interval(home, 1s, now_);
    count += due(tenth * 100ms)[home];
  }
  EXPECT_EQ(count, 10);
}

TEST_F(MessageRatesTest, DoesNotMakeUpForWhatItMissed) {
  rates_.set_interval(home, 1s, now_);
  EXPECT_TRUE(rates_.take_due(home, 1s));
  EXPECT_TRUE(rates_.take_due(home, 100s));
  EXPECT_FALSE(rates_.take_due(home, 100s + 20ms));
}

}  // namespace
}  // namespace ponte::sim
