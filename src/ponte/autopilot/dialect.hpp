#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

namespace ponte::autopilot {

/// All that Ponte speaks with vehicles: the messages of ArduPilot and PX4 in MAVLink 1 and 2, and those of MAVLink 0.9.
extern const mavlink::Dialect dialect;

/// The message of ours that a frame carries, which another dialect knows as `message`; nothing if that one gives the id
/// another meaning. Only such a frame may be decoded as what we know.
[[nodiscard]] const mavlink::MessageInfo* ours(const mavlink::FrameView& frame, const mavlink::MessageInfo& message);

}  // namespace ponte::autopilot
