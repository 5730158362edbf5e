#pragma once

#include "ponte/vsm/bridge.hpp"
#include "support/world/world.hpp"

#include <set>
#include <vector>

namespace ponte::world {

/// The telemetry side of a VSM. Each of its links leads to vehicles; what it says to ground stations is counted.
class BridgeNode final : public Participant {
 public:
  explicit BridgeNode(const vsm::BridgeConfig& config = {}) : bridge_{config} {}

  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override;
  void on_tick(Timestamp now, Sender& out) override;
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override { return bridge_.next_deadline(); }

  [[nodiscard]] const vsm::Bridge& bridge() const { return bridge_; }
  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  [[nodiscard]] const std::vector<autopilot::FleetFact>& facts() const { return facts_; }

 private:
  /// Of the calendar, at the beginning of the world.
  static constexpr WallTime beginning{std::chrono::sys_days{std::chrono::year{2026} / 1 / 1}};

  [[nodiscard]] static WallTime wall(Timestamp now) {
    return beginning + std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
  }
  [[nodiscard]] static autopilot::LinkId link(Port port) { return autopilot::LinkId{static_cast<std::uint16_t>(port)}; }
  void speak(Sender& out);

  vsm::Bridge bridge_;
  std::set<Port> known_;
  std::uint64_t messages_{};
  std::vector<autopilot::FleetFact> facts_;
};

}  // namespace ponte::world
