#include "ponte/sim/guided_flight.hpp"

namespace ponte::sim {

void GuidedFlight::take(const GuidedTarget& target, MetresPerSecond speed, const FlightContext& flight) {
  remember(target, flight);
  auto& airframe = flight.airframe;
  if (target.position && (flight.is_plane() || target.radius))
    airframe.circle(*target.position, target.radius.value_or(flight.settings.handling.loiter_radius),
                    target.speed.value_or(speed));
  else if (target.position)
    airframe.fly_to(*target.position, target.speed.value_or(speed));
  else if (target.velocity)
    airframe.move(*target.velocity);
  airframe.face({target.heading, target.turn_rate});
}

void GuidedFlight::remember(const GuidedTarget& target, const FlightContext& flight) {
  target_ = target;
  taken_at_ = flight.now;
}

void GuidedFlight::set_speed(MetresPerSecond speed, const FlightContext& flight) {
  if (!target_ || !target_->position) return;
  target_->speed = speed;
  take(GuidedTarget{*target_}, speed, flight);
}

void GuidedFlight::step(const FlightContext& flight) {
  if (!target_ || is_fresh(flight) || flight.is_px4()) return;
  if (!target_->position && (target_->velocity || target_->turn_rate)) {
    flight.airframe.hold();
    target_.reset();
  }
}

bool GuidedFlight::is_fresh(const FlightContext& flight) const {
  return target_ && flight.now - taken_at_ <= flight.settings.guided_time_out;
}

}  // namespace ponte::sim
