#pragma once

#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/mavlink/link_statistics.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/vsm/telemetry.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace ponte::vsm {

struct BridgeConfig {
  TelemetryConfig telemetry{};
  TelemetryRates rates{live_rates()};
  autopilot::FleetConfig fleet{};
};

/// The telemetry side of a VSM from bytes to bytes: MAVLink links with any vehicles on them in, DLI messages, requests
/// to the vehicles and facts for the log out. What comes out stands in the outboxes until somebody drains them. Knows
/// no clock and no socket.
class Bridge final : private mavlink::FrameSink {
 public:
  explicit Bridge(BridgeConfig config);

  /// A link begins; frames come from it, and requests may be sent on it, until it ends.
  void on_link_up(Timestamp now, autopilot::LinkId link);
  void on_link_down(Timestamp now, WallTime wall, autopilot::LinkId link);
  /// The next piece of a stream.
  void on_bytes(Timestamp now, WallTime wall, autopilot::LinkId link, Bytes bytes);
  void on_datagram(Timestamp now, WallTime wall, autopilot::LinkId link, Bytes datagram);
  void on_tick(Timestamp now, WallTime wall);
  /// When `on_tick` next has something to do, or earlier.
  [[nodiscard]] Timestamp next_deadline() const;

  Outbox<autopilot::OutgoingFrame> frames{256};
  Outbox<OutgoingMessage> messages{256};
  Outbox<autopilot::FleetFact> facts{64};

  struct Link {
    explicit Link(autopilot::LinkId number);

    autopilot::LinkId id;
    mavlink::Parser parser;
    mavlink::LinkStatistics losses;
  };
  /// What each link delivered, and what was no frame, for the links that are up.
  [[nodiscard]] const std::vector<std::unique_ptr<Link>>& links() const { return links_; }
  [[nodiscard]] const autopilot::FleetSession& fleet() const { return fleet_; }
  [[nodiscard]] const Telemetry& telemetry() const { return telemetry_; }

 private:
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  Link* enter(Timestamp now, WallTime wall, autopilot::LinkId link);
  void tell_facts(WallTime wall);

  autopilot::FleetSession fleet_;
  Telemetry telemetry_;
  Outbox<autopilot::FleetFact> new_facts_{16};
  std::vector<std::unique_ptr<Link>> links_;
  // While a link is read: which, and when.
  Link* current_{};
  Timestamp now_{};
  WallTime wall_{};
};

}  // namespace ponte::vsm
