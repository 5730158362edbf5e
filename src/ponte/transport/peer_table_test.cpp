#include "ponte/transport/peer_table.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace ponte::transport {
namespace {

using namespace std::chrono_literals;

constexpr Timestamp start{};

TEST(PeerTable, KnowsAPeerByAddressAndById) {
  PeerTable<std::string> table{2, 10s};
  EXPECT_EQ(table.hear(start, "a"), nullptr);
  EXPECT_EQ(table.add(start, PeerId{7}, "a").id, PeerId{7});
  ASSERT_NE(table.hear(start, "a"), nullptr);
  EXPECT_EQ(table.hear(start, "a")->id, PeerId{7});
  ASSERT_NE(table.find(PeerId{7}), nullptr);
  EXPECT_EQ(table.find(PeerId{7})->address, "a");
  EXPECT_EQ(table.find(PeerId{8}), nullptr);
}

TEST(PeerTable, IsFullAtItsLimit) {
  PeerTable<std::string> table{2, 10s};
  table.add(start, PeerId{1}, "a");
  EXPECT_FALSE(table.full());
  table.add(start, PeerId{2}, "b");
  EXPECT_TRUE(table.full());
}

TEST(PeerTable, GivesUpTheSilentAtTheLimitAndNotBefore) {
  PeerTable<std::string> table{3, 10s};
  EXPECT_FALSE(table.next_deadline());
  table.add(start, PeerId{1}, "a");
  table.add(start + 1s, PeerId{2}, "b");
  EXPECT_EQ(table.next_deadline(), start + 10s);
  static_cast<void>(table.hear(start + 5s, "a"));
  EXPECT_EQ(table.next_deadline(), start + 11s);

  EXPECT_TRUE(table.take_silent(start + 11s - 1ns).empty());
  const auto silent = table.take_silent(start + 11s);
  ASSERT_EQ(silent.size(), 1U);
  EXPECT_EQ(silent[0].id, PeerId{2});
  EXPECT_TRUE(table.take_silent(start + 11s).empty());
  EXPECT_EQ(table.all().size(), 1U);
  EXPECT_EQ(table.hear(start + 12s, "b"), nullptr);
}

}  // namespace
}  // namespace ponte::transport
