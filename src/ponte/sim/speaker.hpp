#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/frame_sender.hpp"
#include "ponte/sim/personality.hpp"

#include <cstdint>
#include <string_view>

namespace ponte::sim {

/// Who asked for something, and gets the answer.
struct Requester {
  mavlink::SystemId system;
  mavlink::ComponentId component;
  friend bool operator==(const Requester&, const Requester&) = default;
};

/// Numbers the texts of one component, so that the pieces of a long one find together.
class TextNumbers {
 public:
  explicit TextNumbers(Personality personality) : personality_{personality} {}

  /// The id of the next text, which has one piece or more.
  [[nodiscard]] std::uint16_t next(bool has_pieces);

 private:
  Personality personality_;
  std::uint16_t last_{};
};

/// What a service of the autopilot answers through, during one call.
class Speaker {
 public:
  Speaker(mavlink::Version version, mavlink::FrameSender& sender, TextNumbers& numbers,
          Outbox<mavlink::FrameBuffer>& out)
      : version_{version}, sender_{sender}, numbers_{numbers}, out_{out} {}

  template <mavlink::Message M>
  void send(const M& message) {
    sender_.send(message, out_);
  }

  /// A text for people, of this MAV_SEVERITY; in pieces of 50 characters if it is longer.
  void say(std::uint8_t severity, std::string_view text);

  [[nodiscard]] mavlink::FrameSender& sender() const { return sender_; }
  [[nodiscard]] Outbox<mavlink::FrameBuffer>& out() const { return out_; }

 private:
  mavlink::Version version_;
  mavlink::FrameSender& sender_;
  TextNumbers& numbers_;
  Outbox<mavlink::FrameBuffer>& out_;
};

}  // namespace ponte::sim
