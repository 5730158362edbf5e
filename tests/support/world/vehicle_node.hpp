#pragma once

#include "ponte/mavlink/parser.hpp"
#include "ponte/sim/vehicle.hpp"
#include "support/world/world.hpp"

#include <deque>

namespace ponte::world {

/// A simulated vehicle. What it says goes to all its links.
class VehicleNode final : public Participant, private mavlink::FrameSink {
 public:
  explicit VehicleNode(const sim::VehicleConfig& config) : vehicle_{config} {}

  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override;
  void on_tick(Timestamp now, Sender& out) override;
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override { return vehicle_.next_deadline(); }

  [[nodiscard]] sim::Vehicle& vehicle() { return vehicle_; }
  [[nodiscard]] const sim::Vehicle& vehicle() const { return vehicle_; }

 private:
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void speak(Sender& out);

  sim::Vehicle vehicle_;
  Outbox<mavlink::FrameBuffer> outbox_{2 * sim::Vehicle::frames_per_step};
  std::deque<mavlink::Parser> parsers_;  // by port
  Timestamp now_{};
};

}  // namespace ponte::world
