#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/sim/autopilot.hpp"

/// The commands of the autopilot, with each one's answers to them.
namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr Duration calibration_lasts = std::chrono::seconds{2};

}  // namespace

void Autopilot::on_command(const Command& command, Call& call) {
  const auto result = execute(command, call);
  acknowledge(command.number, result, call.requester, call.speaker);
  if (result == messages::MAV_RESULT_ACCEPTED) send_requested(command, call);
}

std::uint8_t Autopilot::execute(const Command& command, Call& call) {
  switch (command.number) {
    case messages::MAV_CMD_COMPONENT_ARM_DISARM: return arm_or_disarm(command, call);
    case messages::MAV_CMD_RUN_PREARM_CHECKS: return messages::MAV_RESULT_ACCEPTED;

    case messages::MAV_CMD_NAV_TAKEOFF: return take_off(command, call);
    case messages::MAV_CMD_NAV_RETURN_TO_LAUNCH: return enter(FlightMode::rtl, call);
    case messages::MAV_CMD_NAV_LAND: return enter(FlightMode::land, call);
    case messages::MAV_CMD_NAV_LOITER_UNLIM: return enter(FlightMode::loiter, call);
    case messages::MAV_CMD_DO_SET_MODE: return do_set_mode(command, call);
    case messages::MAV_CMD_DO_REPOSITION: return reposition(command, call);
    case messages::MAV_CMD_DO_ORBIT: return orbit(command, call);
    case messages::MAV_CMD_CONDITION_YAW: return turn(command, call);
    case messages::MAV_CMD_DO_CHANGE_SPEED: return change_speed(command, call);
    case messages::MAV_CMD_DO_SET_HOME: return set_home(command, call);
    case messages::MAV_CMD_MISSION_START: return start_mission(command, call);
    case messages::MAV_CMD_DO_PAUSE_CONTINUE: return pause_or_continue(command, call);
    case messages::MAV_CMD_DO_SET_MISSION_CURRENT: return set_mission_item(command, call);

    case messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW:
    case messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE:
    case messages::MAV_CMD_DO_MOUNT_CONFIGURE:
    case messages::MAV_CMD_DO_MOUNT_CONTROL: return point_gimbal(command, call);
    case messages::MAV_CMD_DO_SET_ROI:
    case messages::MAV_CMD_DO_SET_ROI_LOCATION:
    case messages::MAV_CMD_DO_SET_ROI_NONE: return look_at(command);

    case messages::MAV_CMD_SET_MESSAGE_INTERVAL: return set_message_interval(command, call);
    case messages::MAV_CMD_GET_MESSAGE_INTERVAL: return tell_message_interval(command, call);
    case messages::MAV_CMD_REQUEST_MESSAGE:
      return row_named_by(command.param1) ? messages::MAV_RESULT_ACCEPTED : messages::MAV_RESULT_FAILED;
    case messages::MAV_CMD_GET_HOME_POSITION:
      return snapshot_.has_position ? messages::MAV_RESULT_ACCEPTED : messages::MAV_RESULT_FAILED;
    case messages::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES:
      return is_px4() ? messages::MAV_RESULT_UNSUPPORTED : messages::MAV_RESULT_ACCEPTED;

    case messages::MAV_CMD_PREFLIGHT_CALIBRATION: return calibrate(command, call);
    case messages::MAV_CMD_PREFLIGHT_STORAGE: return messages::MAV_RESULT_ACCEPTED;  // nothing is volatile here
    case messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN: return reboot(command, call);
    default: return messages::MAV_RESULT_UNSUPPORTED;
  }
}

/// Of the gyroscopes (parameter 1) or the barometer (parameter 3), which takes a while. Others need hands.
std::uint8_t Autopilot::calibrate(const Command& command, Call& call) {
  if (snapshot_.armed || running_) return messages::MAV_RESULT_TEMPORARILY_REJECTED;
  if (command.param1 != 1 && command.param3 != 1) return messages::MAV_RESULT_UNSUPPORTED;
  running_ = {
      .command = command.number, .requester = call.requester, .done_at = snapshot_.since_boot + calibration_lasts};
  return messages::MAV_RESULT_IN_PROGRESS;
}

void Autopilot::on_cancel(std::uint16_t command, Call& call) {
  if (!running_ || running_->command != command) return;
  acknowledge(command, messages::MAV_RESULT_CANCELLED, call.requester, call.speaker);
  running_.reset();
}

/// With what has been answered by IN_PROGRESS.
void Autopilot::go_on(Speaker& speaker) {
  if (!running_ || snapshot_.since_boot < running_->done_at) return;
  acknowledge(running_->command, messages::MAV_RESULT_ACCEPTED, running_->requester, speaker);
  running_.reset();
}

std::uint8_t Autopilot::reboot(const Command& command, const Call& call) {
  if (command.param1 != 1) return messages::MAV_RESULT_UNSUPPORTED;
  if (call.airframe.state().armed) return not_now();
  wants_reboot_ = true;
  return messages::MAV_RESULT_ACCEPTED;
}

void Autopilot::acknowledge(std::uint16_t command, std::uint8_t result, Requester requester, Speaker& speaker) {
  constexpr std::uint8_t unknown_progress = 255;
  speaker.send(
      messages::CommandAck{.command = command,
                           .result = result,
                           .progress = result == messages::MAV_RESULT_IN_PROGRESS ? unknown_progress : std::uint8_t{},
                           .target_system = requester.system.value,
                           .target_component = requester.component.value});
}

}  // namespace ponte::sim
