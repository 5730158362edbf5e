#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/frame.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace ponte::mavlink {

/// One frame to be sent.
struct FrameBuffer {
  std::array<std::byte, max_frame_size> buffer{};
  std::size_t size{};

  [[nodiscard]] Bytes bytes() const { return Bytes{buffer}.first(size); }
};

/// Puts the messages of one component into frames, and numbers them.
class FrameSender {
 public:
  FrameSender(Version version, SystemId system, ComponentId component) : header_{version, system, component, 0} {}

  [[nodiscard]] SystemId system() const { return header_.system; }
  [[nodiscard]] ComponentId component() const { return header_.component; }
  [[nodiscard]] Version version() const { return header_.version; }
  void set_version(Version version) { header_.version = version; }

  /// The next frame; nothing for a message that the version cannot carry: one with an id above 255 in MAVLink 1, or one
  /// of MAVLink 0.9 in another version, or the other way round.
  template <Message M>
  [[nodiscard]] std::optional<FrameBuffer> frame(const M& message) {
    if (header_.version == Version::v1 && M::info.id.value > 255) return {};
    if (M::info.is_v09() != (header_.version == Version::v0_9)) return {};
    FrameBuffer frame;
    const auto size = encode(message, header_, frame.buffer);
    PONTE_ASSERT(size);
    frame.size = *size;
    ++header_.sequence;
    return frame;
  }

  /// What the version cannot carry is not sent.
  template <Message M>
  void send(const M& message, Outbox<FrameBuffer>& out) {
    if (const auto next = frame(message)) out.push(*next);
  }

 private:
  FrameHeader header_;
};

}  // namespace ponte::mavlink
