#pragma once

#include "ponte/core/result.hpp"
#include "ponte/mavlink/autopilots/mission_item.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/sim/mission_store.hpp"
#include "ponte/sim/personality.hpp"

#include <cstdint>

/// Which items each autopilot takes, and what becomes of their numbers on the way in and out.
namespace ponte::sim {

/// The item as this autopilot stores it, or the MAV_MISSION_RESULT with which it refuses it. ArduPilot keeps what fits
/// into its 15 bytes per item; PX4 keeps all numbers, and frames of whole degrees become those of integers.
[[nodiscard]] Result<MissionStore::Item, std::uint8_t> stored_item(Personality personality, PlanType type,
                                                                   const MissionStore::Item& item);

// Between the two forms of an item, with the rounding of this autopilot's arithmetic.
[[nodiscard]] mavlink::autopilots::MissionItemInt to_integers(Personality personality,
                                                              const mavlink::autopilots::MissionItem& item);
[[nodiscard]] mavlink::autopilots::MissionItem to_floats(Personality personality,
                                                         const mavlink::autopilots::MissionItemInt& item);

}  // namespace ponte::sim
