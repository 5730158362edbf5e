#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

/// What a router has to know of a message.
namespace ponte::mavlink {

/// The system that a message is for; 0: everybody, as for every message without the field, or one that nobody knows. A
/// field that MAVLink 2 left out, as it ends in zeros, is 0 too.
[[nodiscard]] SystemId target_system_of(const FrameView& frame, const MessageInfo* message);

/// Whether a message gives power over a vehicle beyond flying it: a shell (SERIAL_CONTROL), its files
/// (FILE_TRANSFER_PROTOCOL), its key (SETUP_SIGNING), or a command from MAV_CMD_PREFLIGHT_CALIBRATION to
/// MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN. In MAVLink 0.9, where those ids are other messages: COMMAND with such a command,
/// and ACTION where it means the same, which is SHUTDOWN, REBOOT, STORAGE_READ and _WRITE, and CALIBRATE_RC to
/// CALIBRATE_PRESSURE.
[[nodiscard]] bool is_risky(const FrameView& frame);

}  // namespace ponte::mavlink
