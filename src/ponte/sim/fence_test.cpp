#include "ponte/sim/fence.hpp"

#include "ponte/sim/flight_rig.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace ponte::sim {
namespace {

constexpr FenceSettings uploaded{.is_enabled = true, .heeds_uploaded = true};

Position at(double north, double east, double height = 10) { return displaced(field, {north, east, -height}); }

std::vector<MissionItem> polygon(unsigned command, const std::vector<NorthEastDown>& corners) {
  std::vector<MissionItem> items;
  for (const auto& corner : corners) items.push_back(item_at(command, corner, {static_cast<float>(corners.size())}));
  return items;
}

bool allows(const std::vector<MissionItem>& items, const Position& place) {
  Fence fence;
  fence.set_items(items);
  return !fence.breach(uploaded, field, place);
}

TEST(Fence, LimitsHeightAndRadiusAboutHome) {
  const FenceSettings settings{.is_enabled = true,
                               .heeds_height = true,
                               .heeds_radius = true,
                               .most_height = Metres{100},
                               .most_radius = Metres{300}};
  const Fence fence;
  EXPECT_EQ(fence.breach(settings, field, at(200, 200, 99)), std::nullopt);
  EXPECT_EQ(fence.breach(settings, field, at(0, 0, 101)), "Max Alt");
  EXPECT_EQ(fence.breach(settings, field, at(-301, 0)), "Circle");
  auto off = settings;
  off.is_enabled = false;
  EXPECT_EQ(fence.breach(off, field, at(-301, 0, 500)), std::nullopt);
}

TEST(Fence, KeepsInsideAPolygonThatIsNotConvex) {
  // An L.
  const auto items = polygon(messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION,
                             {{-50, -50, 0}, {-50, 100, 0}, {0, 100, 0}, {0, 0, 0}, {100, 0, 0}, {100, -50, 0}});
  EXPECT_TRUE(allows(items, at(-25, 80)));
  EXPECT_TRUE(allows(items, at(80, -25)));
  EXPECT_FALSE(allows(items, at(40, 40)));
  EXPECT_FALSE(allows(items, at(-60, 0)));
  EXPECT_FALSE(allows(items, at(50, -60)));
}

TEST(Fence, KeepsOutOfAreasWithinAnother) {
  auto items = polygon(messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION,
                       {{-100, -100, 0}, {-100, 100, 0}, {100, 100, 0}, {100, -100, 0}});
  const auto hole =
      polygon(messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION, {{10, 10, 0}, {10, 60, 0}, {60, 10, 0}});
  items.insert(items.end(), hole.begin(), hole.end());
  items.push_back(item_at(messages::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION, {-50, -50, 0}, {20}));
  EXPECT_TRUE(allows(items, at(0, 0)));
  EXPECT_FALSE(allows(items, at(20, 20)));
  EXPECT_TRUE(allows(items, at(50, 50))) << "beyond the long side of the triangle";
  EXPECT_FALSE(allows(items, at(-45, -45)));
  EXPECT_FALSE(allows(items, at(0, 120)));
}

TEST(Fence, KeepsInsideACircle) {
  const std::vector items{item_at(messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, {30, 0, 0}, {50})};
  EXPECT_TRUE(allows(items, at(79, 0)));
  EXPECT_FALSE(allows(items, at(-21, 0)));
}

TEST(Fence, SurvivesWhatNoStationShouldSend) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  for (const float count : {nan, -3.0F, 0.0F, 1.0F, 2.0F, 1e9F}) {
    auto item = item_at(messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, {10, 10, 0}, {count});
    EXPECT_FALSE(allows({item, item}, at(0, 0))) << count;
    item.command = messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION;
    EXPECT_EQ(allows({item}, at(0, 0)), count > 15) << count;
  }
  EXPECT_TRUE(allows({}, at(0, 0)));
}

}  // namespace
}  // namespace ponte::sim
