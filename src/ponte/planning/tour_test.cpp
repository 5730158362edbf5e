#include "ponte/planning/tour.hpp"

#include "ponte/core/random.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ponte::planning {
namespace {

std::vector<Tour::City> cities(const Tour& tour, Tour::City from) {
  std::vector<Tour::City> result;
  for (auto city = from; result.empty() || city != from; city = tour.next(city)) result.push_back(city);
  return result;
}

TEST(Tour, TurnsAPartRound) {
  Tour tour{{0, 1, 2, 3, 4, 5, 6}};
  tour.reverse(1, 3);
  EXPECT_EQ(cities(tour, 0), (std::vector<Tour::City>{0, 3, 2, 1, 4, 5, 6}));
}

TEST(Tour, TurnsALongPartRoundAsIfTheRestWereNotTouched) {
  Tour tour{{0, 1, 2, 3, 4, 5, 6}};
  tour.reverse(5, 3);
  EXPECT_EQ(cities(tour, 4), (std::vector<Tour::City>{4, 3, 2, 1, 0, 6, 5}));
}

TEST(Tour, GoesTheOtherWayRoundInTheMirror) {
  Tour tour{{0, 1, 2, 3}};
  tour.mirror();
  EXPECT_EQ(cities(tour, 0), (std::vector<Tour::City>{0, 3, 2, 1}));
  EXPECT_EQ(tour.ahead(0, 3), 1U);
}

// A plain vector, turned round by the standard library, is the judge.
TEST(TourSeeded, AgreesWithAVectorAndTakesEverythingBack) {
  const auto seed = chosen_seed();
  Random random{seed};
  for (int round = 0; round < 300; ++round) {
    const auto size = 5 + random.below(20);
    std::vector<Tour::City> order(size);
    for (Tour::City city = 0; city < size; ++city) order[city] = city;
    Tour tour{order};
    for (int turn = 0; turn < 10; ++turn) {
      const auto first = order[random.below(size)];
      const auto last = tour.ahead(first, random.below(size - 1));
      tour.reverse(first, last);
      std::ranges::rotate(order, std::ranges::find(order, first));
      std::reverse(order.begin(), std::next(std::ranges::find(order, last)));
      ASSERT_EQ(cities(tour, order[0]), order) << "seed " << seed << ", round " << round;
    }
    while (tour.turns() > 0) tour.take_back();
    std::ranges::sort(order);
    ASSERT_EQ(cities(tour, 0), order) << "seed " << seed << ", round " << round;
  }
}

}  // namespace
}  // namespace ponte::planning
