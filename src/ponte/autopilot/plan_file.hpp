#pragma once

#include "ponte/autopilot/wire_mission.hpp"
#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

/// Plans as the files of ArduPilot's MAVFTP server, five times as fast as item by item on a bad link: a header of five
/// numbers of 16 bits (magic, MAV_MISSION_TYPE, options, first item, how many), then the items as in MISSION_ITEM_INT.
/// Such a file is written as a whole; whether it is on board then, `MissionClient::confirm` finds out.
namespace ponte::autopilot {

/// "@MISSION/mission.dat", "@MISSION/fence.dat" or "@MISSION/rally.dat".
[[nodiscard]] std::string_view plan_path(PlanType type);

/// The file that replaces the plan by these items, of which there are at most 65535.
[[nodiscard]] std::vector<std::byte> pack_plan(PlanType type, std::span<const WireItem> items);

/// Why a file is not the whole plan of this type, e.g. "it has another type of plan".
using PlanFileError = std::string_view;
[[nodiscard]] Result<std::vector<WireItem>, PlanFileError> unpack_plan(PlanType type, Bytes file);

}  // namespace ponte::autopilot
