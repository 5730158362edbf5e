#pragma once

#include "ponte/core/id.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/mavlink/frame_sender.hpp"

#include <cstdint>

namespace ponte::autopilot {

/// One exchange with one peer: a serial line, a TCP connection, the sender of datagrams. The app numbers them.
using LinkId = Id<struct LinkIdTag, std::uint16_t>;

struct OutgoingFrame : mavlink::FrameBuffer {
  LinkId link{};
};

/// What a ground station says something through, on one link and during one call.
class Voice {
 public:
  Voice(mavlink::FrameSender& sender, LinkId link, Outbox<OutgoingFrame>& out)
      : sender_{sender}, link_{link}, out_{out} {}

  /// What the version cannot carry is not sent.
  template <mavlink::Message M>
  void send(const M& message) {
    if (const auto frame = sender_.frame(message)) out_.push({*frame, link_});
  }

  [[nodiscard]] mavlink::Version version() const { return sender_.version(); }
  // Who speaks.
  [[nodiscard]] mavlink::SystemId system() const { return sender_.system(); }
  [[nodiscard]] mavlink::ComponentId component() const { return sender_.component(); }
  /// Whether a message with this addressee is for the speaker; a component 0 means all of its system.
  [[nodiscard]] bool is_addressed(std::uint8_t target_system, std::uint8_t target_component) const {
    return target_system == system().value && (target_component == component().value || target_component == 0);
  }

 private:
  mavlink::FrameSender& sender_;
  LinkId link_;
  Outbox<OutgoingFrame>& out_;
};

}  // namespace ponte::autopilot
