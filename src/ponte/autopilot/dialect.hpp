#pragma once

#include "ponte/mavlink/message_info.hpp"

namespace ponte::autopilot {

/// All that Ponte speaks with vehicles: the messages of ArduPilot and PX4 in MAVLink 1 and 2, and those of MAVLink 0.9.
extern const mavlink::Dialect dialect;

}  // namespace ponte::autopilot
