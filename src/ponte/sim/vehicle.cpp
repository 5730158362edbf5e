#include "ponte/sim/vehicle.hpp"

namespace ponte::sim {
namespace {

/// How long a reboot keeps it silent before its time begins again.
constexpr auto reboot_steps = std::chrono::milliseconds{400} / Airframe::step_length;

}  // namespace

Vehicle::Vehicle(const VehicleConfig& config)
    : config_{config},
      copter_{config.copter, config.start, config.heading},
      memory_{config},
      autopilot_{std::in_place, config, memory_, Timestamp{}} {}

void Vehicle::on_frame(Timestamp now, const mavlink::FrameView& frame, const mavlink::MessageInfo& /*message*/,
                       Outbox<Frame>& out) {
  on_tick(now, out);
  if (!autopilot_) return;
  autopilot_->on_frame(now, frame, copter_, out);
  if (!autopilot_->wants_reboot()) return;
  autopilot_.reset();
  boot_step_ = steps_ + reboot_steps;
}

void Vehicle::on_tick(Timestamp now, Outbox<Frame>& out) {
  while (next_deadline() <= now) step(out);
}

void Vehicle::step(Outbox<Frame>& out) {
  ++steps_;
  if (!autopilot_ && steps_ >= boot_step_) autopilot_.emplace(config_, memory_, step_at(steps_));
  if (autopilot_) autopilot_->steer(step_at(steps_), copter_, out);
  copter_.step({});
  if (autopilot_) autopilot_->report(step_at(steps_), steps_, copter_, out);
}

}  // namespace ponte::sim
