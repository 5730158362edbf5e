#include "ponte/sim/mission_rules.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

using Item = MissionStore::Item;

/// A command of missions; with a place it needs a frame that has one.
struct Command {
  unsigned number;
  bool has_place;
  unsigned nan_parameters;  ///< bit n: ArduPilot takes a NaN as parameter n + 1
};

constexpr unsigned fourth = 1U << 3;

constexpr std::array mission_commands{
    Command{messages::MAV_CMD_NAV_WAYPOINT, true, fourth},
    Command{messages::MAV_CMD_NAV_LOITER_UNLIM, true, fourth},
    Command{messages::MAV_CMD_NAV_LOITER_TURNS, true, fourth},
    Command{messages::MAV_CMD_NAV_LOITER_TIME, true, fourth},
    Command{messages::MAV_CMD_NAV_RETURN_TO_LAUNCH, false, 0},
    Command{messages::MAV_CMD_NAV_LAND, true, 1U | fourth},
    Command{messages::MAV_CMD_NAV_TAKEOFF, true, fourth},
    Command{messages::MAV_CMD_NAV_LOITER_TO_ALT, true, 0},
    Command{messages::MAV_CMD_NAV_DELAY, false, 0},
    Command{messages::MAV_CMD_CONDITION_DELAY, false, 0},
    Command{messages::MAV_CMD_CONDITION_DISTANCE, false, 0},
    Command{messages::MAV_CMD_CONDITION_YAW, false, 0},
    Command{messages::MAV_CMD_DO_JUMP, false, 0},
    Command{messages::MAV_CMD_DO_CHANGE_SPEED, false, 0},
    Command{messages::MAV_CMD_DO_SET_HOME, true, 0},
    Command{messages::MAV_CMD_DO_SET_SERVO, false, 0},
    Command{messages::MAV_CMD_DO_LAND_START, false, 0},
    Command{messages::MAV_CMD_DO_SET_ROI_LOCATION, true, 0},
    Command{messages::MAV_CMD_DO_SET_ROI_NONE, false, 0},
    Command{messages::MAV_CMD_DO_SET_ROI, true, 0},
    Command{messages::MAV_CMD_DO_DIGICAM_CONTROL, false, 0},
    Command{messages::MAV_CMD_DO_MOUNT_CONTROL, false, 0},
    Command{messages::MAV_CMD_DO_SET_CAM_TRIGG_DIST, false, 0},
    Command{messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW, false, 0x1F},
    Command{messages::MAV_CMD_IMAGE_START_CAPTURE, false, 0},
    Command{messages::MAV_CMD_IMAGE_STOP_CAPTURE, false, 0},
};

constexpr std::array fence_commands{
    Command{messages::MAV_CMD_NAV_FENCE_RETURN_POINT, true, 0},
    Command{messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, true, 0},
    Command{messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION, true, 0},
    Command{messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, true, 0},
    Command{messages::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION, true, 0},
};

constexpr std::array rally_commands{Command{messages::MAV_CMD_NAV_RALLY_POINT, true, 0}};

std::span<const Command> commands_of(PlanType type) {
  switch (type) {
    case PlanType::mission: return mission_commands;
    case PlanType::fence: return fence_commands;
    case PlanType::rally: return rally_commands;
  }
  return {};
}

constexpr std::array whole_degree_frames{messages::MAV_FRAME_GLOBAL, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
                                         messages::MAV_FRAME_GLOBAL_TERRAIN_ALT};
constexpr std::array integer_frames{messages::MAV_FRAME_GLOBAL_INT, messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
                                    messages::MAV_FRAME_GLOBAL_TERRAIN_ALT_INT};

/// The other name of the same frame: `from[i]` becomes `to[i]`.
template <std::size_t Size, class Frame>
std::uint8_t renamed(std::uint8_t frame, const std::array<Frame, Size>& from, const std::array<Frame, Size>& to) {
  const auto found = std::find(from.begin(), from.end(), frame);
  return found == from.end() ? frame : static_cast<std::uint8_t>(to[static_cast<std::size_t>(found - from.begin())]);
}

bool has_global_frame(const Item& item) {
  const auto is_among = [&](const auto& frames) {
    return std::find(frames.begin(), frames.end(), item.frame) != frames.end();
  };
  return is_among(whole_degree_frames) || is_among(integer_frames);
}

/// ArduPilot looks at the frame only where there is a place, and to it "no frame" means above the sea.
bool takes_frame(Personality personality, const Command& command, const Item& item) {
  if (has_global_frame(item)) return true;
  if (personality == Personality::px4) return item.frame == messages::MAV_FRAME_MISSION && !command.has_place;
  return item.frame == messages::MAV_FRAME_MISSION || !command.has_place;
}

std::array<float, 4> parameters_of(const Item& item) { return {item.param1, item.param2, item.param3, item.param4}; }

/// A MAV_MISSION_RESULT if the place is nowhere on Earth.
std::optional<std::uint8_t> refusal_of_place(const Item& item) {
  constexpr std::int32_t right_angle = 900'000'000;  // degrees, 1e-7
  constexpr float highest = 83'000;                  // m, what ArduPilot can store
  if (item.x < -right_angle || item.x > right_angle) return messages::MAV_MISSION_INVALID_PARAM5_X;
  if (item.y < -2 * right_angle || item.y > 2 * right_angle) return messages::MAV_MISSION_INVALID_PARAM6_Y;
  if (!(std::abs(item.z) <= highest)) return messages::MAV_MISSION_INVALID_PARAM7;
  return std::nullopt;
}

/// ArduPilot keeps whole seconds of a delay, centimetres of a height, and which way a landing circles; what a copter
/// has no use for comes back as 0.
Item as_ardupilot_stores(Item item) {
  item.frame = renamed(item.frame, integer_frames, whole_degree_frames);
  item.current = 0;
  item.autocontinue = 1;
  item.z = std::trunc(item.z * 100) / 100;
  if (item.command == messages::MAV_CMD_NAV_WAYPOINT) {
    item.param1 = std::trunc(std::clamp(item.param1, 0.0F, 65535.0F));
    item.param2 = item.param3 = 0;
  }
  if (std::isnan(item.param1)) item.param1 = 0;
  if (std::isnan(item.param4)) item.param4 = 0;
  if (item.command == messages::MAV_CMD_NAV_LAND) item.param4 = item.param4 < 0 ? -1 : 1;
  return item;
}

}  // namespace

Result<Item, std::uint8_t> stored_item(Personality personality, PlanType type, const Item& item) {
  const auto refused = [](unsigned result) { return fail(static_cast<std::uint8_t>(result)); };
  const auto commands = commands_of(type);
  const auto command =
      std::find_if(commands.begin(), commands.end(), [&](const Command& each) { return each.number == item.command; });
  if (command == commands.end()) return refused(messages::MAV_MISSION_UNSUPPORTED);

  if (personality == Personality::ardupilot) {
    const auto parameters = parameters_of(item);
    for (unsigned i = 0; i < parameters.size(); ++i)
      if (!std::isfinite(parameters[i]) && !(std::isnan(parameters[i]) && (command->nan_parameters >> i & 1U) != 0))
        return refused(messages::MAV_MISSION_INVALID_PARAM1 + i);
  }
  if (!takes_frame(personality, *command, item)) return refused(messages::MAV_MISSION_UNSUPPORTED_FRAME);
  if (command->has_place)
    if (const auto refusal = refusal_of_place(item)) return fail(*refusal);

  auto stored = item;
  stored.target_system = stored.target_component = 0;
  if (personality == Personality::px4) {
    stored.frame = renamed(item.frame, whole_degree_frames, integer_frames);
    return stored;
  }
  return type == PlanType::mission ? as_ardupilot_stores(stored) : stored;
}

messages::MissionItemInt to_integers(Personality personality, const messages::MissionItem& item) {
  const auto integer = [&](float degrees) {
    // ArduPilot multiplies in single precision, which rounds to 32 units and more.
    const double scaled = personality == Personality::ardupilot ? double{degrees * 1e7F} : double{degrees} * 1e7;
    using Limits = std::numeric_limits<std::int32_t>;
    if (std::isnan(scaled)) return Limits::max();
    return static_cast<std::int32_t>(std::clamp(scaled, double{Limits::min()}, double{Limits::max()}));
  };
  return {.target_system = item.target_system,
          .target_component = item.target_component,
          .seq = item.seq,
          .frame = item.frame,
          .command = item.command,
          .current = item.current,
          .autocontinue = item.autocontinue,
          .param1 = item.param1,
          .param2 = item.param2,
          .param3 = item.param3,
          .param4 = item.param4,
          .x = integer(item.x),
          .y = integer(item.y),
          .z = item.z,
          .mission_type = item.mission_type};
}

messages::MissionItem to_floats(Personality personality, const messages::MissionItemInt& item) {
  const auto degrees = [&](std::int32_t integer) {
    return personality == Personality::ardupilot ? static_cast<float>(integer) * 1e-7F
                                                 : static_cast<float>(integer * 1e-7);
  };
  return {.target_system = item.target_system,
          .target_component = item.target_component,
          .seq = item.seq,
          .frame = renamed(item.frame, integer_frames, whole_degree_frames),
          .command = item.command,
          .current = item.current,
          .autocontinue = item.autocontinue,
          .param1 = item.param1,
          .param2 = item.param2,
          .param3 = item.param3,
          .param4 = item.param4,
          .x = degrees(item.x),
          .y = degrees(item.y),
          .z = item.z,
          .mission_type = item.mission_type};
}

}  // namespace ponte::sim
