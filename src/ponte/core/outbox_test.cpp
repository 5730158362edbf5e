#include "ponte/core/outbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<int> drained(Outbox<int>& outbox) {
  std::vector<int> entries;
  outbox.drain([&](int entry) { entries.push_back(entry); });
  return entries;
}

TEST(Outbox, GivesUpItsOldestEntryWhenItIsFull) {
  Outbox<int> outbox{2};
  for (const int entry : {1, 2, 3}) outbox.push(entry);
  EXPECT_EQ(outbox.overwritten(), 1U);
  EXPECT_THAT(drained(outbox), ElementsAre(2, 3));
  EXPECT_THAT(drained(outbox), IsEmpty());
}

TEST(Outbox, IsReusedWithoutEnd) {
  Outbox<int> outbox{2};
  for (int entry = 0; entry < 5; ++entry) {
    outbox.push(entry);
    EXPECT_THAT(drained(outbox), ElementsAre(entry));
  }
  EXPECT_EQ(outbox.overwritten(), 0U);
}

}  // namespace
}  // namespace ponte
