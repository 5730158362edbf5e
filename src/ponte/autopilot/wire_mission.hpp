#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/vehicle/mission.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

/// A mission as the mission protocol carries it to each autopilot, and back.
namespace ponte::autopilot {

/// The plans that are transferred each by itself; the numbers are those of MAV_MISSION_TYPE.
enum class PlanType : std::uint8_t { mission = 0, fence = 1, rally = 2 };
inline constexpr std::size_t plan_types = 3;

/// As it is transferred. Whom it goes to, its number in the plan and the type of the plan are filled in when it is
/// sent.
using WireItem = mavlink::autopilots::MissionItemInt;

/// Why a mission cannot be transferred, or not be understood.
struct WireRefusal {
  std::size_t item{};       ///< of the plan, from 0
  std::string_view what{};  ///< e.g. "parameter 5 is not a whole number"
  friend bool operator==(const WireRefusal&, const WireRefusal&) = default;
};

/// ArduPilot's item 0 of a mission is home and no item of ours.
[[nodiscard]] constexpr std::size_t home_items(Stack stack, PlanType type) {
  const bool is_ardupilot = stack == Stack::ardupilot_copter || stack == Stack::ardupilot_plane;
  return is_ardupilot && type == PlanType::mission ? 1 : 0;
}

/// The items of one of the mission's plans, as this autopilot wants them: ArduPilot's begin with home, which counts for
/// jumps. A plan without items is empty, also for ArduPilot. Patterns and speeds outside the items are not part of it.
[[nodiscard]] Result<std::vector<WireItem>, WireRefusal> to_wire(Stack stack, PlanType type,
                                                                 const vehicle::Mission& mission);

/// The inverse, which replaces that part of `mission`: `items` and, of ArduPilot, `home`; the fence; the rally points.
/// A jump to an item that there is not becomes an `OtherItem`.
[[nodiscard]] Result<void, WireRefusal> from_wire(Stack stack, PlanType type, std::span<const WireItem> items,
                                                  vehicle::Mission& mission);

}  // namespace ponte::autopilot
