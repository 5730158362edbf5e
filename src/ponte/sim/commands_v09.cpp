#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/v09/action.hpp"
#include "ponte/mavlink/v09/action_ack.hpp"
#include "ponte/mavlink/v09/enums.hpp"
#include "ponte/mavlink/v09/request_data_stream.hpp"
#include "ponte/mavlink/v09/set_mode.hpp"
#include "ponte/mavlink/v09/set_nav_mode.hpp"
#include "ponte/sim/autopilot.hpp"

#include <optional>

/// What a station asks for in MAVLink 0.9, as the commands of today that mean the same.
namespace ponte::sim {

namespace messages = mavlink::autopilots;
namespace v09 = mavlink::v09;

namespace {

std::optional<FlightMode> flight_mode_of_action(std::uint8_t action) {
  switch (action) {
    case v09::MAV_ACTION_SET_MANUAL: return FlightMode::stabilize;
    case v09::MAV_ACTION_SET_AUTO:
    case v09::MAV_ACTION_CONTINUE: return FlightMode::automatic;
    case v09::MAV_ACTION_HOLD:
    case v09::MAV_ACTION_HALT:
    case v09::MAV_ACTION_LOITER: return FlightMode::loiter;
    case v09::MAV_ACTION_RETURN: return FlightMode::rtl;
    case v09::MAV_ACTION_LAND:
    case v09::MAV_ACTION_EMCY_LAND: return FlightMode::land;
    default: return std::nullopt;
  }
}

std::optional<FlightMode> flight_mode_of_mode(std::uint8_t mode) {
  switch (mode) {
    case v09::MAV_MODE_MANUAL: return FlightMode::stabilize;
    case v09::MAV_MODE_GUIDED: return FlightMode::guided;
    case v09::MAV_MODE_AUTO: return FlightMode::automatic;
    default: return std::nullopt;
  }
}

std::optional<FlightMode> flight_mode_of_nav_mode(std::uint8_t nav_mode) {
  switch (nav_mode) {
    case v09::MAV_NAV_HOLD:
    case v09::MAV_NAV_LOITER: return FlightMode::loiter;
    case v09::MAV_NAV_WAYPOINT: return FlightMode::automatic;
    case v09::MAV_NAV_RETURNING: return FlightMode::rtl;
    case v09::MAV_NAV_LANDING: return FlightMode::land;
    default: return std::nullopt;
  }
}

}  // namespace

void Autopilot::on_frame_v09(const mavlink::FrameView& frame, Call& call) {
  const auto change_mode = [&](std::uint8_t target, std::optional<FlightMode> mode) {
    if (!is_for_us(target)) return;
    if (!mode)
      call.speaker.say(messages::MAV_SEVERITY_WARNING, "No such mode");
    else
      (void)enter(*mode, call);  // which says so if it fails; nothing else acknowledges it in this version
  };
  if (mavlink::carries<v09::Action>(frame)) {
    const auto wish = mavlink::decode<v09::Action>(frame);
    if (!is_for_us(wish.target)) return;
    const bool done = act(wish.action, call) == messages::MAV_RESULT_ACCEPTED;
    call.speaker.send(v09::ActionAck{.action = wish.action, .result = static_cast<std::uint8_t>(done ? 1 : 0)});
  } else if (mavlink::carries<v09::SetMode>(frame)) {
    const auto wish = mavlink::decode<v09::SetMode>(frame);
    change_mode(wish.target, flight_mode_of_mode(wish.mode));
  } else if (mavlink::carries<v09::SetNavMode>(frame)) {
    const auto wish = mavlink::decode<v09::SetNavMode>(frame);
    change_mode(wish.target, flight_mode_of_nav_mode(wish.nav_mode));
  } else if (mavlink::carries<v09::RequestDataStream>(frame)) {
    request_stream(mavlink::decode<v09::RequestDataStream>(frame));
  }
}

/// A MAV_RESULT.
std::uint8_t Autopilot::act(std::uint8_t action, Call& call) {
  if (const auto mode = flight_mode_of_action(action)) return enter(*mode, call);
  const auto command = [](unsigned number, float param1, float height = 0) {
    return Command{.number = static_cast<std::uint16_t>(number), .param1 = param1, .z = height};
  };
  switch (action) {
    case v09::MAV_ACTION_MOTORS_START: return arm_or_disarm(command(messages::MAV_CMD_COMPONENT_ARM_DISARM, 1), call);
    case v09::MAV_ACTION_MOTORS_STOP: return arm_or_disarm(command(messages::MAV_CMD_COMPONENT_ARM_DISARM, 0), call);
    case v09::MAV_ACTION_LAUNCH:
    case v09::MAV_ACTION_TAKEOFF: {
      const auto height = static_cast<float>(config_.square.height.value);
      return take_off(command(messages::MAV_CMD_NAV_TAKEOFF, 0, height), call);
    }
    case v09::MAV_ACTION_REBOOT: return reboot(command(messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, 1), call);
    default: return messages::MAV_RESULT_UNSUPPORTED;
  }
}

}  // namespace ponte::sim
