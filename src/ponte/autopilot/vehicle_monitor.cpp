#include "ponte/autopilot/vehicle_monitor.hpp"

#include "ponte/autopilot/telemetry_rows.hpp"
#include "ponte/autopilot/telemetry_rows_v09.hpp"
#include "ponte/autopilot/v09.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_item.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/v09/heartbeat.hpp"
#include "ponte/mavlink/v09/statustext.hpp"
#include "ponte/mavlink/v09/system_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace ponte::autopilot {
namespace {

using vehicle::Alert;
using vehicle::Condition;
using vehicle::ModeKind;
using vehicle::Moment;
using vehicle::Subsystem;

constexpr std::string_view heartbeat_lost = "vehicle heartbeat lost";

/// ArduPilot sends the landed state only while somebody wants it; PX4 every 10 s on the slowest links.
constexpr std::chrono::seconds landed_state_lifetime{15};

/// When the message was true at the source.
template <mavlink::Message M>
WallTime sample_time(SampleClock& clock, const M& message, WallTime received) {
  if constexpr (requires { message.time_boot_ms; })
    return clock.from_boot_ms(message.time_boot_ms, received);
  else if constexpr (requires { message.time_usec; })
    return clock.from_usec(message.time_usec, received);
  else if constexpr (requires { message.usec; })
    return clock.from_usec(message.usec, received);
  else
    return clock.from_reception(received);
}

template <class Table>
void apply_table(const Table& table, const mavlink::FrameView& frame, vehicle::State& state, SampleClock& clock,
                 Timestamp now, WallTime received) {
  using M = typename MessageOf<Table>::type;
  if (!mavlink::carries<M>(frame)) return;
  const auto message = mavlink::decode<M>(frame);
  const MappingContext context{state, sample_time(clock, message, received)};
  const vehicle::Moment moment{context.at, now, state.revision};
  const auto learn = [&](const auto& row) {
    if (const auto value = row.convert(message, context)) (state.*row.target).learn(*value, moment, row.rank);
  };
  std::apply([&](const auto&... row) { (learn(row), ...); }, table);
}

std::vector<RowText> describe_tables(const auto& tables) {
  std::vector<RowText> all;
  std::apply(
      [&](const auto&... table) {
        (std::apply([&](const auto&... row) { (all.push_back(describe(row)), ...); }, table), ...);
      },
      tables);
  return all;
}

/// The messages that can change the leg which is flown.
bool concerns_leg(const mavlink::FrameView& frame) {
  return mavlink::carries<messages::MissionCurrent>(frame) || mavlink::carries<messages::MissionItemReached>(frame) ||
         mavlink::carries<messages::MissionCount>(frame) || mavlink::carries<messages::MissionItem>(frame) ||
         mavlink::carries<messages::MissionItemInt>(frame) || mavlink::carries<messages::MissionAck>(frame) ||
         mavlink::carries<messages::HomePosition>(frame);
}

/// What there is room for: the low digits tell vehicles apart.
Text<15> last_digits(std::string_view digits) { return Text<15>{digits.substr(digits.size() - 15)}; }

}  // namespace

void VehicleMonitor::on_message(Timestamp now, WallTime received, const mavlink::FrameView& frame,
                                Outbox<Alert>& alerts) {
  on_tick(now, received, alerts);
  ++state_.revision;
  if (frame.version == mavlink::Version::v0_9)
    learn_v09(now, received, frame, alerts);
  else
    learn(now, received, frame, alerts);
}

void VehicleMonitor::learn(Timestamp now, WallTime received, const mavlink::FrameView& frame, Outbox<Alert>& alerts) {
  std::apply([&](const auto&... table) { (apply_table(table, frame, state_, clock_, now, received), ...); },
             telemetry_tables);

  const auto moment = moment_of(now, received);
  if (mavlink::carries<messages::Heartbeat>(frame)) on_heartbeat(moment, frame, alerts);
  if (mavlink::carries<messages::AutopilotVersion>(frame)) on_autopilot_version(moment, frame);
  if (mavlink::carries<messages::SysStatus>(frame)) {
    sensors_ = sensor_bits(mavlink::decode<messages::SysStatus>(frame));
    update_subsystems(moment);
  }
  if (mavlink::carries<messages::SystemTime>(frame)) {
    const auto time = mavlink::decode<messages::SystemTime>(frame);
    clock_.on_system_time(time.time_unix_usec, time.time_boot_ms, received);
  }
  if (mavlink::carries<messages::ExtendedSysState>(frame)) {
    signs_.landed_state = mavlink::decode<messages::ExtendedSysState>(frame).landed_state;
    landed_state_heard_ = now;
    update_phase(moment);
  }
  if (mavlink::carries<messages::Statustext>(frame)) {
    const auto text = mavlink::decode<messages::Statustext>(frame);
    texts_.on_chunk(now, text.severity, text.id, text.chunk_seq, text.text.view(),
                    [&](const Alert& alert) { alerts.push(alert); });
  }
  if (mavlink::carries<messages::MissionCurrent>(frame)) {
    const auto id = mavlink::decode<messages::MissionCurrent>(frame).mission_id;
    if (id != 0)
      state_.mission_id.learn(Text<19>{fmt::format("{:08x}", id)}, moment);
    else
      state_.mission_id.forget();
  }
  if (concerns_leg(frame)) {
    mission_.on_vehicle_message(frame);
    update_leg(moment);
  }
}

/// In MAVLink 0.9, what HEARTBEAT does not say of the mode and the state is in SYS_STATUS.
void VehicleMonitor::learn_v09(Timestamp now, WallTime received, const mavlink::FrameView& frame,
                               Outbox<Alert>& alerts) {
  std::apply([&](const auto&... table) { (apply_table(table, frame, state_, clock_, now, received), ...); },
             telemetry_tables_v09);
  const auto moment = moment_of(now, received);
  if (mavlink::carries<mavlink::v09::Heartbeat>(frame)) {
    const auto heartbeat = mavlink::decode<mavlink::v09::Heartbeat>(frame);
    on_alive(moment, v09::autopilot_of(heartbeat.autopilot), v09::airframe_of(heartbeat.type), alerts);
  }
  if (mavlink::carries<mavlink::v09::SysStatus>(frame)) on_status_v09(moment, frame);
  if (mavlink::carries<mavlink::v09::Statustext>(frame)) {
    const auto text = mavlink::decode<mavlink::v09::Statustext>(frame);
    texts_.on_chunk(now, v09::severity_of(text.severity), 0, 0, text.text.view(),
                    [&](const Alert& alert) { alerts.push(alert); });
  }
}

void VehicleMonitor::on_status_v09(const Moment& moment, const mavlink::FrameView& frame) {
  const auto status = mavlink::decode<mavlink::v09::SysStatus>(frame);
  signs_.system_status = v09::system_status_of(status.status);
  signs_.armed = v09::is_armed(status.mode, status.status);
  signs_.landed_state = v09::landed_state_of(status.nav_mode);
  mode_v09_ = v09::mode_of(status.mode, status.nav_mode);
  update_mode(moment);
  update_phase(moment);
  update_subsystems(moment);
}

/// A HEARTBEAT of any version.
void VehicleMonitor::on_alive(const Moment& moment, std::uint8_t autopilot, std::uint8_t airframe,
                              Outbox<Alert>& alerts) {
  if (link_ == Link::missed || link_ == Link::lost)
    alerts.push(Alert{Condition::no_status, Subsystem::comms, heartbeat_lost});
  link_ = Link::alive;
  last_heartbeat_ = moment.heard;
  auto identity = state_.identity.get().value_or(vehicle::Identity{});
  identity.autopilot = autopilot;
  identity.airframe = airframe;
  state_.identity.learn(identity, moment);
}

void VehicleMonitor::on_heartbeat(const Moment& moment, const mavlink::FrameView& frame, Outbox<Alert>& alerts) {
  const auto heartbeat = mavlink::decode<messages::Heartbeat>(frame);
  on_alive(moment, heartbeat.autopilot, heartbeat.type, alerts);

  signs_.stack = stack_of(heartbeat.autopilot, heartbeat.type);
  signs_.system_status = heartbeat.system_status;
  signs_.armed = (heartbeat.base_mode & messages::MAV_MODE_FLAG_SAFETY_ARMED) != 0;
  if (moment.heard - landed_state_heard_ > landed_state_lifetime) signs_.landed_state.reset();
  custom_mode_.reset();
  if ((heartbeat.base_mode & messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED) != 0) custom_mode_ = heartbeat.custom_mode;
  mission_.set_first_item_is_home(heartbeat.autopilot == messages::MAV_AUTOPILOT_ARDUPILOTMEGA);
  mode_v09_.reset();
  update_mode(moment);
  update_phase(moment);
  update_subsystems(moment);
}

/// MAVLink says "no mode" by silence only; a mission item in progress can mean more than the mode that flies it.
void VehicleMonitor::update_mode(const Moment& moment) {
  if (!is_heard()) return;
  auto mode = custom_mode_ ? mode_from(signs_.stack, *custom_mode_) : mode_v09_.value_or(vehicle::Mode{});
  const auto command = mission_.current_command();
  if (mode.kind == ModeKind::mission && command) {
    if (signs_.stack == Stack::ardupilot_plane && *command == messages::MAV_CMD_NAV_LAND) mode.kind = ModeKind::land;
    if (signs_.stack == Stack::ardupilot_copter && *command == messages::MAV_CMD_NAV_TAKEOFF && signs_.armed)
      mode.kind = ModeKind::take_off;
  }
  signs_.mode = mode.kind;
  state_.mode.learn(mode, moment);
}

void VehicleMonitor::update_phase(const Moment& moment) {
  if (is_heard()) state_.phase.learn(phase_from(signs_), moment);
}

void VehicleMonitor::update_leg(const Moment& moment) {
  auto leg = mission_.leg(state_.home_altitude_msl.get());
  if (leg.from) {
    const bool is_same = state_.leg && state_.leg.value().from && state_.leg.value().from->number == leg.from->number;
    leg.from->reached = is_same ? state_.leg.value().from->reached : moment.at;
  }
  if (leg == vehicle::Leg{})
    state_.leg.forget();
  else
    state_.leg.learn(leg, moment);
  update_mode(moment);
}

void VehicleMonitor::on_autopilot_version(const Moment& moment, const mavlink::FrameView& frame) {
  const auto version = mavlink::decode<messages::AutopilotVersion>(frame);
  auto identity = state_.identity.get().value_or(vehicle::Identity{});
  const bool has_uid2 = std::ranges::any_of(version.uid2, [](std::uint8_t byte) { return byte != 0; });
  if (has_uid2)
    identity.serial = std::string_view{to_hex(std::as_bytes(std::span{version.uid2}))};
  else if (version.uid != 0)
    identity.serial = last_digits(fmt::format("{:016x}", version.uid));
  state_.identity.learn(identity, moment);
}

void VehicleMonitor::update_subsystems(const Moment& moment) {
  SubsystemConditions conditions;
  if (sensors_) conditions = conditions_from(*sensors_, signs_.armed);
  if (const auto overall = condition_of_state(signs_.system_status)) {
    auto& vsm = conditions[static_cast<std::size_t>(Subsystem::vsm)];
    vsm = vsm ? std::max(*vsm, *overall) : overall;
  }
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (conditions[i])
      state_.subsystems[i].learn(*conditions[i], moment);
    else if (state_.subsystems[i])
      state_.subsystems[i].learn(Condition::no_status, moment);
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
    const auto moment = moment_of(now, received);
    state_.mode.learn(vehicle::Mode{}, moment);
    state_.phase.learn(vehicle::Phase::unknown, moment);
    clock_ = {};  // it may boot in the meantime
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
  static const auto texts = describe_tables(telemetry_tables);
  return texts;
}

std::span<const RowText> telemetry_row_texts_v09() {
  static const auto texts = describe_tables(telemetry_tables_v09);
  return texts;
}

}  // namespace ponte::autopilot
