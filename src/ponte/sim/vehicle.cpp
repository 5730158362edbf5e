#include "ponte/sim/vehicle.hpp"

#include <cmath>

namespace ponte::sim {
namespace {

/// How long a reboot keeps it silent before its time begins again.
constexpr auto reboot_steps = std::chrono::milliseconds{400} / Airframe::step_length;
constexpr auto radio_interval = std::chrono::seconds{1} / Airframe::step_length;

// Of the capacity; less than where both autopilots call it so.
constexpr double charge_when_low = 0.1;
constexpr double charge_when_critical = 0.04;

std::unique_ptr<Airframe> airframe_of(const VehicleConfig& config) {
  if (config.type == AirframeType::plane) return std::make_unique<Plane>(config.plane, config.start, config.heading);
  return std::make_unique<Copter>(config.copter, config.start, config.heading);
}

}  // namespace

Vehicle::Vehicle(const VehicleConfig& config)
    : config_{config},
      airframe_{airframe_of(config)},
      wind_{config.wind, config.seed},
      faults_{config.faults},
      memory_{config},
      autopilot_{std::in_place, config, memory_, Timestamp{}} {
  if (config.radio) radio_.emplace(config.version);
}

void Vehicle::on_frame(Timestamp now, const mavlink::FrameView& frame, const mavlink::MessageInfo& /*message*/,
                       Outbox<mavlink::FrameBuffer>& out) {
  on_tick(now, out);
  if (!autopilot_ || has_fault(FaultKind::link_loss)) return;
  autopilot_->on_frame(now, frame, *airframe_, out);
  if (autopilot_->wants_reboot()) reboot();
}

void Vehicle::on_tick(Timestamp now, Outbox<mavlink::FrameBuffer>& out) {
  while (next_deadline() <= now) step(out);
}

void Vehicle::reboot() {
  autopilot_.reset();
  if (config_.personality == Personality::px4) airframe_->disarm();
  boot_step_ = steps_ + reboot_steps;
}

/// While ArduPilot starts anew, the aircraft goes on with what it was told last.
void Vehicle::step(Outbox<mavlink::FrameBuffer>& out) {
  ++steps_;
  begin_faults();
  auto& heard = has_fault(FaultKind::link_loss) ? unheard_ : out;
  if (!autopilot_ && steps_ >= boot_step_) autopilot_.emplace(config_, memory_, step_at(steps_));
  if (autopilot_) autopilot_->steer(step_at(steps_), *airframe_, heard);

  Conditions conditions{.wind = wind_.step(), .motors_run = !has_fault(FaultKind::motor)};
  if (autopilot_) {
    conditions.position_error = autopilot_->position_error();
    conditions.motors_run = conditions.motors_run && !autopilot_->is_terminated();
  }
  airframe_->step(conditions);
  if (autopilot_) autopilot_->report(step_at(steps_), steps_, *airframe_, !has_fault(FaultKind::gps_loss), heard);
  if (radio_ && steps_ % radio_interval == 0) report_radio(out);
}

void Vehicle::report_radio(Outbox<mavlink::FrameBuffer>& out) {
  const auto place = offset_between(config_.start, truth().position);
  const Metres distance{std::hypot(place.north, place.east, place.down)};
  radio_->report(distance, !has_fault(FaultKind::link_loss), out);
}

void Vehicle::begin_faults() {
  const auto begins = [&](FaultKind kind) { return faults_.begins(kind, now() - Airframe::step_length, now()); };
  if (begins(FaultKind::battery_low)) airframe_->lose_charge(charge_when_low);
  if (begins(FaultKind::battery_critical)) airframe_->lose_charge(charge_when_critical);
  if (begins(FaultKind::reboot)) reboot();
}

}  // namespace ponte::sim
