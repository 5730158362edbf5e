#include "ponte/sim/mission_item.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <array>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

struct CommandName {
  std::uint16_t command;
  std::string_view name;
};

constexpr auto names = std::to_array<CommandName>({
    {messages::MAV_CMD_NAV_WAYPOINT, "WP"},
    {messages::MAV_CMD_NAV_LOITER_UNLIM, "LoitUnlim"},
    {messages::MAV_CMD_NAV_LOITER_TURNS, "LoitTurns"},
    {messages::MAV_CMD_NAV_LOITER_TIME, "LoitTime"},
    {messages::MAV_CMD_NAV_RETURN_TO_LAUNCH, "RTL"},
    {messages::MAV_CMD_NAV_LAND, "Land"},
    {messages::MAV_CMD_NAV_TAKEOFF, "Takeoff"},
    {messages::MAV_CMD_NAV_LOITER_TO_ALT, "LoitAltitude"},
    {messages::MAV_CMD_NAV_SPLINE_WAYPOINT, "SplineWP"},
    {messages::MAV_CMD_NAV_DELAY, "Delay"},
    {messages::MAV_CMD_CONDITION_DELAY, "CondDelay"},
    {messages::MAV_CMD_CONDITION_DISTANCE, "CondDist"},
    {messages::MAV_CMD_CONDITION_YAW, "CondYaw"},
    {messages::MAV_CMD_DO_CHANGE_SPEED, "ChangeSpeed"},
    {messages::MAV_CMD_DO_SET_ROI, "SetROI"},
    {messages::MAV_CMD_DO_SET_ROI_LOCATION, "SetROI"},
    {messages::MAV_CMD_DO_SET_ROI_NONE, "SetROI"},
});

/// Frames whose altitudes count from mean sea level; those of all others count from home.
bool is_above_sea(std::uint8_t frame) {
  return frame == messages::MAV_FRAME_GLOBAL || frame == messages::MAV_FRAME_GLOBAL_INT;
}

}  // namespace

bool is_navigation(const MissionItem& item) { return item.command <= messages::MAV_CMD_NAV_LAST; }

std::optional<Position> place_of(const MissionItem& item, const Position& home) {
  if (item.x == 0 && item.y == 0) return std::nullopt;
  constexpr double degrees = 1e-7;
  return Position{radians_from_degrees(item.x * degrees), radians_from_degrees(item.y * degrees),
                  altitude_of(item, home)};
}

Metres altitude_of(const MissionItem& item, const Position& home) {
  const Metres altitude{item.z};
  return is_above_sea(item.frame) ? altitude : home.altitude_msl + altitude;
}

std::string_view short_name(std::uint16_t command) {
  const auto found = std::ranges::find(names, command, &CommandName::command);
  return found == names.end() ? "?" : found->name;
}

}  // namespace ponte::sim
