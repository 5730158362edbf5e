#pragma once

#include "ponte/autopilot/dialect.hpp"
#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/mavlink/link_guard.hpp"
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
  mavlink::LinkPolicy link_policy{};  ///< of every link, once there is a signer
  /// Names the messages for the listener, and outlives the bridge. Only those it shares with ours are translated.
  const mavlink::Dialect* dialect{&autopilot::dialect};
};

/// Is told of each frame on its way over the bridge: for who sends at once, and for who measures. Must not feed the
/// bridge from within a call.
class BridgeListener {
 public:
  virtual ~BridgeListener() = default;
  /// A frame was found, and its checksum is right. `message` is nothing if the dialect does not know it. What stands in
  /// the outbox now was due anyway.
  virtual void on_decoded(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) = 0;
  /// The same frame has done its work: what it calls for stands in the outboxes.
  virtual void on_translated(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) = 0;
  /// Bytes on a link that are part of no frame. One run may come in several calls.
  virtual void on_skipped(autopilot::LinkId /*link*/, Bytes /*run*/, mavlink::SkipReason /*reason*/) {}
  /// A frame that the policy of its link does not permit: nothing more happens with it. `count` so far, itself
  /// included.
  virtual void on_refused(autopilot::LinkId /*link*/, mavlink::Refusal /*refusal*/, std::uint64_t /*count*/) {}
};

/// The telemetry side of a VSM from bytes to bytes: MAVLink links with any vehicles on them in, DLI messages, requests
/// to the vehicles and facts for the log out. What comes out stands in the outboxes until somebody drains them. Knows
/// no clock and no socket.
class Bridge final : private mavlink::FrameSink {
 public:
  /// The listener and the signer, if any, outlive the bridge. The signer verifies what comes in; what goes out is
  /// signed by who sends it.
  explicit Bridge(BridgeConfig config, BridgeListener* listener = nullptr, mavlink::Signer* signer = nullptr);

  /// A link begins; frames come from it, and requests may be sent on it, until it ends.
  void on_link_up(Timestamp now, autopilot::LinkId link);
  void on_link_down(Timestamp now, WallTime wall, autopilot::LinkId link);
  /// The next piece of a stream.
  void on_bytes(Timestamp now, WallTime wall, autopilot::LinkId link, Bytes bytes);
  void on_datagram(Timestamp now, WallTime wall, autopilot::LinkId link, Bytes datagram);
  void on_tick(Timestamp now, WallTime wall);
  /// When `on_tick` next has something to do, or earlier.
  [[nodiscard]] Timestamp next_deadline() const;
  /// While it does not convert, the bridge keeps in touch with vehicles and says nothing to ground stations.
  void convert(bool on) { converts_ = on; }
  [[nodiscard]] bool converts() const { return converts_; }

  Outbox<autopilot::OutgoingFrame> frames{256};
  Outbox<OutgoingMessage> messages{256};
  Outbox<autopilot::FleetFact> facts{64};

  struct Link {
    Link(autopilot::LinkId number, const mavlink::Dialect& dialect, mavlink::LinkPolicy policy);

    autopilot::LinkId id;
    mavlink::Parser parser;
    mavlink::LinkGuard guard;
    mavlink::LinkStatistics losses;
  };
  /// What each link delivered, and what was no frame, for the links that are up.
  [[nodiscard]] const std::vector<std::unique_ptr<Link>>& links() const { return links_; }
  [[nodiscard]] const autopilot::FleetSession& fleet() const { return fleet_; }
  [[nodiscard]] const Telemetry& telemetry() const { return telemetry_; }

 private:
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void on_skipped(Bytes run, mavlink::SkipReason reason) override;
  void translate(const mavlink::FrameView& frame, const mavlink::MessageInfo& message);
  Link* enter(Timestamp now, WallTime wall, autopilot::LinkId link);
  void tell_facts(WallTime wall);
  void tick_telemetry(Timestamp now, WallTime wall);

  const mavlink::Dialect* dialect_;
  mavlink::LinkPolicy link_policy_;
  autopilot::FleetSession fleet_;
  Telemetry telemetry_;
  BridgeListener* listener_;
  mavlink::Signer* signer_;
  bool converts_{true};
  Outbox<autopilot::FleetFact> new_facts_{16};
  std::vector<std::unique_ptr<Link>> links_;
  // While a link is read: which, and when.
  Link* current_{};
  Timestamp now_{};
  WallTime wall_{};
};

}  // namespace ponte::vsm
