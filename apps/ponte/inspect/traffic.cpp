#include "inspect/traffic.hpp"

#include <fmt/format.h>

namespace ponte::app {

std::string MessageTally::name(mavlink::MessageId id) const {
  return message != nullptr ? std::string{message->name} : fmt::format("unknown:{}", id.value);
}

void Traffic::on_frame(std::size_t, std::optional<WallTime> time, const mavlink::FrameView& frame,
                       const mavlink::MessageInfo* message) {
  ++frames;
  if (frame.is_signed()) {
    ++signed_frames;
    if (signer_) ++verdicts[static_cast<std::size_t>(signer_->verify(time.value_or(WallTime{}), frame))];
  }
  ++start_bytes[u8(frame.whole, 0)];
  losses.on_frame(frame.system, frame.component, frame.sequence);
  auto& tally = messages[{frame.system, frame.component, frame.message}];
  tally.message = message;
  tally.add(time, message != nullptr ? readable_payload(frame, *message) : frame.payload);
}

void Traffic::on_damage(std::size_t offset, std::optional<WallTime>, Bytes bytes, std::string_view reason) {
  auto& damage = damages[std::string{reason}];
  ++damage.count;
  damage.bytes += bytes.size();
  if (first_damage.empty()) first_damage = fmt::format("offset {}: {}", offset, reason);
}

}  // namespace ponte::app
