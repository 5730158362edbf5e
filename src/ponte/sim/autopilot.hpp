#pragma once

#include "ponte/core/outbox.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/sim/config.hpp"
#include "ponte/sim/flight.hpp"
#include "ponte/sim/flight_fact.hpp"
#include "ponte/sim/frame_sender.hpp"
#include "ponte/sim/message_rates.hpp"
#include "ponte/sim/telemetry.hpp"

#include <cstdint>
#include <string_view>

namespace ponte::sim {

/// The autopilot of one copter, from power-on to power-off: a new one is made for each start. It speaks MAVLink as
/// ArduCopter does, knows its own sensors only, and tells the copter what to do.
class Autopilot {
 public:
  /// Starts at this time, which is one of a step.
  Autopilot(const VehicleConfig& config, Timestamp boot);

  /// Before the aircraft's step, which leads to `now`: what it has to do.
  void steer(Timestamp now, Airframe& airframe, Outbox<Frame>& out);
  /// After the aircraft's step, at the time of the step: what there is to tell. `step` counts the steps since power-on.
  void report(Timestamp now, std::uint64_t step, const Airframe& airframe, Outbox<Frame>& out);

  /// A frame from outside, of a known message and with the right checksum. An autopilot of MAVLink 0.9 understands no
  /// other version, and the others do not understand that one.
  void on_frame(Timestamp now, const mavlink::FrameView& frame, Airframe& airframe, Outbox<Frame>& out);

  /// It was told to start anew, and has said that it will.
  [[nodiscard]] bool wants_reboot() const { return wants_reboot_; }

 private:
  static constexpr std::size_t most_facts = 32;
  using CommandLong = mavlink::autopilots::CommandLong;
  struct Requester {
    mavlink::SystemId system;
    mavlink::ComponentId component;
  };

  // commands.cpp; the results are of MAV_RESULT.
  void on_command(const CommandLong& command, Requester requester, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t execute(const CommandLong& command, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t arm_or_disarm(const CommandLong& command, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t take_off(const CommandLong& command, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t set_mode(float base_mode, float custom_mode, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t enter(FlightMode mode, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t set_message_interval(const CommandLong& command, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t reboot(const CommandLong& command, const Airframe& airframe);
  void acknowledge(std::uint16_t command, std::uint8_t result, Requester requester, Outbox<Frame>& out);

  // commands_v09.cpp
  void on_frame_v09(const mavlink::FrameView& frame, Airframe& airframe, Outbox<Frame>& out);
  [[nodiscard]] std::uint8_t act(std::uint8_t action, Airframe& airframe, Outbox<Frame>& out);

  void request_stream(const auto& request);
  void answer_time(Timestamp now, const mavlink::autopilots::Timesync& request, Outbox<Frame>& out);
  void ask_time(Timestamp now, Outbox<Frame>& out);
  void update(const Airframe& airframe, std::uint64_t step);
  void tell_progress(Outbox<Frame>& out);
  void say(std::uint8_t severity, std::string_view text, Outbox<Frame>& out);
  void tell_facts(Outbox<Frame>& out);
  void send_row(mavlink::MessageId id, Outbox<Frame>& out);

  [[nodiscard]] std::span<const TelemetryRow> rows() const { return telemetry_rows(config_.version); }
  [[nodiscard]] bool is_for_us(std::uint8_t target_system) const;
  [[nodiscard]] bool has_just_passed(Duration moment) const;
  [[nodiscard]] bool speaks_v09() const { return config_.version == mavlink::Version::v0_9; }

  VehicleConfig config_;
  Timestamp boot_;
  Sensors sensors_;
  Flight flight_;
  Outbox<FlightFact> facts_{most_facts};  // of one call of `flight_`
  FrameSender sender_;
  MessageRates rates_;
  Snapshot snapshot_;  // of the last step
  bool wants_reboot_{};
};

/// REQUEST_DATA_STREAM of any version.
void Autopilot::request_stream(const auto& request) {
  if (!is_for_us(request.target_system)) return;
  const std::uint32_t per_second = request.start_stop == 1 ? request.req_message_rate : 0;
  rates_.request_stream(static_cast<Stream>(request.req_stream_id), per_second, snapshot_.since_boot);
}

}  // namespace ponte::sim
