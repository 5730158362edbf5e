#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/message_interval.hpp"
#include "ponte/sim/autopilot.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

/// Which messages come, and how often.
namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr double longest_interval_us = 60e6;

}  // namespace

std::optional<std::size_t> Autopilot::row_named_by(float parameter) const {
  constexpr std::uint32_t largest_id = 0xFF'FFFF;
  const auto id = whole_number(parameter, largest_id);
  return id ? find_telemetry_row(rows(), mavlink::MessageId{*id}) : std::nullopt;
}

void Autopilot::send_row(mavlink::MessageId id, Speaker& speaker) {
  if (speaks_v09()) return;
  if (const auto row = find_telemetry_row(rows(), id)) rows()[*row].send(snapshot_, speaker.sender(), speaker.out());
}

/// What follows the acknowledgement of a command that asks for a message.
void Autopilot::send_requested(const Command& command, Call& call) {
  switch (command.number) {
    case messages::MAV_CMD_REQUEST_MESSAGE:
      if (const auto row = row_named_by(command.param1))
        rows()[*row].send(snapshot_, call.speaker.sender(), call.speaker.out());
      return;
    case messages::MAV_CMD_GET_HOME_POSITION: return send_row(messages::HomePosition::info.id, call.speaker);
    case messages::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES:
      return send_row(messages::AutopilotVersion::info.id, call.speaker);
    default: return;
  }
}

std::uint8_t Autopilot::set_message_interval(const Command& command, Call& call) {
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
  if (interval >= MessageRates::shortest_interval || is_px4()) {
    rates_.set_interval(*row, std::max(interval, MessageRates::shortest_interval), now);
    return messages::MAV_RESULT_ACCEPTED;
  }
  std::array<char, 80> text{};
  const auto id = rows()[*row].info->id.value;
  const auto size = fmt::format_to_n(text.data(), text.size(),
                                     "Requested rate for message ID {} too fast. Increase SCHED_LOOP_RATE", id)
                        .size;
  call.speaker.say(messages::MAV_SEVERITY_INFO, {text.data(), std::min(size, text.size())});
  return messages::MAV_RESULT_DENIED;
}

std::uint8_t Autopilot::tell_message_interval(const Command& command, Call& call) const {
  const auto row = row_named_by(command.param1);
  if (!row) return messages::MAV_RESULT_FAILED;
  constexpr std::int32_t is_off = -1;
  const auto interval = rates_.interval(*row);
  const auto us = static_cast<std::int32_t>(interval / std::chrono::microseconds{1});
  call.speaker.send(messages::MessageInterval{.message_id = static_cast<std::uint16_t>(rows()[*row].info->id.value),
                                              .interval_us = interval == Duration{} ? is_off : us});
  return messages::MAV_RESULT_ACCEPTED;
}

}  // namespace ponte::sim
