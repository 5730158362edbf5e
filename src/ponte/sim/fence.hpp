#pragma once

#include "ponte/core/quantity.hpp"
#include "ponte/sim/mission_item.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace ponte::sim {

/// Which fences are in force, besides those that were uploaded, as the parameters say.
struct FenceSettings {
  bool is_enabled{};
  bool heeds_height{};
  bool heeds_radius{};
  bool heeds_uploaded{};  ///< polygons and circles
  Metres most_height{};   ///< above home; 0: any
  Metres most_radius{};   ///< about home; 0: any
};

/// Where a vehicle may fly.
class Fence {
 public:
  /// The items as they are stored (NAV_FENCE_*), which stay valid until the next call.
  void set_items(std::span<const MissionItem> items) { items_ = items; }

  /// The first fence that is broken, as ArduPilot names it ("Max Alt", "Circle", "Polygon"), or nothing.
  [[nodiscard]] std::optional<std::string_view> breach(const FenceSettings& settings, const Position& home,
                                                       const Position& place) const;

 private:
  [[nodiscard]] bool allows(const Position& place) const;

  std::span<const MissionItem> items_;
};

}  // namespace ponte::sim
