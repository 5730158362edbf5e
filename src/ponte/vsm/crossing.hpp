#pragma once

#include "ponte/core/id.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"
#include "ponte/vsm/telemetry.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace ponte::vsm {

/// An endpoint of vehicles, numbered from 1 on as it is added; several links of the bridge may be on it.
using VehicleLinkId = Id<struct VehicleLinkIdTag, std::uint32_t>;

/// One frame on its way over the bridge, and what it became. Valid during the call that shows it.
struct Crossing {
  VehicleLinkId link_id{};
  std::string_view link;  ///< the endpoint that it came from, as configured
  WallTime time{};        ///< of receiving, or of recording
  const mavlink::FrameView& frame;
  const mavlink::MessageInfo* message{};        ///< nothing if the dialect does not know it
  std::span<const OutgoingMessage> messages{};  ///< what was sent because of it

  Timestamp received{};    ///< its last byte, or the last of the bytes that came together with it
  Timestamp decoded{};     ///< found in the bytes, checksum examined
  Timestamp translated{};  ///< the DLI messages are ready
  Timestamp sent{};        ///< the last of them is handed to the network
};

}  // namespace ponte::vsm
