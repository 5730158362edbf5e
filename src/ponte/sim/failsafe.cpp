#include "ponte/sim/failsafe.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <utility>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

using enum FailsafeAction;

/// Whether the voltage has been below the limit for so long.
bool has_lasted(bool is_below, Duration now, Duration limit, std::optional<Duration>& since) {
  if (!is_below) since.reset();
  if (is_below && !since) since = now;
  return since && now - *since >= limit;
}

/// How much has been done already by the mode that it flies in.
FailsafeAction rank_of(FlightMode mode) {
  if (mode == FlightMode::land) return land;
  return mode == FlightMode::rtl ? rtl : none;
}

}  // namespace

void Failsafes::step(Duration now, bool has_position, Flight& flight, Airframe& airframe, Outbox<FlightFact>& facts) {
  const Step step{now, flight, airframe, facts};
  watch_battery(step);
  watch_station(step);
  watch_position(has_position, step);
  watch_fence(has_position, step);
  if (pending_ != none && now >= pending_until_) {
    if (is_px4() && airframe.state().armed) facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "Failsafe activated\t"));
    act(std::exchange(pending_, none), step);
  }

  const bool battery =
      charge_ >= (is_px4() ? ChargeState::critical : ChargeState::low) && (!is_px4() || settings_.critical > warn);
  const bool station = station_lost_ && settings_.station > warn;
  const bool fence = fence_broken_ && settings_.breach > warn;
  is_active_ = battery || station || position_lost_ || fence || is_terminated_;
  if (is_px4()) is_active_ = is_active_ && airframe.state().armed;
}

ChargeState Failsafes::measured(Duration now, const BatteryState& battery) {
  if (is_px4()) {
    if (battery.remaining < settings_.emergency_share) return ChargeState::emergency;
    if (battery.remaining < settings_.critical_share) return ChargeState::critical;
    return battery.remaining < settings_.low_share ? ChargeState::low : ChargeState::ok;
  }
  const auto wait = settings_.low_volts_last;
  const bool low = has_lasted(battery.volts < settings_.low_volts, now, wait, low_since_);
  const bool critical = has_lasted(battery.volts < settings_.critical_volts, now, wait, critical_since_);
  const double left = battery.left_ampere_hours;
  if (critical || left < settings_.critical_ampere_hours) return ChargeState::critical;
  return low || left < settings_.low_ampere_hours ? ChargeState::low : ChargeState::ok;
}

void Failsafes::watch_battery(const Step& step) {
  const auto now = measured(step.now, step.airframe.state().battery);
  if (now <= charge_) return;
  charge_ = now;
  tell_battery(step);
  const auto action = now == ChargeState::low        ? settings_.low
                      : now == ChargeState::critical ? settings_.critical
                                                     : settings_.emergency;
  demand(action, true, step);
}

void Failsafes::tell_battery(const Step& step) const {
  const bool is_low = charge_ == ChargeState::low;
  if (is_px4()) {
    if (charge_ != ChargeState::emergency)
      step.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "{} battery\t", is_low ? "Low" : "Critical"));
    return;
  }
  const auto& battery = step.airframe.state().battery;
  step.facts.push(notice(messages::MAV_SEVERITY_WARNING, "Battery 1 is {} {:.2f}V used {:.0f} mAh",
                         is_low ? "low" : "critical", battery.volts, battery.consumed_ampere_hours * 1e3));
  step.facts.push(notice(messages::MAV_SEVERITY_WARNING, "Battery Failsafe"));
}

void Failsafes::watch_station(const Step& step) {
  const bool lost = station_heard_at_ && settings_.station_time_out > Duration{} &&
                    step.now - *station_heard_at_ >= settings_.station_time_out && settings_.station != none;
  if (lost == station_lost_) return;
  station_lost_ = lost;
  if (!is_px4()) step.facts.push(notice(messages::MAV_SEVERITY_WARNING, "GCS Failsafe{}", lost ? "" : " Cleared"));
  if (lost) demand(settings_.station, true, step);
}

void Failsafes::watch_position(bool has_position, const Step& step) {
  const bool needs_one = flight_mode_info(kind_, step.flight.mode()).needs_position;
  const bool matters = needs_one || position_lost_ || settings_.position_in_every_mode;
  const bool lost = !has_position && step.airframe.state().airborne && matters;
  if (lost == position_lost_) return;
  position_lost_ = lost;
  if (!lost) {
    if (!is_px4()) step.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "EKF Failsafe Cleared"));
    return;
  }
  step.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "{}", is_px4() ? "Failsafe activated\t" : "EKF variance"));
  demand(settings_.position, false, step);
  if (!is_px4() && settings_.position > warn)
    step.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "EKF Failsafe: changed to {} Mode",
                           flight_mode_info(kind_, step.flight.mode()).name));
}

void Failsafes::watch_fence(bool has_position, const Step& step) {
  if (!has_position || !step.airframe.state().airborne) {
    fence_broken_ = fence_broken_ && step.airframe.state().airborne;
    return;
  }
  const auto breach = fence_.breach(settings_.fence, step.flight.home(), step.airframe.known_position());
  if (breach.has_value() == fence_broken_) return;
  fence_broken_ = breach.has_value();
  if (!breach) return;
  if (is_px4())
    step.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "Geofence violation\t"));
  else
    step.facts.push(notice(messages::MAV_SEVERITY_NOTICE, "{} fence breached", *breach));
  demand(settings_.breach, false, step);
}

void Failsafes::demand(FailsafeAction action, bool can_wait, const Step& step) {
  if (action <= warn || !step.airframe.state().armed) return;
  if (!can_wait || settings_.hold_first <= Duration{} || action == hold) return act(action, step);
  if (pending_ == none) {
    pending_until_ = step.now + settings_.hold_first;
    step.facts.push(notice(messages::MAV_SEVERITY_CRITICAL, "Failsafe activated: entering Hold for {} seconds\t",
                           std::chrono::duration_cast<std::chrono::seconds>(settings_.hold_first).count()));
    act(hold, step);
  }
  pending_ = std::max(pending_, action);
}

/// Never less than the mode does already, and on the ground nothing but to stay there.
void Failsafes::act(FailsafeAction action, const Step& step) {
  const auto& state = step.airframe.state();
  if (action == terminate) {
    is_terminated_ = true;
    return;
  }
  if (!state.armed || action <= rank_of(step.flight.mode())) return;
  if (!state.airborne) {
    if (is_px4() || kind_.type == AirframeType::plane) return;
    step.airframe.disarm();
    step.flight.on_disarmed();
    step.facts.push(notice(messages::MAV_SEVERITY_INFO, "Disarming motors"));
    return;
  }
  switch (action) {
    case keep_altitude: return enter(FlightMode::altitude_hold, step);
    case hold: return enter(is_px4() ? FlightMode::loiter : FlightMode::guided, step);
    case rtl: return enter(FlightMode::rtl, step);
    default: return enter(has_mode(kind_, FlightMode::land) ? FlightMode::land : FlightMode::rtl, step);
  }
}

/// Lands if it cannot, as without a position.
void Failsafes::enter(FlightMode mode, const Step& step) {
  if (mode == step.flight.mode()) return step.flight.restart(step.now, step.airframe, step.facts);
  if (step.flight.enter(mode, step.now, step.airframe, step.facts)) return;
  if (mode != FlightMode::land && has_mode(kind_, FlightMode::land))
    static_cast<void>(step.flight.enter(FlightMode::land, step.now, step.airframe, step.facts));
}

std::optional<std::string_view> Failsafes::refuses_to_arm() const {
  if (is_terminated_) return "Flight terminated";
  if (charge_ == ChargeState::low) return "Battery 1 low voltage failsafe";
  if (charge_ > ChargeState::low) return "Battery 1 critical voltage failsafe";
  return std::nullopt;
}

}  // namespace ponte::sim
