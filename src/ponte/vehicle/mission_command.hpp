#pragma once

#include "ponte/vehicle/mission.hpp"

#include <optional>

/// Mission items as MAVLink numbers them. QGroundControl's and Mission Planner's files use the same numbers, so that
/// `planning` needs them as well as `autopilot`, and neither knows the other.
namespace ponte::vehicle {

/// A command and its seven parameters are what an `OtherItem` has.
using MissionCommand = OtherItem;

/// What the command means. What Ponte's items cannot say wholly becomes an `OtherItem`; a place of 0, 0 means none, as
/// it does to both autopilots. Parameter 1 of a jump (MAV_CMD_DO_JUMP) is taken as the index of the target item.
[[nodiscard]] Action interpret(const MissionCommand& command);

/// The inverse: the frame is MAV_FRAME_GLOBAL, ..._RELATIVE_ALT or ..._TERRAIN_ALT (0, 3, 10), or MAV_FRAME_MISSION (2)
/// for what has no place; an absent place or yaw is NaN; unused parameters are 0.
[[nodiscard]] MissionCommand express(const Action& action);

/// True when parameters 5 to 7 of this MAV_CMD are a latitude, a longitude and an altitude.
[[nodiscard]] bool has_place(std::uint16_t command);

/// The altitude frame of a MAV_FRAME; nothing for those that are not global.
[[nodiscard]] std::optional<AltitudeFrame> altitude_frame(std::uint8_t mav_frame);
[[nodiscard]] std::uint8_t mav_frame(AltitudeFrame frame);

}  // namespace ponte::vehicle
