#include "ponte/mavlink/route_filter.hpp"

#include "ponte/mavlink/setup_signing.hpp"

#include <algorithm>
#include <cstdint>

namespace ponte::mavlink {
namespace {

constexpr MessageId command_int{75};
constexpr MessageId command_long{76};
constexpr MessageId file_transfer_protocol{110};
constexpr MessageId serial_control{126};
constexpr std::size_t command_offset = 28;  ///< of COMMAND_LONG and COMMAND_INT alike

/// MAVLink 0.9, where COMMAND has the command at the place at which ACTION has the action.
namespace old {

constexpr MessageId action{10};
constexpr MessageId command{75};
constexpr std::size_t wish_offset = 2;
constexpr unsigned shutdown = 10;
constexpr unsigned reboot = 11;
constexpr unsigned storage_read = 14;  ///< then STORAGE_WRITE, and the calibrations
constexpr unsigned calibrate_pressure = 20;

}  // namespace old

/// A byte of the payload; 0 if it was left out.
std::uint8_t byte_at(Bytes payload, std::size_t at) { return at < payload.size() ? u8(payload, at) : std::uint8_t{0}; }

/// From MAV_CMD_PREFLIGHT_CALIBRATION to MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN.
bool is_preflight(unsigned command) { return command >= 241 && command <= 246; }

bool is_risky_v09(const FrameView& frame) {
  const unsigned wish = byte_at(frame.payload, old::wish_offset);
  if (frame.message == old::command) return is_preflight(wish);
  if (frame.message != old::action) return false;
  return wish == old::shutdown || wish == old::reboot || (wish >= old::storage_read && wish <= old::calibrate_pressure);
}

}  // namespace

SystemId target_system_of(const FrameView& frame, const MessageInfo* message) {
  if (message == nullptr) return {};
  const auto field = std::ranges::find(message->fields, "target_system", &FieldInfo::name);
  if (field == message->fields.end()) return {};
  return SystemId{byte_at(readable_payload(frame, *message), field->offset)};
}

bool is_risky(const FrameView& frame) {
  if (frame.version == Version::v0_9) return is_risky_v09(frame);
  if (frame.message == setup_signing_id || frame.message == serial_control || frame.message == file_transfer_protocol)
    return true;
  if (frame.message != command_long && frame.message != command_int) return false;
  const auto high = unsigned{byte_at(frame.payload, command_offset + 1)} << 8U;
  return is_preflight(high | byte_at(frame.payload, command_offset));
}

}  // namespace ponte::mavlink
