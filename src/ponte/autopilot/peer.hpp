#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/mavlink/frame.hpp"

namespace ponte::autopilot {

/// The autopilot that a client speaks to, and what it is to be taken for.
struct Peer {
  mavlink::SystemId system{};
  mavlink::ComponentId component{};
  Stack stack{Stack::unknown};
  friend bool operator==(const Peer&, const Peer&) = default;
};

}  // namespace ponte::autopilot
