#pragma once

#include "ponte/core/outbox.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_set_attitude.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_set_pitchyaw.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/frame_sender.hpp"
#include "ponte/sim/command.hpp"
#include "ponte/sim/config.hpp"
#include "ponte/sim/failsafe.hpp"
#include "ponte/sim/file_server.hpp"
#include "ponte/sim/flight.hpp"
#include "ponte/sim/flight_fact.hpp"
#include "ponte/sim/message_rates.hpp"
#include "ponte/sim/mission_service.hpp"
#include "ponte/sim/navigation.hpp"
#include "ponte/sim/onboard_memory.hpp"
#include "ponte/sim/parameter_service.hpp"
#include "ponte/sim/setpoint.hpp"
#include "ponte/sim/speaker.hpp"
#include "ponte/sim/telemetry.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace ponte::sim {

/// The autopilot of one aircraft, from power-on to power-off: a new one is made for each start. It speaks MAVLink as
/// ArduPilot or PX4 does, knows its own sensors only, and tells the aircraft what to do.
class Autopilot {
 public:
  /// Starts at this time, which is one of a step. `memory` outlives it.
  Autopilot(const VehicleConfig& config, OnboardMemory& memory, Timestamp boot);

  /// Before the aircraft's step, which leads to `now`: what it has to do.
  void steer(Timestamp now, Airframe& airframe, Outbox<mavlink::FrameBuffer>& out);
  /// After the aircraft's step, at the time of the step: what there is to tell. `step` counts the steps since power-on.
  void report(Timestamp now, std::uint64_t step, const Airframe& airframe, bool hears_satellites,
              Outbox<mavlink::FrameBuffer>& out);

  /// A frame from outside, of a known message and with the right checksum. An autopilot of MAVLink 0.9 understands no
  /// other version, and the others do not understand that one.
  void on_frame(Timestamp now, const mavlink::FrameView& frame, Airframe& airframe, Outbox<mavlink::FrameBuffer>& out);

  /// Metres from where it is to where it believes to be.
  [[nodiscard]] const NorthEastDown& position_error() const { return navigation_.error(); }
  /// It has stopped the motors for good.
  [[nodiscard]] bool is_terminated() const { return failsafes_.is_terminated(); }
  /// It was told to start anew, and has said that it will.
  [[nodiscard]] bool wants_reboot() const { return wants_reboot_; }

 private:
  static constexpr std::size_t most_facts = 32;

  /// One frame from outside: who sent it, and what is answered through.
  struct Call {
    Requester requester;
    Airframe& airframe;
    Speaker speaker;
  };
  /// A command that has been answered with IN_PROGRESS.
  struct Running {
    std::uint16_t command;
    Requester requester;
    Duration done_at;
  };

  void on_message(Timestamp now, const mavlink::FrameView& frame, Call& call);

  // commands.cpp; the results are of MAV_RESULT.
  void on_command(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t execute(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t calibrate(const Command& command, Call& call);
  void on_cancel(std::uint16_t command, Call& call);
  void go_on(Speaker& speaker);
  [[nodiscard]] std::uint8_t reboot(const Command& command, const Call& call);
  static void acknowledge(std::uint16_t command, std::uint8_t result, Requester requester, Speaker& speaker);

  // commands_arming.cpp
  [[nodiscard]] std::uint8_t arm_or_disarm(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t arm(Call& call);
  [[nodiscard]] std::string_view reason_not_to_arm(std::array<char, 50>& buffer) const;

  // commands_flight.cpp
  [[nodiscard]] std::uint8_t take_off(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t do_set_mode(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t set_mode(float base_mode, std::optional<std::uint32_t> custom_mode, Call& call);
  [[nodiscard]] std::uint8_t enter(FlightMode mode, Call& call);
  [[nodiscard]] std::uint8_t reposition(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t orbit(const Command& command, Call& call);
  [[nodiscard]] std::optional<Position> place_or_here(const Command& command) const;
  [[nodiscard]] std::uint8_t turn(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t start_mission(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t pause_or_continue(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t set_mission_item(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t change_speed(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t set_home(const Command& command, Call& call);
  void guide(const std::optional<GuidedTarget>& target, Call& call);

  // commands_messages.cpp
  [[nodiscard]] std::uint8_t set_message_interval(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t tell_message_interval(const Command& command, Call& call) const;
  void send_requested(const Command& command, Call& call);
  [[nodiscard]] std::optional<std::size_t> row_named_by(float parameter) const;
  void send_row(mavlink::MessageId id, Speaker& speaker);

  // commands_gimbal.cpp
  [[nodiscard]] std::uint8_t point_gimbal(const Command& command, Call& call);
  [[nodiscard]] std::uint8_t look_at(const Command& command);
  [[nodiscard]] std::uint8_t not_there() const;
  void on_gimbal_message(const mavlink::autopilots::GimbalManagerSetPitchyaw& wish);
  void on_gimbal_message(const mavlink::autopilots::GimbalManagerSetAttitude& wish);

  // commands_v09.cpp
  void on_frame_v09(const mavlink::FrameView& frame, Call& call);
  [[nodiscard]] std::uint8_t act(std::uint8_t action, Call& call);

  // autopilot_mission.cpp
  void on_set_current(const mavlink::FrameView& frame, Call& call);
  void take_over_plans(Speaker& speaker);
  void keep_home();
  [[nodiscard]] MissionProgress mission_progress() const;

  void request_stream(const auto& request);
  void answer_time(Timestamp now, const mavlink::autopilots::Timesync& request, Speaker& speaker);
  void ask_time(Timestamp now, Speaker& speaker);
  void answer_ping(const mavlink::FrameView& frame, Call& call) const;
  void update(const Airframe& airframe, std::uint64_t step, bool hears_satellites);
  void update_satellites(const AirframeState& truth, std::uint64_t step, bool hears_satellites);
  void take_over_parameters();
  void tell_progress(Speaker& speaker);
  void tell_mode(Speaker& speaker);
  void tell_facts(Speaker& speaker);
  [[nodiscard]] Speaker speaker_to(Outbox<mavlink::FrameBuffer>& out) {
    return {config_.version, sender_, text_numbers_, out};
  }

  [[nodiscard]] bool is_px4() const { return config_.personality == Personality::px4; }
  /// What each of them answers to a wish that is fine, but not now.
  [[nodiscard]] std::uint8_t not_now() const;
  [[nodiscard]] std::span<const TelemetryRow> rows() const {
    return telemetry_rows(config_.personality, config_.version);
  }
  [[nodiscard]] SetpointReference setpoint_reference() const;
  [[nodiscard]] bool is_for_us(std::uint8_t target_system) const;
  [[nodiscard]] bool is_for_us(std::uint8_t target_system, std::uint8_t target_component) const;
  [[nodiscard]] bool has_just_passed(Duration moment) const;
  [[nodiscard]] bool speaks_v09() const { return config_.version == mavlink::Version::v0_9; }

  VehicleConfig config_;
  OnboardMemory& memory_;
  Timestamp boot_;
  Sensors sensors_;
  Navigation navigation_;
  Flight flight_;
  Failsafes failsafes_;
  Outbox<FlightFact> facts_{most_facts};  // of one call of `flight_`
  mavlink::FrameSender sender_;
  TextNumbers text_numbers_;
  MessageRates rates_;
  ParameterService parameters_;
  MissionService missions_;
  Gimbal gimbal_;
  VirtualFiles virtual_files_;
  FileServer files_;
  Snapshot snapshot_;                              // of the last step
  std::optional<std::uint32_t> mission_change_{};  // the number of what the flight has been given
  std::optional<std::uint32_t> fence_change_{};
  std::uint32_t parameter_change_{};
  std::optional<Running> running_;
  std::uint32_t pings_{};
  bool wants_reboot_{};
};

/// REQUEST_DATA_STREAM of any version.
void Autopilot::request_stream(const auto& request) {
  if (!is_for_us(request.target_system)) return;
  const std::uint32_t per_second = request.start_stop == 1 ? request.req_message_rate : 0;
  rates_.request_stream(static_cast<Stream>(request.req_stream_id), per_second, snapshot_.since_boot);
}

}  // namespace ponte::sim
