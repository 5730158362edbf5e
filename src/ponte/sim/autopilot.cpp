#include "ponte/sim/autopilot.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/gps_global_origin.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/set_mode.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/v09/statustext.hpp"

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr Duration satellite_interval = std::chrono::milliseconds{200};
constexpr Duration receiver_found_after = std::chrono::seconds{2};
constexpr Duration flat_fix_lasts = std::chrono::seconds{1};
constexpr Duration time_question_interval = std::chrono::seconds{10};

SatelliteFix fix_at(Duration since_boot, const VehicleConfig& config) {
  if (since_boot >= config.fix_after) return SatelliteFix::full;
  if (since_boot >= config.fix_after - flat_fix_lasts) return SatelliteFix::flat;
  return since_boot >= receiver_found_after ? SatelliteFix::none : SatelliteFix::no_receiver;
}

}  // namespace

Autopilot::Autopilot(const VehicleConfig& config, Timestamp boot)
    : config_{config},
      boot_{boot},
      sensors_{config.seed, config.noise},
      flight_{{config.personality, config.type},
              default_flight_settings({config.personality, config.type}),
              config.fly_square,
              config.square},
      sender_{config.version, config.system, config.component},
      rates_{telemetry_streams(config.version)} {
  snapshot_.system = config.system;
}

void Autopilot::steer(Timestamp now, Airframe& airframe, Outbox<Frame>& out) {
  flight_.step(now - boot_, airframe, facts_);
  tell_facts(out);
}

void Autopilot::report(Timestamp now, std::uint64_t step, const Airframe& airframe, Outbox<Frame>& out) {
  snapshot_.since_boot = now - boot_;
  update(airframe, step);
  tell_progress(out);
  if (!speaks_v09() && snapshot_.since_boot > Duration{} && snapshot_.since_boot % time_question_interval == Duration{})
    ask_time(now, out);

  for (std::size_t i = 0; i < rows().size(); ++i)
    if (rates_.take_due(i, snapshot_.since_boot)) rows()[i].send(snapshot_, sender_, out);
}

/// What it knows from now on.
void Autopilot::update(const Airframe& airframe, std::uint64_t step) {
  const auto& truth = airframe.state();
  auto& known = snapshot_;
  known.is_ready = known.since_boot >= config_.ready_after;
  known.armed = truth.armed;
  known.kind = flight_.kind();
  known.mode = flight_.mode();
  known.landed_state = flight_.landed_state(truth);
  known.readings = sensors_.read(truth, step);
  known.target = flight_.target(airframe);
  known.throttle = truth.throttle;
  known.battery = truth.battery;

  if (known.since_boot % satellite_interval == Duration{}) {
    const auto fix = fix_at(known.since_boot, config_);
    known.satellites = {fix, known.since_boot, sensors_.read_satellites(truth, step)};
  }
  known.utc.reset();
  if (known.satellites.fix == SatelliteFix::full)
    known.utc = config_.power_on +
                std::chrono::duration_cast<std::chrono::microseconds>((boot_ - Timestamp{}) + known.since_boot);

  known.has_position = known.since_boot >= config_.position_after;
  flight_.set_has_position(known.has_position);
  if (has_just_passed(config_.position_after)) {
    known.origin = truth.position;
    flight_.set_home(truth.position);
  }
  known.home = flight_.home();
}

void Autopilot::tell_progress(Outbox<Frame>& out) {
  if (has_just_passed(config_.ready_after)) say(messages::MAV_SEVERITY_INFO, "ArduPilot Ready", out);
  if (!has_just_passed(config_.position_after)) return;
  send_row(messages::GpsGlobalOrigin::info.id, out);
  send_row(messages::HomePosition::info.id, out);
  say(messages::MAV_SEVERITY_INFO, "EKF3 IMU0 origin set", out);
  say(messages::MAV_SEVERITY_INFO, "EKF3 IMU0 is using GPS", out);
}

bool Autopilot::has_just_passed(Duration moment) const {
  return snapshot_.since_boot >= moment && snapshot_.since_boot - Airframe::step_length < moment;
}

void Autopilot::on_frame(Timestamp now, const mavlink::FrameView& frame, Airframe& airframe, Outbox<Frame>& out) {
  if (frame.system == config_.system && frame.component == config_.component) return;  // our own, come back
  if (speaks_v09() || frame.version == mavlink::Version::v0_9) {
    if (speaks_v09()) on_frame_v09(frame, airframe, out);
    return;
  }
  const Requester requester{frame.system, frame.component};
  switch (frame.message.value) {
    case CommandLong::info.id.value: {
      const auto command = mavlink::decode<CommandLong>(frame);
      if (is_for_us(command.target_system)) on_command(command, requester, airframe, out);
      return;
    }
    case messages::SetMode::info.id.value: {
      const auto wish = mavlink::decode<messages::SetMode>(frame);
      if (!is_for_us(wish.target_system)) return;
      // ArduPilot acknowledges it as if its message id were a command.
      const auto result = set_mode(wish.base_mode, static_cast<float>(wish.custom_mode), airframe, out);
      acknowledge(messages::SetMode::info.id.value, result, requester, out);
      return;
    }
    case messages::RequestDataStream::info.id.value:
      request_stream(mavlink::decode<messages::RequestDataStream>(frame));
      return;
    case messages::Timesync::info.id.value: answer_time(now, mavlink::decode<messages::Timesync>(frame), out); return;
    default: return;
  }
}

void Autopilot::answer_time(Timestamp now, const messages::Timesync& request, Outbox<Frame>& out) {
  if (request.tc1 != 0 || !is_for_us(request.target_system)) return;
  sender_.send(messages::Timesync{.tc1 = (now - boot_).count(), .ts1 = request.ts1}, out);
}

/// ArduPilot hides its system id in the digits below the microsecond.
void Autopilot::ask_time(Timestamp now, Outbox<Frame>& out) {
  const auto whole_microseconds = (now - boot_).count() / 1000 * 1000;
  sender_.send(messages::Timesync{.tc1 = 0, .ts1 = whole_microseconds + config_.system.value}, out);
}

void Autopilot::say(std::uint8_t severity, std::string_view text, Outbox<Frame>& out) {
  if (!speaks_v09()) return sender_.send(messages::Statustext{.severity = severity, .text = text}, out);
  const bool is_critical = severity <= messages::MAV_SEVERITY_CRITICAL;
  sender_.send(mavlink::v09::Statustext{.severity = static_cast<std::uint8_t>(is_critical ? 255 : 0), .text = text},
               out);
}

void Autopilot::tell_facts(Outbox<Frame>& out) {
  facts_.drain([&](const FlightFact& fact) {
    if (const auto* text = std::get_if<Notice>(&fact)) say(text->severity, text->text.view(), out);
    if (const auto* done = std::get_if<ItemReached>(&fact); done != nullptr && !speaks_v09())
      sender_.send(messages::MissionItemReached{.seq = done->item}, out);
  });
}

void Autopilot::send_row(mavlink::MessageId id, Outbox<Frame>& out) {
  if (speaks_v09()) return;
  if (const auto row = find_telemetry_row(id)) rows()[*row].send(snapshot_, sender_, out);
}

bool Autopilot::is_for_us(std::uint8_t target_system) const {
  return target_system == 0 || target_system == config_.system.value;
}

}  // namespace ponte::sim
