#pragma once

#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/sim/personality.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ponte::sim {

/// MAV_MISSION_TYPE
enum class PlanType : std::uint8_t { mission = 0, fence = 1, rally = 2 };
inline constexpr std::size_t plan_types = 3;

/// The three plans on board, in memory that is reserved once. Items are kept as this autopilot gives them back: with
/// its own index convention (ArduPilot's item 0 of a mission is home, PX4 has none) and its own frames.
class MissionStore {
 public:
  using Item = mavlink::autopilots::MissionItemInt;

  /// Missions may have so many items, or as many as this autopilot takes; fences and rally points always that many.
  explicit MissionStore(Personality personality, std::optional<std::size_t> mission_capacity = std::nullopt);

  [[nodiscard]] std::span<const Item> items(PlanType type) const { return plan(type).items; }
  /// The most items that the plan may have.
  [[nodiscard]] std::size_t capacity(PlanType type) const { return plan(type).capacity; }
  /// A number for what the plan holds, as MISSION_ACK.opaque_id tells it: 0 while it is empty, another one after each
  /// change.
  [[nodiscard]] std::uint32_t id(PlanType type) const { return plan(type).items.empty() ? 0 : plan(type).changes; }
  /// Counts the changes, also of an empty plan.
  [[nodiscard]] std::uint32_t changes(PlanType type) const { return plan(type).changes; }

  /// Replaces the plan by at most `capacity` items.
  void replace(PlanType type, std::span<const Item> items);
  /// One item of the plan, or the one after its last; at most `capacity`.
  void put(PlanType type, std::size_t index, const Item& item);
  /// Cuts the plan off after so many items.
  void truncate(PlanType type, std::size_t count);

 private:
  struct Plan {
    std::vector<Item> items;
    std::size_t capacity{};
    std::uint32_t changes{};
  };

  [[nodiscard]] const Plan& plan(PlanType type) const { return plans_[static_cast<std::size_t>(type)]; }
  [[nodiscard]] Plan& plan(PlanType type) { return plans_[static_cast<std::size_t>(type)]; }

  std::array<Plan, plan_types> plans_;
};

}  // namespace ponte::sim
