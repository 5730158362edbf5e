#pragma once

#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/signer.hpp"
#include "ponte/mavlink/test_messages.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace ponte::mavlink::testing {

/// The key 00 01 ... 1f, of which `heartbeat_signed_frame` was made, with another last byte if one is wanted.
inline SigningKey key(std::uint8_t last = 0x1F) {
  std::array<std::byte, SigningKey::size> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i);
  bytes.back() = std::byte{last};
  return SigningKey{bytes};
}

inline constexpr WallTime beginning_of_2015 = std::chrono::sys_days{std::chrono::year{2015} / 1 / 1};

struct Sender {
  SystemId system{1};
  ComponentId component{1};
  std::uint8_t link_id{7};
};

/// A HEARTBEAT that `signer` has signed.
inline std::vector<std::byte> signed_heartbeat(Signer& signer, WallTime now, Sender sender = {}) {
  std::vector<std::byte> frame(max_frame_size);
  const auto size = encode(Heartbeat{}, {.system = sender.system, .component = sender.component}, frame).value();
  frame.resize(signer.sign(now, sender.link_id, frame, size));
  return frame;
}

}  // namespace ponte::mavlink::testing
