#pragma once

#include "ponte/core/outbox.hpp"
#include "ponte/core/quantity.hpp"
#include "ponte/mavlink/frame_sender.hpp"

namespace ponte::sim {

/// The ground end of a telemetry radio with SiK firmware, which puts RADIO_STATUS into the stream of what it hears: as
/// system 51, component 68 ("3D").
class Radio {
 public:
  explicit Radio(mavlink::Version version) : sender_{version, mavlink::SystemId{'3'}, mavlink::ComponentId{'D'}} {}

  /// Once a second. Out of reach, nothing but noise is heard. MAVLink 0.9 has no such message.
  void report(Metres distance, bool is_in_reach, Outbox<mavlink::FrameBuffer>& out);

 private:
  mavlink::FrameSender sender_;
};

}  // namespace ponte::sim
