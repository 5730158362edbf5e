#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/sim/autopilot.hpp"

#include <fmt/format.h>

#include <array>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

/// No parameter makes it skip a check.
std::uint8_t Autopilot::arm_or_disarm(const Command& command, Call& call) {
  const auto& state = call.airframe.state();
  if (command.param1 == 0) {
    if (state.airborne) return not_now();
    if (!state.armed) return messages::MAV_RESULT_ACCEPTED;
    call.airframe.disarm();
    flight_.on_disarmed();
    call.speaker.say(messages::MAV_SEVERITY_INFO, is_px4() ? "Disarmed by external command\t" : "Disarming motors");
    return messages::MAV_RESULT_ACCEPTED;
  }
  if (command.param1 != 1) return messages::MAV_RESULT_UNSUPPORTED;
  return arm(call);
}

std::uint8_t Autopilot::arm(Call& call) {
  const auto& state = call.airframe.state();
  if (state.armed) return messages::MAV_RESULT_ACCEPTED;
  std::array<char, 50> buffer{};
  if (const auto reason = reason_not_to_arm(buffer); !reason.empty()) {
    call.speaker.say(messages::MAV_SEVERITY_CRITICAL, reason);
    return not_now();
  }
  call.airframe.arm();
  call.speaker.say(messages::MAV_SEVERITY_INFO, is_px4() ? "Armed by external command\t" : "Arming motors");
  flight_.set_home(state.position);
  keep_home();
  flight_.on_armed(snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  snapshot_.home = flight_.home();
  snapshot_.armed = true;
  send_row(messages::HomePosition::info.id, call.speaker);
  return messages::MAV_RESULT_ACCEPTED;
}

/// In each autopilot's words; nothing if it may arm.
std::string_view Autopilot::reason_not_to_arm(std::array<char, 50>& buffer) const {
  if (is_px4() &&
      (snapshot_.landed_state != LandedState::on_ground || !snapshot_.trusts_position || failsafes_.refuses_to_arm()))
    return "Arming denied: Resolve system health failures first\t";
  if (!snapshot_.is_ready) return "Arm: System not initialised";
  if (!snapshot_.has_position || !snapshot_.trusts_position) return "Arm: Need Position Estimate";
  if (const auto reason = failsafes_.refuses_to_arm()) {
    const auto size = fmt::format_to_n(buffer.data(), buffer.size(), "Arm: {}", *reason).size;
    return {buffer.data(), std::min(size, buffer.size())};
  }
  const auto& mode = flight_mode_info(flight_.kind(), flight_.mode());
  if (mode.armable) return {};
  const auto* form = is_px4() ? "Arming denied: not possible in {}\t" : "Arm: {} mode not armable";
  const auto size = fmt::format_to_n(buffer.data(), buffer.size(), fmt::runtime(form), mode.name).size;
  return {buffer.data(), std::min(size, buffer.size())};
}

}  // namespace ponte::sim
