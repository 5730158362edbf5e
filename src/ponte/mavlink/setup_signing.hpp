#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/signer.hpp"

#include <cstddef>
#include <optional>

/// SETUP_SIGNING hands over a key, readable for all. It belongs on a link on which nobody else listens, such as a
/// cable, goes to one component, and is never forwarded.
namespace ponte::mavlink {

inline constexpr MessageId setup_signing_id{256};

struct SetupSigning {
  SystemId system{};                ///< of the receiver, never 0
  ComponentId component{};          ///< of the receiver
  std::optional<SigningKey> key{};  ///< nothing: signing is switched off
  SigningTime time{};               ///< which the receiver's time must not be before
};

/// Writes it as an unsigned MAVLink 2 frame to the beginning of `out`, which has room for `max_frame_size` bytes, and
/// returns the size of the frame.
[[nodiscard]] std::size_t write_setup_signing(const SetupSigning& setup, SystemId system, ComponentId component,
                                              std::uint8_t sequence, MutableBytes out);

/// What a frame with a right checksum sets up; nothing if it is another message or is addressed to everybody.
[[nodiscard]] std::optional<SetupSigning> read_setup_signing(const FrameView& frame);

}  // namespace ponte::mavlink
