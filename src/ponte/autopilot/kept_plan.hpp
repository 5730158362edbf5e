#pragma once

#include "ponte/autopilot/wire_mission.hpp"

#include <cstddef>
#include <optional>
#include <span>

/// Whether a plan that was read back is the one that was sent, in spite of what each autopilot changes.
namespace ponte::autopilot {

/// Whether both plans say the same, by every number but those of the transfer itself. The two names that MAVLink has
/// for each global frame (3 and 6) are one, and NaN equals NaN.
[[nodiscard]] bool is_same_plan(std::span<const WireItem> a, std::span<const WireItem> b);

/// The first item that is not what this autopilot keeps of the one that was sent; nothing if there is none. PX4 keeps
/// all but the name of a frame. ArduPilot has 15 bytes for each item of a mission: home is its own, heights are in
/// centimetres, navigation parameters are whole numbers or not kept at all, large radii of loiters are in tens of
/// metres, of the yaw of a landing only the sign is left, and it always goes on by itself after an item.
[[nodiscard]] std::optional<std::size_t> first_difference(Stack stack, PlanType type, std::span<const WireItem> sent,
                                                          std::span<const WireItem> kept);

}  // namespace ponte::autopilot
