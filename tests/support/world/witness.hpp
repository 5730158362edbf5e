#pragma once

#include "support/world/pilot.hpp"
#include "support/world/vehicle_node.hpp"
#include "support/world/world.hpp"

#include <vector>

namespace ponte::world {

/// Hears one vehicle over a link of its own that loses nothing, sees what is true of it, says nothing, and remembers.
class Witness final : public Participant, private mavlink::FrameSink {
 public:
  explicit Witness(const VehicleNode& vehicle);

  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override;
  void on_tick(Timestamp now, Sender& out) override;
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override { return std::nullopt; }

  /// How often it was armed after it had not been.
  [[nodiscard]] int times_armed() const;

  // Whether it was so at some moment from `from` to `to`.
  [[nodiscard]] bool was_armed(bool armed, Timestamp from, Timestamp to) const;
  [[nodiscard]] bool was_airborne(Timestamp from, Timestamp to) const;
  /// By what it said in HEARTBEAT itself; what it said last before `from` counts, too.
  [[nodiscard]] bool was_in_mode(std::uint32_t custom_mode, Timestamp from, Timestamp to) const;

 private:
  struct Look {
    Timestamp time{};
    bool armed{};
    bool airborne{};
    std::uint32_t custom_mode{};
    friend bool operator==(const Look&, const Look&) = default;
  };

  template <class Condition>
  [[nodiscard]] bool was(const Condition& condition, Timestamp from, Timestamp to) const;
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void look(Timestamp now);

  const VehicleNode& vehicle_;
  mavlink::Parser parser_;
  std::uint32_t custom_mode_{};
  std::vector<Look> looks_;  // whenever something changed
};

/// Puts a mission on board by a cable that nobody else uses.
void load_mission(sim::Vehicle& vehicle, Timestamp now, const std::vector<MissionItem>& items);

}  // namespace ponte::world
