#include "ponte/sim/autopilot.hpp"

#include "ponte/mavlink/autopilots/command_cancel.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/gps_global_origin.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"
#include "ponte/mavlink/autopilots/mission_set_current.hpp"
#include "ponte/mavlink/autopilots/param_request_list.hpp"
#include "ponte/mavlink/autopilots/ping.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/set_mode.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/settings.hpp"

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr Duration satellite_interval = std::chrono::milliseconds{200};
constexpr Duration receiver_found_after = std::chrono::seconds{2};
constexpr Duration flat_fix_lasts = std::chrono::seconds{1};
constexpr Duration time_question_interval = std::chrono::seconds{10};

SatelliteFix fix_at(Duration since_boot, const VehicleConfig& config, bool hears_satellites) {
  if (!hears_satellites) return config.personality == Personality::px4 ? SatelliteFix::no_receiver : SatelliteFix::none;
  const auto fix_after = start_times(config.personality).fix;
  if (since_boot >= fix_after) return SatelliteFix::full;
  if (since_boot >= fix_after - flat_fix_lasts) return SatelliteFix::flat;
  return since_boot >= receiver_found_after ? SatelliteFix::none : SatelliteFix::no_receiver;
}

/// Each autopilot has a gimbal if a parameter says so, from the start.
bool has_gimbal(Personality personality, const Parameters& parameters) {
  if (personality == Personality::px4) return parameters.value("MNT_MODE_IN") >= 0;
  return parameters.value("MNT1_TYPE") > 0;
}

}  // namespace

Autopilot::Autopilot(const VehicleConfig& config, OnboardMemory& memory, Timestamp boot)
    : config_{config},
      memory_{memory},
      boot_{boot},
      sensors_{config.seed, config.noise},
      navigation_{config.personality, start_times(config.personality).position, config.seed},
      flight_{{config.personality, config.type},
              settings_of({config.personality, config.type}, memory.parameters).flight,
              config.fly_square,
              config.square},
      failsafes_{{config.personality, config.type},
                 settings_of({config.personality, config.type}, memory.parameters).failsafes},
      sender_{config.version, config.system, config.component},
      text_numbers_{config.personality},
      rates_{telemetry_rows(config.personality, config.version)},
      parameters_{config.personality, memory.parameters, config.line_rate},
      missions_{config.personality, memory.missions},
      gimbal_{has_gimbal(config.personality, memory.parameters)},
      virtual_files_{memory.missions, memory.parameters},
      files_{virtual_files_} {
  snapshot_.system = config.system;
  snapshot_.mode = flight_.mode();
}

void Autopilot::steer(Timestamp now, Airframe& airframe, Outbox<mavlink::FrameBuffer>& out) {
  auto speaker = speaker_to(out);
  failsafes_.step(now - boot_, navigation_.has_position() || !navigation_.ever_had_position(), flight_, airframe,
                  facts_);
  flight_.step(now - boot_, airframe, facts_);
  tell_facts(speaker);
}

void Autopilot::report(Timestamp now, std::uint64_t step, const Airframe& airframe, bool hears_satellites,
                       Outbox<mavlink::FrameBuffer>& out) {
  auto speaker = speaker_to(out);
  snapshot_.since_boot = now - boot_;
  navigation_.step(snapshot_.since_boot, hears_satellites);
  tell_mode(speaker);
  update(airframe, step, hears_satellites);
  tell_progress(speaker);
  if (!speaks_v09()) {
    take_over_plans(speaker);
    if (snapshot_.since_boot > Duration{} && snapshot_.since_boot % time_question_interval == Duration{})
      ask_time(now, speaker);
    go_on(speaker);
    parameters_.on_step(snapshot_.since_boot, speaker);
    missions_.on_step(now, speaker);
    files_.on_step(now, speaker);
  }
  for (std::size_t i = 0; i < rows().size(); ++i)
    if (rates_.take_due(i, snapshot_.since_boot)) rows()[i].send(snapshot_, sender_, out);
}

/// What it knows from now on.
void Autopilot::update(const Airframe& airframe, std::uint64_t step, bool hears_satellites) {
  const auto& truth = airframe.state();
  auto& known = snapshot_;
  known.is_ready = known.since_boot >= start_times(config_.personality).ready;
  known.armed = truth.armed;
  known.kind = flight_.kind();
  known.mode = flight_.mode();
  known.landed_state = flight_.landed_state(truth);
  known.readings = sensors_.read(truth, step);
  known.readings.position = displaced(known.readings.position, navigation_.error());
  known.target = flight_.target(airframe);
  known.throttle = truth.throttle;
  known.battery = truth.battery;
  known.charge = failsafes_.charge_state();
  known.is_in_trouble = failsafes_.is_active();
  known.wind = truth.wind;
  known.mission = mission_progress();
  gimbal_.step(known.readings.position, known.readings.attitude, flight_.mission().region_of_interest());
  known.gimbal = gimbal_.state();

  if (known.since_boot % satellite_interval == Duration{}) update_satellites(truth, step, hears_satellites);
  known.utc.reset();
  if (known.satellites.fix == SatelliteFix::full)
    known.utc = config_.power_on +
                std::chrono::duration_cast<std::chrono::microseconds>((boot_ - Timestamp{}) + known.since_boot);

  known.found_position = !known.has_position && navigation_.ever_had_position();
  known.has_position = navigation_.ever_had_position();
  known.trusts_position = navigation_.has_position();
  flight_.set_has_position(navigation_.has_position());
  if (known.found_position) {
    known.origin = truth.position;
    known.origin.altitude_msl = config_.start.altitude_msl;  // also of one that has started anew in the air
    flight_.set_home(known.origin);
    keep_home();
  }
  known.home = flight_.home();
}

/// Without satellites it shows where it last saw them.
void Autopilot::update_satellites(const AirframeState& truth, std::uint64_t step, bool hears_satellites) {
  auto& known = snapshot_.satellites;
  known.fix = fix_at(snapshot_.since_boot, config_, hears_satellites);
  known.at = snapshot_.since_boot;
  if (known.fix >= SatelliteFix::flat) known.reading = sensors_.read_satellites(truth, step);
}

void Autopilot::take_over_parameters() {
  const auto& parameters = memory_.parameters;
  if (parameter_change_ == parameters.changes()) return;
  parameter_change_ = parameters.changes();
  const auto settings = settings_of(flight_.kind(), parameters);
  flight_.set_settings(settings.flight);
  failsafes_.set_settings(settings.failsafes);
}

void Autopilot::tell_progress(Speaker& speaker) {
  const auto ready_after = start_times(config_.personality).ready;
  if (has_just_passed(ready_after) && !is_px4()) speaker.say(messages::MAV_SEVERITY_INFO, "ArduPilot Ready");
  if (!snapshot_.found_position) return;
  send_row(messages::GpsGlobalOrigin::info.id, speaker);
  send_row(messages::HomePosition::info.id, speaker);
  if (is_px4()) return speaker.say(messages::MAV_SEVERITY_INFO, "Ready for takeoff!\t");
  speaker.say(messages::MAV_SEVERITY_INFO, "EKF3 IMU0 origin set");
  speaker.say(messages::MAV_SEVERITY_INFO, "EKF3 IMU0 is using GPS");
}

bool Autopilot::has_just_passed(Duration moment) const {
  return snapshot_.since_boot >= moment && snapshot_.since_boot - Airframe::step_length < moment;
}

void Autopilot::on_frame(Timestamp now, const mavlink::FrameView& frame, Airframe& airframe,
                         Outbox<mavlink::FrameBuffer>& out) {
  if (frame.system == config_.system && frame.component == config_.component) return;  // our own, come back
  Call call{{frame.system, frame.component}, airframe, speaker_to(out)};
  if (speaks_v09() || frame.version == mavlink::Version::v0_9) {
    if (speaks_v09()) on_frame_v09(frame, call);
    return;
  }
  on_message(now, frame, call);
  take_over_parameters();
  tell_mode(call.speaker);
  take_over_plans(call.speaker);
}

void Autopilot::on_message(Timestamp now, const mavlink::FrameView& frame, Call& call) {
  missions_.set_use(
      {.current = snapshot_.mission.current, .runs = snapshot_.armed && flight_.mode() == FlightMode::automatic});
  if (missions_.on_frame(now, frame, config_.system, call.speaker)) return;
  /// Decodes the message, and hands it on if it is for us.
  const auto handle = [&](auto message, auto&& act) {
    message = mavlink::decode<decltype(message)>(frame);
    if (is_for_us(message.target_system)) act(message);
  };
  const auto on_any_command = [&](const auto& m) {
    if (is_for_us(m.target_system, m.target_component)) on_command(to_command(m), call);
  };
  const auto on_setpoint = [&](const auto& m) { guide(guided_target(m, setpoint_reference()), call); };

  switch (frame.message.value) {
    case messages::CommandLong::info.id.value: return handle(messages::CommandLong{}, on_any_command);
    case messages::CommandInt::info.id.value: return handle(messages::CommandInt{}, on_any_command);
    case messages::CommandCancel::info.id.value:
      return handle(messages::CommandCancel{}, [&](const auto& m) { on_cancel(m.command, call); });
    case messages::SetMode::info.id.value:
      return handle(messages::SetMode{}, [&](const auto& wish) {
        // ArduPilot acknowledges it as if its message id were a command; PX4, as the command that it stands for.
        const auto told = is_px4() ? std::uint32_t{messages::MAV_CMD_DO_SET_MODE} : messages::SetMode::info.id.value;
        const auto result = set_mode(wish.base_mode, wish.custom_mode, call);
        acknowledge(static_cast<std::uint16_t>(told), result, call.requester, call.speaker);
      });
    case messages::ParamRequestList::info.id.value:
      return handle(messages::ParamRequestList{}, [&](const auto&) { parameters_.on_request_list(); });
    case messages::ParamRequestRead::info.id.value:
      return handle(messages::ParamRequestRead{},
                    [&](const auto& m) { parameters_.on_request_read(m, call.requester, call.speaker); });
    case messages::ParamSet::info.id.value:
      return handle(messages::ParamSet{}, [&](const auto& m) { parameters_.on_set(m, call.requester, call.speaker); });
    case messages::FileTransferProtocol::info.id.value:
      return handle(messages::FileTransferProtocol{}, [&](const auto& m) {
        if (!is_px4()) files_.on_message(now, m, call.requester, call.speaker);
      });
    case messages::GimbalManagerSetPitchyaw::info.id.value:
      return handle(messages::GimbalManagerSetPitchyaw{}, [&](const auto& m) { on_gimbal_message(m); });
    case messages::GimbalManagerSetAttitude::info.id.value:
      return handle(messages::GimbalManagerSetAttitude{}, [&](const auto& m) { on_gimbal_message(m); });
    case messages::SetPositionTargetGlobalInt::info.id.value:
      return handle(messages::SetPositionTargetGlobalInt{}, on_setpoint);
    case messages::SetPositionTargetLocalNed::info.id.value:
      return handle(messages::SetPositionTargetLocalNed{}, on_setpoint);
    case messages::Heartbeat::info.id.value:
      if (mavlink::decode<messages::Heartbeat>(frame).type == messages::MAV_TYPE_GCS)
        failsafes_.on_station_heartbeat(now - boot_);
      return;
    case messages::MissionSetCurrent::info.id.value: return on_set_current(frame, call);
    case messages::RequestDataStream::info.id.value:
      return request_stream(mavlink::decode<messages::RequestDataStream>(frame));
    case messages::Timesync::info.id.value:
      return answer_time(now, mavlink::decode<messages::Timesync>(frame), call.speaker);
    case messages::Ping::info.id.value: return answer_ping(frame, call);
    default: return;
  }
}

void Autopilot::answer_time(Timestamp now, const messages::Timesync& request, Speaker& speaker) {
  if (request.tc1 != 0 || !is_for_us(request.target_system)) return;
  speaker.send(messages::Timesync{.tc1 = (now - boot_).count(), .ts1 = request.ts1});
}

/// ArduPilot asks by TIMESYNC, and hides its system id in the digits below the microsecond; PX4 by PING.
void Autopilot::ask_time(Timestamp now, Speaker& speaker) {
  if (is_px4()) {
    const auto us = static_cast<std::uint64_t>((now - boot_) / std::chrono::microseconds{1});
    return speaker.send(messages::Ping{.time_usec = us, .seq = pings_++});
  }
  const auto whole_microseconds = (now - boot_).count() / 1000 * 1000;
  speaker.send(messages::Timesync{.tc1 = 0, .ts1 = whole_microseconds + config_.system.value});
}

/// PX4 answers what is asked of nobody in particular; ArduPilot does not.
void Autopilot::answer_ping(const mavlink::FrameView& frame, Call& call) const {
  auto ping = mavlink::decode<messages::Ping>(frame);
  if (!is_px4() || ping.target_system != 0 || ping.target_component != 0) return;
  ping.target_system = call.requester.system.value;
  ping.target_component = call.requester.component.value;
  call.speaker.send(ping);
}

/// ArduPilot does not wait for the next HEARTBEAT to tell another mode.
void Autopilot::tell_mode(Speaker& speaker) {
  if (snapshot_.mode == flight_.mode()) return;
  snapshot_.mode = flight_.mode();
  if (!is_px4() && !speaks_v09()) send_row(messages::Heartbeat::info.id, speaker);
}

void Autopilot::tell_facts(Speaker& speaker) {
  facts_.drain([&](const FlightFact& fact) {
    if (const auto* text = std::get_if<Notice>(&fact)) speaker.say(text->severity, text->text.view());
    if (const auto* done = std::get_if<ItemReached>(&fact); done != nullptr && !speaks_v09()) {
      snapshot_.reached = {done->item, snapshot_.since_boot};
      send_row(messages::MissionItemReached::info.id, speaker);
    }
  });
}

std::uint8_t Autopilot::not_now() const {
  return is_px4() ? messages::MAV_RESULT_TEMPORARILY_REJECTED : messages::MAV_RESULT_FAILED;
}

SetpointReference Autopilot::setpoint_reference() const {
  return {.origin = snapshot_.origin,
          .home = flight_.home(),
          .position = snapshot_.readings.position,
          .heading = snapshot_.readings.attitude.heading};
}

bool Autopilot::is_for_us(std::uint8_t target_system) const {
  return target_system == 0 || target_system == config_.system.value;
}

/// ArduPilot does not look at the component.
bool Autopilot::is_for_us(std::uint8_t target_system, std::uint8_t target_component) const {
  const bool is_component = !is_px4() || target_component == 0 || target_component == config_.component.value;
  return is_for_us(target_system) && is_component;
}

}  // namespace ponte::sim
