#include "ponte/autopilot/plan_file.hpp"

#include "support/bytes.hpp"

#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

TEST(PlanFile, BeginsAsArduPilotsDoes) {
  const auto file = pack_plan(PlanType::rally, std::vector<WireItem>(2));
  EXPECT_EQ(std::vector(file.begin(), file.begin() + 10), bytes("3d 76 02 00 00 00 00 00 02 00"));
  EXPECT_EQ(file.size(), 10U + 2 * 38);
}

TEST(PlanFile, GoesThereAndBack) {
  std::vector<WireItem> items{WireItem{.frame = 3, .command = 16, .param1 = 5, .x = -300'699'000, .z = 40},
                              WireItem{.command = 21, .autocontinue = 1}};
  auto back = unpack_plan(PlanType::fence, pack_plan(PlanType::fence, items)).value();
  items[1].seq = 1;
  items[0].mission_type = items[1].mission_type = 1;
  EXPECT_EQ(back, items);
}

TEST(PlanFile, IsRefusedWhenItIsNotWholeOrAnother) {
  const auto file = pack_plan(PlanType::mission, std::vector<WireItem>(1));
  for (std::size_t size = 0; size < file.size(); ++size)
    EXPECT_FALSE(unpack_plan(PlanType::mission, Bytes{file}.first(size)).has_value());
  EXPECT_EQ(unpack_plan(PlanType::rally, file), fail(std::string_view{"it has another type of plan"}));
  EXPECT_EQ(unpack_plan(PlanType::mission, bytes("3d 75 00 00 00 00 00 00 00 00")),
            fail(std::string_view{"it does not begin with the magic number"}));
  EXPECT_EQ(unpack_plan(PlanType::mission, bytes("3d 76 00 00 00 00 01 00 00 00")),
            fail(std::string_view{"it begins in the middle of the plan"}));
}

}  // namespace
}  // namespace ponte::autopilot
