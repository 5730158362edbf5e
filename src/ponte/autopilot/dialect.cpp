#include "ponte/autopilot/dialect.hpp"

#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/v09/dialect.hpp"

namespace ponte::autopilot {

const mavlink::Dialect dialect{.name = mavlink::autopilots::dialect.name,
                               .messages = mavlink::autopilots::dialect.messages,
                               .v09 = &mavlink::v09::dialect,
                               .low = mavlink::autopilots::dialect.low};

const mavlink::MessageInfo* ours(const mavlink::FrameView& frame, const mavlink::MessageInfo& message) {
  const auto* own = find_message(dialect, frame);
  if (own == nullptr || own->crc_extra != message.crc_extra || own->name != message.name) return nullptr;
  return own;
}

}  // namespace ponte::autopilot
