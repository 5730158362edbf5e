#include "ponte/mavlink/link_statistics.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace ponte::mavlink {
namespace {

SenderStatistics after(std::initializer_list<int> sequences) {
  LinkStatistics statistics;
  for (const auto sequence : sequences)
    statistics.on_frame(SystemId{1}, ComponentId{1}, static_cast<std::uint8_t>(sequence));
  return statistics.senders()[0];
}

TEST(LinkStatistics, CountsNoLossInARowThatWrapsAround) {
  const auto sender = after({254, 255, 0, 1});
  EXPECT_EQ(sender.received, 4U);
  EXPECT_EQ(sender.lost(), 0U);
}

TEST(LinkStatistics, SumsTheGaps) {
  EXPECT_EQ(after({0, 2, 3, 10}).lost(), 7U);
  EXPECT_EQ(after({250, 5}).lost(), 10U);
  EXPECT_EQ(after({0, 200}).lost(), 199U) << "a long fade is a gap, not a late frame";
}

TEST(LinkStatistics, ForgivesALossWhenTheFrameArrivesLate) {
  const auto sender = after({1, 2, 4, 5, 3, 6});
  EXPECT_EQ(sender.lost(), 0U);
  EXPECT_EQ(sender.missed, 1U);
  EXPECT_EQ(sender.late, 1U);
  EXPECT_EQ(sender.duplicates, 0U);
}

TEST(LinkStatistics, CountsARepeatedFrameOnce) {
  const auto sender = after({1, 2, 2, 4, 3, 3, 5});
  EXPECT_EQ(sender.duplicates, 2U);
  EXPECT_EQ(sender.lost(), 0U);
  EXPECT_EQ(sender.received, 7U);
}

TEST(LinkStatistics, DoesNotForgiveWhatWasNeverMissed) {
  const auto sender = after({10, 9, 11});  // the 9 was sent before we began to listen
  EXPECT_EQ(sender.lost(), 0U);
  EXPECT_EQ(sender.late, 0U);
  EXPECT_EQ(sender.duplicates, 0U);
}

TEST(LinkStatistics, KeepsSendersApartAndSorted) {
  LinkStatistics statistics;
  statistics.on_frame(SystemId{2}, ComponentId{1}, 100);
  statistics.on_frame(SystemId{1}, ComponentId{200}, 7);
  statistics.on_frame(SystemId{1}, ComponentId{1}, 50);
  statistics.on_frame(SystemId{2}, ComponentId{1}, 102);
  const auto senders = statistics.senders();
  ASSERT_EQ(senders.size(), 3U);
  EXPECT_EQ(senders[0].component, ComponentId{1});
  EXPECT_EQ(senders[1].component, ComponentId{200});
  EXPECT_EQ(senders[2].system, SystemId{2});
  EXPECT_EQ(senders[2].lost(), 1U);
  EXPECT_EQ(senders[0].lost(), 0U);
}

TEST(LinkStatistics, StaysAsItIsUnderAFloodOfInventedSenders) {
  LinkStatistics statistics;
  for (unsigned system = 0; system < 256; ++system)
    for (unsigned component = 0; component < 256; ++component)
      statistics.on_frame(SystemId{static_cast<std::uint8_t>(system)},
                          ComponentId{static_cast<std::uint8_t>(component)}, 0);
  EXPECT_EQ(statistics.senders().size(), LinkStatistics::capacity);
  EXPECT_EQ(statistics.frames_not_counted(), 65536U - LinkStatistics::capacity);
  statistics.on_frame(SystemId{0}, ComponentId{3}, 2);
  EXPECT_EQ(statistics.senders()[3].lost(), 1U) << "those who came first are still counted";
}

}  // namespace
}  // namespace ponte::mavlink
