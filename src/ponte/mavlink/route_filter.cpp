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
constexpr std::uint16_t first_preflight_command = 241;
constexpr std::uint16_t last_preflight_command = 246;

/// A byte of the payload; 0 if it was left out.
std::uint8_t byte_at(Bytes payload, std::size_t at) { return at < payload.size() ? u8(payload, at) : std::uint8_t{0}; }

}  // namespace

SystemId target_system_of(const FrameView& frame, const MessageInfo* message) {
  if (message == nullptr) return {};
  const auto field = std::ranges::find(message->fields, "target_system", &FieldInfo::name);
  if (field == message->fields.end()) return {};
  return SystemId{byte_at(readable_payload(frame, *message), field->offset)};
}

bool is_risky(const FrameView& frame) {
  if (frame.message == setup_signing_id || frame.message == serial_control || frame.message == file_transfer_protocol)
    return true;
  if (frame.message != command_long && frame.message != command_int) return false;
  const auto command = byte_at(frame.payload, command_offset) + (byte_at(frame.payload, command_offset + 1) << 8U);
  return command >= first_preflight_command && command <= last_preflight_command;
}

}  // namespace ponte::mavlink
