#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ponte::sim {

/// One frame to be sent.
struct Frame {
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  std::size_t size{};

  [[nodiscard]] Bytes bytes() const { return Bytes{buffer}.first(size); }
};

/// Puts the messages of one component into frames, and numbers them.
class FrameSender {
 public:
  FrameSender(mavlink::Version version, mavlink::SystemId system, mavlink::ComponentId component)
      : header_{version, system, component, 0} {}

  /// MAVLink 1 cannot carry a message with an id above 255: nothing is sent then.
  template <mavlink::Message M>
  void send(const M& message, Outbox<Frame>& out) {
    if (header_.version == mavlink::Version::v1 && M::info.id.value > 255) return;
    Frame frame;
    const auto size = mavlink::encode(message, header_, frame.buffer);
    PONTE_ASSERT(size);
    frame.size = *size;
    ++header_.sequence;
    out.push(frame);
  }

 private:
  mavlink::FrameHeader header_;
};

}  // namespace ponte::sim
