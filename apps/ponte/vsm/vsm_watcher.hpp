#pragma once

#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/vsm/crossing.hpp"
#include "ponte/vsm/view/situation.hpp"

#include <span>
#include <string_view>

namespace ponte::app {

/// Is told of everything that happens on a live VSM. All calls come on the loop's thread; none may change the VSM.
class VsmWatcher {
 public:
  virtual ~VsmWatcher() = default;

  /// A frame, with what it became.
  virtual void on_crossing(const vsm::Crossing& crossing) = 0;
  /// Messages that were sent because it was time to.
  virtual void on_clock(Timestamp now, std::span<const vsm::OutgoingMessage> messages) = 0;
  /// Bytes from vehicles that are part of no frame. One run may come in several calls.
  virtual void on_skipped(vsm::VehicleLinkId link, Bytes run, mavlink::SkipReason reason) = 0;
  /// A datagram from the DLI's side that holds something else than good messages; `reason` is a literal.
  virtual void on_refused(std::string_view reason, std::size_t bytes) = 0;
  /// A link has come up, or is not up any more.
  virtual void on_link(const vsm::view::VehicleLink& link) = 0;
  virtual void on_fact(vsm::VehicleLinkId link, const autopilot::FleetFact& fact) = 0;
  virtual void on_conversion(bool on) = 0;
};

}  // namespace ponte::app
