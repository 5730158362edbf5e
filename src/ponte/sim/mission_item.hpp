#pragma once

#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/sim/geodesy.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace ponte::sim {

using MissionItem = mavlink::autopilots::MissionItemInt;

/// Whether the item is flown, as opposed to what is done on the way.
[[nodiscard]] bool is_navigation(const MissionItem& item);

/// Where the item is: without a place of its own (latitude and longitude 0) nothing. Altitudes above home or above the
/// ground, which is flat here, count from `home`.
[[nodiscard]] std::optional<Position> place_of(const MissionItem& item, const Position& home);

/// The altitude of the item, as `place_of` understands it.
[[nodiscard]] Metres altitude_of(const MissionItem& item, const Position& home);

/// As ArduPilot calls the command in its messages: "WP".
[[nodiscard]] std::string_view short_name(std::uint16_t command);

}  // namespace ponte::sim
