#pragma once

#include "ponte/autopilot/mission_client.hpp"
#include "ponte/mavlink/parser.hpp"
#include "support/world/world.hpp"

#include <functional>
#include <vector>

namespace ponte::world {

/// A ground station that transfers plans to and from one vehicle, over its first link.
class TransferNode final : public Participant, private mavlink::FrameSink {
 public:
  explicit TransferNode(const autopilot::Peer& peer, mavlink::SystemId us = mavlink::SystemId{255},
                        mavlink::Version version = mavlink::Version::v2);

  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override;
  void on_tick(Timestamp now, Sender& out) override;
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override;

  /// Is done at once, with something to speak through.
  using Work = std::function<void(Timestamp, autopilot::Voice&)>;
  void ask(Work work) { work_.push_back(std::move(work)); }
  /// What it is told when the vehicle has started anew.
  void reboot();

  [[nodiscard]] autopilot::MissionClient& missions() { return missions_; }
  /// What the requests have come to, progress left out.
  [[nodiscard]] const std::vector<autopilot::MissionFact>& mission_facts() const { return mission_facts_; }
  [[nodiscard]] bool is_busy() const { return missions_.is_busy() || !work_.empty(); }

 private:
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void speak(Sender& out);

  mavlink::Parser parser_;
  mavlink::FrameSender sender_;
  Outbox<autopilot::OutgoingFrame> outbox_{64};
  autopilot::Voice voice_{sender_, {}, outbox_};
  Outbox<autopilot::MissionFact> facts_{64};
  autopilot::MissionClient missions_;
  std::vector<autopilot::MissionFact> mission_facts_;
  std::vector<Work> work_;
  Timestamp now_{};
  Timestamp next_heartbeat_{};
};

}  // namespace ponte::world
