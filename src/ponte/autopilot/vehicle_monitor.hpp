#pragma once

#include "ponte/autopilot/life_cycle.hpp"
#include "ponte/autopilot/mapping.hpp"
#include "ponte/autopilot/mission_copy.hpp"
#include "ponte/autopilot/sample_time.hpp"
#include "ponte/autopilot/status_text.hpp"
#include "ponte/autopilot/subsystem_health.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/vehicle/state.hpp"

#include <optional>
#include <span>

namespace ponte::autopilot {

/// Silence after which a vehicle's HEARTBEAT is missed, and after which it counts as lost.
inline constexpr std::chrono::seconds heartbeat_warning{3};
inline constexpr std::chrono::seconds heartbeat_loss{10};

/// Learns what one vehicle says: keeps its `vehicle::State` and tells its alerts. Listens only, sends nothing.
class VehicleMonitor {
 public:
  /// A message of the vehicle's autopilot, `received` at that calendar time.
  void on_message(Timestamp now, WallTime received, const mavlink::FrameView& frame, Outbox<vehicle::Alert>& alerts);
  /// A message that a ground station sent to the vehicle.
  void on_station_message(const mavlink::FrameView& frame) { mission_.on_station_message(frame); }

  void on_tick(Timestamp now, WallTime received, Outbox<vehicle::Alert>& alerts);
  /// When `on_tick` next has something to do; nothing while no time-out runs.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;
  /// Tells what waits for more, e.g. at the end of a recording.
  void finish(Outbox<vehicle::Alert>& alerts);

  [[nodiscard]] const vehicle::State& state() const { return state_; }

 private:
  enum class Link : std::uint8_t { never_heard, alive, missed, lost };

  [[nodiscard]] bool is_heard() const { return link_ == Link::alive || link_ == Link::missed; }
  /// Of something that a message without a time stamp tells.
  [[nodiscard]] vehicle::Moment moment_of(Timestamp now, WallTime received) const {
    return {clock_.from_reception(received), now, state_.revision};
  }

  void learn(Timestamp now, WallTime received, const mavlink::FrameView& frame, Outbox<vehicle::Alert>& alerts);
  void learn_v09(Timestamp now, WallTime received, const mavlink::FrameView& frame, Outbox<vehicle::Alert>& alerts);
  void on_heartbeat(const vehicle::Moment& moment, const mavlink::FrameView& frame, Outbox<vehicle::Alert>& alerts);
  void on_status_v09(const vehicle::Moment& moment, const mavlink::FrameView& frame);
  void on_alive(const vehicle::Moment& moment, std::uint8_t autopilot, std::uint8_t airframe,
                Outbox<vehicle::Alert>& alerts);
  void on_autopilot_version(const vehicle::Moment& moment, const mavlink::FrameView& frame);
  void update_mode(const vehicle::Moment& moment);
  void update_phase(const vehicle::Moment& moment);
  void update_leg(const vehicle::Moment& moment);
  void update_subsystems(const vehicle::Moment& moment);

  vehicle::State state_;
  SampleClock clock_;
  MissionCopy mission_;
  StatusTextAssembler texts_;
  LifeCycleSigns signs_;
  Timestamp landed_state_heard_{};
  std::optional<std::uint32_t> custom_mode_;  ///< nothing while HEARTBEAT says that it is not valid
  std::optional<vehicle::Mode> mode_v09_;     ///< what SYS_STATUS says, in MAVLink 0.9
  Link link_{Link::never_heard};
  Timestamp last_heartbeat_{};
  std::optional<SensorBits> sensors_;
};

/// Every row of the mapping tables in words, for documentation and tests.
[[nodiscard]] std::span<const RowText> telemetry_row_texts();
/// Those for MAVLink 0.9.
[[nodiscard]] std::span<const RowText> telemetry_row_texts_v09();

}  // namespace ponte::autopilot
