#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/sim/autopilot.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

/// The commands of the autopilot, with ArduCopter's answers to them.
namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr double longest_interval_us = 60e6;

/// The whole number that a parameter carries, from 0 to `most`, or nothing.
std::optional<std::uint32_t> whole_number(float parameter, std::uint32_t most) {
  if (!(parameter >= 0) || double{parameter} > most || std::floor(parameter) != parameter) return std::nullopt;
  return static_cast<std::uint32_t>(parameter);
}

std::optional<std::size_t> row_named_by(float parameter) {
  constexpr std::uint32_t largest_id = 0xFF'FFFF;
  const auto id = whole_number(parameter, largest_id);
  return id ? find_telemetry_row(mavlink::MessageId{*id}) : std::nullopt;
}

/// Formats without allocation; what is too long for a STATUSTEXT is cut.
template <class... Args>
std::string_view format_to(std::array<char, 50>& buffer, fmt::format_string<Args...> format, Args&&... args) {
  const auto result = fmt::format_to_n(buffer.data(), buffer.size(), format, std::forward<Args>(args)...);
  return {buffer.data(), std::min(result.size, buffer.size())};
}

}  // namespace

void Autopilot::on_command(const CommandLong& command, Requester requester, Airframe& airframe, Outbox<Frame>& out) {
  const auto result = execute(command, airframe, out);
  acknowledge(command.command, result, requester, out);
  if (result != messages::MAV_RESULT_ACCEPTED || command.command != messages::MAV_CMD_REQUEST_MESSAGE) return;
  if (const auto row = row_named_by(command.param1)) rows()[*row].send(snapshot_, sender_, out);
}

std::uint8_t Autopilot::execute(const CommandLong& command, Airframe& airframe, Outbox<Frame>& out) {
  switch (command.command) {
    case messages::MAV_CMD_COMPONENT_ARM_DISARM: return arm_or_disarm(command, airframe, out);
    case messages::MAV_CMD_NAV_TAKEOFF: return take_off(command, airframe, out);
    case messages::MAV_CMD_NAV_RETURN_TO_LAUNCH: return enter(FlightMode::rtl, airframe, out);
    case messages::MAV_CMD_NAV_LAND: return enter(FlightMode::land, airframe, out);
    case messages::MAV_CMD_DO_SET_MODE: return set_mode(command.param1, command.param2, airframe, out);
    case messages::MAV_CMD_SET_MESSAGE_INTERVAL: return set_message_interval(command, out);
    case messages::MAV_CMD_REQUEST_MESSAGE:
      return row_named_by(command.param1) ? messages::MAV_RESULT_ACCEPTED : messages::MAV_RESULT_FAILED;
    case messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN: return reboot(command, airframe);
    default: return messages::MAV_RESULT_UNSUPPORTED;
  }
}

/// No parameter makes it skip a check.
std::uint8_t Autopilot::arm_or_disarm(const CommandLong& command, Airframe& airframe, Outbox<Frame>& out) {
  const auto& state = airframe.state();
  if (command.param1 == 0) {
    if (state.airborne) return messages::MAV_RESULT_FAILED;
    if (!state.armed) return messages::MAV_RESULT_ACCEPTED;
    airframe.disarm();
    flight_.on_disarmed();
    say(messages::MAV_SEVERITY_INFO, "Disarming motors", out);
    return messages::MAV_RESULT_ACCEPTED;
  }
  if (command.param1 != 1) return messages::MAV_RESULT_UNSUPPORTED;
  if (state.armed) return messages::MAV_RESULT_ACCEPTED;

  const auto refuse = [&](std::string_view reason) {
    say(messages::MAV_SEVERITY_CRITICAL, reason, out);
    return messages::MAV_RESULT_FAILED;
  };
  if (!snapshot_.is_ready) return refuse("Arm: System not initialised");
  if (!snapshot_.has_position) return refuse("Arm: Need Position Estimate");
  const auto& mode = flight_mode_info(flight_.kind(), flight_.mode());
  if (!mode.armable) {
    std::array<char, 50> text{};
    return refuse(format_to(text, "Arm: {} mode not armable", mode.name));
  }
  airframe.arm();
  say(messages::MAV_SEVERITY_INFO, "Arming motors", out);
  flight_.set_home(state.position);
  flight_.on_armed(snapshot_.since_boot, airframe, facts_);
  tell_facts(out);
  snapshot_.home = flight_.home();
  send_row(messages::HomePosition::info.id, out);
  return messages::MAV_RESULT_ACCEPTED;
}

std::uint8_t Autopilot::take_off(const CommandLong& command, Airframe& airframe, Outbox<Frame>& out) {
  if (!std::isfinite(command.param7)) return messages::MAV_RESULT_DENIED;
  const bool done = flight_.take_off(Metres{command.param7}, snapshot_.since_boot, airframe, facts_);
  tell_facts(out);
  return done ? messages::MAV_RESULT_ACCEPTED : messages::MAV_RESULT_FAILED;
}

std::uint8_t Autopilot::set_mode(float base_mode, float custom_mode, Airframe& airframe, Outbox<Frame>& out) {
  const auto flags = whole_number(base_mode, 255);
  if (!flags || (*flags & messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED) == 0) return messages::MAV_RESULT_DENIED;
  const auto number = whole_number(custom_mode, 255);
  const auto mode = number ? flight_mode(flight_.kind(), *number) : std::nullopt;
  if (mode) return enter(*mode, airframe, out);
  std::array<char, 50> text{};
  say(messages::MAV_SEVERITY_WARNING, format_to(text, "No such mode {}", custom_mode), out);
  return messages::MAV_RESULT_FAILED;
}

std::uint8_t Autopilot::enter(FlightMode mode, Airframe& airframe, Outbox<Frame>& out) {
  const bool done = flight_.enter(mode, snapshot_.since_boot, airframe, facts_);
  tell_facts(out);
  if (done) return messages::MAV_RESULT_ACCEPTED;
  std::array<char, 50> text{};
  const auto name = has_mode(flight_.kind(), mode) ? flight_mode_info(flight_.kind(), mode).name : "it";
  say(messages::MAV_SEVERITY_WARNING, format_to(text, "Mode change to {} failed: init failed", name), out);
  return messages::MAV_RESULT_FAILED;
}

std::uint8_t Autopilot::set_message_interval(const CommandLong& command, Outbox<Frame>& out) {
  const auto row = row_named_by(command.param1);
  if (!row || !std::isfinite(command.param2)) return messages::MAV_RESULT_DENIED;
  const auto now = snapshot_.since_boot;
  if (command.param2 == 0) {
    rates_.reset_interval(*row, now);
    return messages::MAV_RESULT_ACCEPTED;
  }
  if (command.param2 < 0) {
    rates_.set_interval(*row, std::nullopt, now);
    return messages::MAV_RESULT_ACCEPTED;
  }
  const auto microseconds = static_cast<std::int64_t>(std::min(double{command.param2}, longest_interval_us));
  const Duration interval = std::chrono::microseconds{microseconds};
  if (interval < MessageRates::shortest_interval) {
    std::array<char, 50> text{};
    const auto id = rows()[*row].info->id.value;
    say(messages::MAV_SEVERITY_INFO, format_to(text, "Requested rate for message ID {} too fast.", id), out);
    return messages::MAV_RESULT_DENIED;
  }
  rates_.set_interval(*row, interval, now);
  return messages::MAV_RESULT_ACCEPTED;
}

std::uint8_t Autopilot::reboot(const CommandLong& command, const Airframe& airframe) {
  if (command.param1 != 1) return messages::MAV_RESULT_UNSUPPORTED;
  if (airframe.state().armed) return messages::MAV_RESULT_FAILED;
  wants_reboot_ = true;
  return messages::MAV_RESULT_ACCEPTED;
}

void Autopilot::acknowledge(std::uint16_t command, std::uint8_t result, Requester requester, Outbox<Frame>& out) {
  sender_.send(messages::CommandAck{.command = command,
                                    .result = result,
                                    .target_system = requester.system.value,
                                    .target_component = requester.component.value},
               out);
}

}  // namespace ponte::sim
