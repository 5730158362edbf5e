#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"
#include "ponte/vsm/telemetry.hpp"

#include <span>
#include <string_view>

namespace ponte::app {

/// One frame on its way over the bridge, and what it became. Valid during the call that shows it.
struct Crossing {
  std::string_view link;  ///< the endpoint that it came from, as configured
  WallTime time{};        ///< of receiving, or of recording
  const mavlink::FrameView& frame;
  const mavlink::MessageInfo* message{};             ///< nothing if the dialect does not know it
  std::span<const vsm::OutgoingMessage> messages{};  ///< what was sent because of it

  Timestamp received{};    ///< its last byte, or the last of the bytes that came together with it
  Timestamp decoded{};     ///< found in the bytes, checksum examined
  Timestamp translated{};  ///< the DLI messages are ready
  Timestamp sent{};        ///< the last of them is handed to the network
};

}  // namespace ponte::app
