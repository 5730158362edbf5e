#pragma once

#include "ponte/sim/failsafe_settings.hpp"
#include "ponte/sim/fence.hpp"
#include "ponte/sim/flight.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ponte::sim {

/// How much is left in the battery, as the autopilot judges it.
enum class ChargeState : std::uint8_t { ok, low, critical, emergency };

/// Notices trouble and changes the flight's mode for it, once for each trouble; who flies may then change it again.
/// ArduPilot acts at once; PX4 holds first for what can wait, and lets the worst trouble decide.
class Failsafes {
 public:
  Failsafes(VehicleKind kind, const FailsafeSettings& settings) : kind_{kind}, settings_{settings} {}

  void set_settings(const FailsafeSettings& settings) { settings_ = settings; }
  /// The fence on board, as it is stored; valid until the next call.
  void set_fence(std::span<const MissionItem> items) { fence_.set_items(items); }
  /// Of a ground station. One that was never heard is not missed.
  void on_station_heartbeat(Duration now) { station_heard_at_ = now; }

  /// Each step, before that of the flight.
  void step(Duration now, bool has_position, Flight& flight, Airframe& airframe, Outbox<FlightFact>& facts);

  /// The vehicle is in trouble: MAV_STATE_CRITICAL. ArduPilot says so on the ground as well.
  [[nodiscard]] bool is_active() const { return is_active_; }
  /// The motors are to stop, and for good.
  [[nodiscard]] bool is_terminated() const { return is_terminated_; }
  /// It never gets better before the next start.
  [[nodiscard]] ChargeState charge_state() const { return charge_; }
  /// Why it does not let itself be armed, or nothing.
  [[nodiscard]] std::optional<std::string_view> refuses_to_arm() const;

 private:
  struct Step {
    Duration now;
    Flight& flight;
    Airframe& airframe;
    Outbox<FlightFact>& facts;
  };

  [[nodiscard]] bool is_px4() const { return kind_.personality == Personality::px4; }
  [[nodiscard]] ChargeState measured(Duration now, const BatteryState& battery);
  void watch_battery(const Step& step);
  void watch_station(const Step& step);
  void watch_position(bool has_position, const Step& step);
  void watch_fence(bool has_position, const Step& step);
  void tell_battery(const Step& step) const;
  void demand(FailsafeAction action, bool can_wait, const Step& step);
  void act(FailsafeAction action, const Step& step);
  void enter(FlightMode mode, const Step& step);

  VehicleKind kind_;
  FailsafeSettings settings_;
  Fence fence_;
  std::optional<Duration> station_heard_at_{};
  std::optional<Duration> low_since_{};  // the voltage
  std::optional<Duration> critical_since_{};
  ChargeState charge_{ChargeState::ok};
  bool station_lost_{};
  bool position_lost_{};
  bool fence_broken_{};
  FailsafeAction pending_{};  // after the hold
  Duration pending_until_{};
  bool is_active_{};
  bool is_terminated_{};
};

}  // namespace ponte::sim
