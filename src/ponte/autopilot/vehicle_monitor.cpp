#include "ponte/autopilot/vehicle_monitor.hpp"

#include "ponte/autopilot/subsystem_health.hpp"
#include "ponte/autopilot/telemetry_rows.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace ponte::autopilot {
namespace {

using vehicle::Alert;
using vehicle::Condition;
using vehicle::ModeKind;
using vehicle::Subsystem;

constexpr std::string_view heartbeat_lost = "vehicle heartbeat lost";

template <mavlink::Message M>
bool is(const mavlink::FrameView& frame) {
  return frame.message == M::info.id;
}

/// When the message was true at the source, if it says so.
template <mavlink::Message M>
WallTime sample_time(SampleClock& clock, const M& message, WallTime received) {
  if constexpr (requires { message.time_boot_ms; })
    return clock.from_boot_ms(message.time_boot_ms, received);
  else if constexpr (requires { message.time_usec; })
    return clock.from_usec(message.time_usec, received);
  else
    return received;
}

template <class Table>
void apply_table(const Table& table, const mavlink::FrameView& frame, vehicle::State& state, SampleClock& clock,
                 WallTime received) {
  using M = typename MessageOf<Table>::type;
  if (!is<M>(frame)) return;
  const auto message = mavlink::decode<M>(frame);
  const MappingContext context{state, sample_time(clock, message, received)};
  const auto learn = [&](const auto& row) {
    if (const auto value = row.convert(message, context))
      (state.*row.target).learn(*value, context.at, state.revision, row.rank);
  };
  std::apply([&](const auto&... row) { (learn(row), ...); }, table);
}

}  // namespace

void VehicleMonitor::on_message(Timestamp now, WallTime received, const mavlink::FrameView& frame,
                                Outbox<Alert>& alerts) {
  ++state_.revision;
  on_tick(now, received, alerts);
  std::apply([&](const auto&... table) { (apply_table(table, frame, state_, clock_, received), ...); },
             telemetry_tables);

  if (is<messages::Heartbeat>(frame)) on_heartbeat(now, received, frame, alerts);
  if (is<messages::AutopilotVersion>(frame)) on_autopilot_version(received, frame);
  if (is<messages::SysStatus>(frame)) on_sys_status(received, frame);
  if (is<messages::SystemTime>(frame)) {
    const auto time = mavlink::decode<messages::SystemTime>(frame);
    clock_.on_system_time(time.time_unix_usec, time.time_boot_ms);
  }
  if (is<messages::ExtendedSysState>(frame)) {
    signs_.landed_state = mavlink::decode<messages::ExtendedSysState>(frame).landed_state;
    update_phase(received);
  }
  if (is<messages::Statustext>(frame)) {
    const auto text = mavlink::decode<messages::Statustext>(frame);
    texts_.on_chunk(now, text.severity, text.id, text.chunk_seq, text.text.view(),
                    [&](const Alert& alert) { alerts.push(alert); });
  }
  if (is<messages::MissionCurrent>(frame)) {
    const auto current = mavlink::decode<messages::MissionCurrent>(frame);
    if (current.mission_id != 0) learn(state_.mission_id, Text<19>{fmt::format("{:08x}", current.mission_id)}, received);
  }
  mission_.on_vehicle_message(frame);
  update_leg(received);
}

void VehicleMonitor::on_heartbeat(Timestamp now, WallTime received, const mavlink::FrameView& frame,
                                  Outbox<Alert>& alerts) {
  const auto heartbeat = mavlink::decode<messages::Heartbeat>(frame);
  if (link_ == Link::missed || link_ == Link::lost)
    alerts.push(Alert{Condition::no_status, Subsystem::comms, heartbeat_lost});
  link_ = Link::alive;
  last_heartbeat_ = now;

  signs_.stack = stack_of(heartbeat.autopilot, heartbeat.type);
  signs_.system_status = heartbeat.system_status;
  signs_.armed = (heartbeat.base_mode & messages::MAV_MODE_FLAG_SAFETY_ARMED) != 0;
  custom_mode_ = heartbeat.custom_mode;
  mission_.set_first_item_is_home(heartbeat.autopilot == messages::MAV_AUTOPILOT_ARDUPILOTMEGA);

  auto identity = state_.identity.get().value_or(vehicle::Identity{});
  identity.autopilot = heartbeat.autopilot;
  identity.airframe = heartbeat.type;
  learn(state_.identity, identity, received);
  update_mode(received);
  update_phase(received);
  update_subsystems(received);
}

/// MAVLink says "no mode" by silence only; a mission item in progress can mean more than the mode that flies it.
void VehicleMonitor::update_mode(WallTime received) {
  auto mode = mode_from(signs_.stack, custom_mode_);
  const auto command = mission_.current_command();
  if (mode.kind == ModeKind::mission && command) {
    if (signs_.stack == Stack::ardupilot_plane && *command == messages::MAV_CMD_NAV_LAND) mode.kind = ModeKind::land;
    if (signs_.stack == Stack::ardupilot_copter && *command == messages::MAV_CMD_NAV_TAKEOFF && signs_.armed)
      mode.kind = ModeKind::take_off;
  }
  signs_.mode = mode.kind;
  learn(state_.mode, mode, received);
}

void VehicleMonitor::update_phase(WallTime received) {
  if (link_ != Link::never_heard) learn(state_.phase, phase_from(signs_), received);
}

void VehicleMonitor::update_leg(WallTime received) {
  auto leg = mission_.leg(state_.home_altitude_msl.get());
  if (!leg.from && !leg.to && !leg.next) return;
  if (leg.from) {
    const bool is_same = state_.leg && state_.leg.value().from && state_.leg.value().from->number == leg.from->number;
    leg.from->reached = is_same ? state_.leg.value().from->reached : received;
  }
  learn(state_.leg, leg, received);
  update_mode(received);
}

void VehicleMonitor::on_autopilot_version(WallTime received, const mavlink::FrameView& frame) {
  const auto version = mavlink::decode<messages::AutopilotVersion>(frame);
  auto identity = state_.identity.get().value_or(vehicle::Identity{});
  const bool has_uid2 = std::ranges::any_of(version.uid2, [](std::uint8_t byte) { return byte != 0; });
  if (has_uid2)
    identity.serial = std::string_view{to_hex(std::as_bytes(std::span{version.uid2}))};
  else if (version.uid != 0)
    identity.serial = std::string_view{fmt::format("{:016x}", version.uid)};
  learn(state_.identity, identity, received);
}

void VehicleMonitor::on_sys_status(WallTime received, const mavlink::FrameView& frame) {
  const auto status = mavlink::decode<messages::SysStatus>(frame);
  sensors_ = Sensors{status.onboard_control_sensors_present, status.onboard_control_sensors_enabled,
                     status.onboard_control_sensors_health};
  update_subsystems(received);
}

void VehicleMonitor::update_subsystems(WallTime received) {
  SubsystemConditions conditions;
  if (sensors_) conditions = conditions_from(sensors_->present, sensors_->enabled, sensors_->healthy, signs_.armed);
  if (const auto overall = condition_of_state(signs_.system_status)) {
    auto& vsm = conditions[static_cast<std::size_t>(Subsystem::vsm)];
    vsm = vsm ? std::max(*vsm, *overall) : overall;
  }
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (conditions[i])
      learn(state_.subsystems[i], *conditions[i], received);
    else if (state_.subsystems[i])
      learn(state_.subsystems[i], Condition::no_status, received);
  }
}

void VehicleMonitor::on_tick(Timestamp now, WallTime received, Outbox<Alert>& alerts) {
  texts_.on_tick(now, [&](const Alert& alert) { alerts.push(alert); });
  if (link_ == Link::alive && now - last_heartbeat_ >= heartbeat_warning) {
    link_ = Link::missed;
    alerts.push(Alert{Condition::warning, Subsystem::comms, heartbeat_lost});
  }
  if (link_ == Link::missed && now - last_heartbeat_ >= heartbeat_loss) {
    link_ = Link::lost;
    ++state_.revision;
    learn(state_.mode, vehicle::Mode{}, received);
    learn(state_.phase, vehicle::Phase::unknown, received);
    alerts.push(Alert{Condition::emergency, Subsystem::comms, heartbeat_lost});
  }
}

std::optional<Timestamp> VehicleMonitor::next_deadline() const {
  auto deadline = texts_.next_deadline();
  const auto consider = [&](Timestamp time) { deadline = deadline ? std::min(*deadline, time) : time; };
  if (link_ == Link::alive) consider(last_heartbeat_ + heartbeat_warning);
  if (link_ == Link::missed) consider(last_heartbeat_ + heartbeat_loss);
  return deadline;
}

void VehicleMonitor::finish(Outbox<Alert>& alerts) {
  texts_.finish([&](const Alert& alert) { alerts.push(alert); });
}

std::span<const RowText> telemetry_row_texts() {
  static const auto texts = [] {
    std::vector<RowText> all;
    std::apply(
        [&](const auto&... table) {
          (std::apply([&](const auto&... row) { (all.push_back(describe(row)), ...); }, table), ...);
        },
        telemetry_tables);
    return all;
  }();
  return texts;
}

}  // namespace ponte::autopilot
