#pragma once

#include "ponte/transport/link.hpp"
#include "vsm/live_vsm.hpp"

#include <map>
#include <string>

namespace ponte::app {

/// One endpoint with vehicles: each of its peers is a link of its own to the bridge.
class VehicleSide final : public transport::LinkHandler {
 public:
  /// Throws `Failure`. The owner outlives it.
  VehicleSide(LiveVsm& owner, vsm::VehicleLinkId id, const transport::Endpoint& endpoint);

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;

  /// Every peer is gone: the endpoint is about to be closed.
  void end_all(Timestamp now);
  /// True when the frame's link is one of ours; it is on its way then.
  bool send(const autopilot::OutgoingFrame& frame);
  /// The address of the peer that is this link; empty when it is none of ours.
  [[nodiscard]] std::string name_of(autopilot::LinkId link) const;
  [[nodiscard]] bool has(autopilot::LinkId link) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] vsm::VehicleLinkId id() const { return id_; }
  [[nodiscard]] vsm::view::VehicleLink status() const;
  [[nodiscard]] const transport::Link& link() const { return *link_; }
  void log_counters() const;

 private:
  /// What links delivered.
  struct Traffic {
    std::uint64_t frames{};
    std::uint64_t unknown{};
    std::uint64_t lost{};
    std::array<std::uint64_t, mavlink::skip_reason_count> skipped{};
    mavlink::Refusals refused{};

    void add(const vsm::Bridge::Link& link);
  };

  autopilot::LinkId number_of(Timestamp now, transport::PeerId peer);
  void end(Timestamp now, autopilot::LinkId link);
  void tell_change(bool was_up);

  LiveVsm& owner_;
  vsm::VehicleLinkId id_;
  transport::Endpoint endpoint_;
  std::string name_;
  std::map<transport::PeerId, autopilot::LinkId> numbers_;
  Traffic ended_;       ///< of links that are no more
  std::string detail_;  ///< why the endpoint is down; empty while it is not
  std::unique_ptr<transport::Link> link_;
};

}  // namespace ponte::app
