#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <cstdint>
#include <span>

/// What each stack has to be asked for, because it does not send it by itself.
namespace ponte::autopilot {

/// A group of messages that ArduPilot sends together (REQUEST_DATA_STREAM).
struct StreamGroup {
  std::uint8_t group;  ///< MAV_DATA_STREAM
  std::uint16_t rate_hz;
};

/// One message, asked for with SET_MESSAGE_INTERVAL.
struct MessageRate {
  mavlink::MessageId message;
  double rate_hz;
};

/// In the order in which they are asked for.
[[nodiscard]] std::span<const StreamGroup> stream_groups_for(Stack stack);
[[nodiscard]] std::span<const MessageRate> message_rates_for(Stack stack);
/// What is asked for once (REQUEST_MESSAGE).
[[nodiscard]] std::span<const mavlink::MessageId> single_messages_for(Stack stack);

}  // namespace ponte::autopilot
