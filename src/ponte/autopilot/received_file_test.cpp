#include "ponte/autopilot/received_file.hpp"

#include "ponte/core/random.hpp"
#include "support/bytes.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ponte::autopilot {
namespace {

using Gap = ReceivedFile::Gap;

TEST(ReceivedFile, KnowsWhatIsMissing) {
  ReceivedFile file{100};
  ASSERT_TRUE(file.add(0, bytes("01 02")));
  EXPECT_EQ(file.first_gap(), std::nullopt);
  ASSERT_TRUE(file.add(6, bytes("07")));
  EXPECT_EQ(file.first_gap(), (Gap{2, 6}));
  ASSERT_TRUE(file.add(3, bytes("04 05")));
  EXPECT_EQ(file.first_gap(), (Gap{2, 3}));
  ASSERT_TRUE(file.add(2, bytes("03")));
  EXPECT_EQ(file.first_gap(), (Gap{5, 6}));
  ASSERT_TRUE(file.add(4, bytes("05 06 07")));
  EXPECT_EQ(file.first_gap(), std::nullopt);
  EXPECT_EQ(file.content(), bytes("01 02 03 04 05 06 07"));
}

TEST(ReceivedFile, HasALimit) {
  ReceivedFile file{10};
  EXPECT_TRUE(file.add(9, bytes("01")));
  EXPECT_FALSE(file.add(9, bytes("01 02")));
  EXPECT_FALSE(file.add(0xFFFF'FFFF, bytes("01")));
  EXPECT_TRUE(file.add(20, {})) << "nothing is nowhere";
}

TEST(ReceivedFileSeeded, IsWholeWhateverTheOrder) {
  Random random{chosen_seed()};
  for (int round = 0; round < 50; ++round) {
    std::vector<std::byte> whole(1 + random.below(500));
    random.fill(whole);
    ReceivedFile file{1000};
    const auto add = [&](std::size_t offset, std::size_t size) {
      ASSERT_TRUE(file.add(offset, Bytes{whole}.subspan(offset, std::min(size, whole.size() - offset))));
    };
    for (int i = 0; i < 30; ++i) add(random.below(static_cast<std::uint32_t>(whole.size())), 1 + random.below(40));
    while (const auto gap = file.first_gap()) add(gap->begin, std::min<std::size_t>(gap->end - gap->begin, 7));
    if (file.content().size() < whole.size()) add(file.content().size(), whole.size());
    ASSERT_EQ(file.content(), whole);
  }
}

}  // namespace
}  // namespace ponte::autopilot
