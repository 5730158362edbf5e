#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/vehicle.hpp"

#include <array>
#include <string>
#include <vector>

namespace ponte::sim {

namespace messages = mavlink::autopilots;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

/// A vehicle and the station that talks to it, alone in virtual time. Every frame is examined on arrival: whole, known,
/// with the right checksum, version and sender.
class TestStation {
 public:
  explicit TestStation(const VehicleConfig& config) : config_{config}, vehicle_{config} {}

  /// Lets the time go by. What arrives is kept until `forget`.
  void wait(Duration duration) {
    const auto end = now_ + duration;
    while (vehicle_.next_deadline() <= end) {
      now_ = vehicle_.next_deadline();
      vehicle_.on_tick(now_, outbox_);
      take();
    }
    now_ = end;
  }

  /// Waits until `condition` holds, which it examines after each step; false if it never does.
  template <class Condition>
  bool wait_until(Condition&& condition, Duration limit) {
    for (const auto end = now_ + limit; now_ < end; wait(Airframe::step_length))
      if (condition()) return true;
    return condition();
  }

  /// From now on, instead of as system 255, component 190.
  void speak_as(mavlink::SystemId system, mavlink::ComponentId component) {
    system_ = system;
    component_ = component;
  }

  template <mavlink::Message M>
  void send(const M& message, mavlink::Version version = mavlink::Version::v2) {
    std::array<std::byte, mavlink::max_frame_size> buffer{};
    const mavlink::FrameHeader header{version, system_, component_, sequence_++};
    const auto size = mavlink::encode(message, header, buffer);
    PONTE_ASSERT(size);
    const auto frame = mavlink::parse_frame(Bytes{buffer}.first(*size));
    PONTE_ASSERT(frame);
    vehicle_.on_frame(now_, *frame, M::info, outbox_);
    take();
  }

  /// The MAV_RESULT that acknowledges the command; 255: no answer.
  unsigned command(unsigned number, const std::array<float, 7>& p = {}, std::uint8_t target = 1) {
    const auto before = all<messages::CommandAck>().size();
    send(messages::CommandLong{.target_system = target,
                               .target_component = 1,
                               .command = static_cast<std::uint16_t>(number),
                               .param1 = p[0],
                               .param2 = p[1],
                               .param3 = p[2],
                               .param4 = p[3],
                               .param5 = p[4],
                               .param6 = p[5],
                               .param7 = p[6]});
    const auto acks = all<messages::CommandAck>();
    if (acks.size() != before + 1) return 255;
    PONTE_ASSERT(acks.back().command == number);
    return acks.back().result;
  }

  unsigned arm() { return command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {1}); }
  unsigned set_mode(FlightMode mode) {
    return command(messages::MAV_CMD_DO_SET_MODE, {1, static_cast<float>(flight_mode_info({}, mode).custom_mode)});
  }
  unsigned take_off(float height) { return command(messages::MAV_CMD_NAV_TAKEOFF, {0, 0, 0, 0, 0, 0, height}); }
  unsigned set_interval(mavlink::MessageId id, float microseconds) {
    return command(messages::MAV_CMD_SET_MESSAGE_INTERVAL, {static_cast<float>(id.value), microseconds});
  }

  /// All messages of this type that have arrived, oldest first.
  template <mavlink::Message M>
  [[nodiscard]] std::vector<M> all() const {
    std::vector<M> result;
    for (const auto& frame : frames_)
      if (const auto view = mavlink::parse_frame(frame.bytes()); view->message == M::info.id)
        result.push_back(mavlink::decode<M>(*view));
    return result;
  }
  template <mavlink::Message M>
  [[nodiscard]] M last() const {
    const auto received = all<M>();
    PONTE_ASSERT(!received.empty());
    return received.back();
  }
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> result;
    for (const auto& each : all<messages::Statustext>()) result.emplace_back(each.text.view());
    return result;
  }

  void forget() { frames_.clear(); }
  [[nodiscard]] const std::vector<mavlink::FrameBuffer>& frames() const { return frames_; }
  [[nodiscard]] const Vehicle& vehicle() const { return vehicle_; }
  [[nodiscard]] const AirframeState& truth() const { return vehicle_.truth(); }
  /// From the place where the vehicle was switched on.
  [[nodiscard]] NorthEastDown place() const { return offset_between(config_.start, truth().position); }
  [[nodiscard]] Timestamp now() const { return now_; }
  [[nodiscard]] std::uint64_t lost() const { return outbox_.overwritten(); }

 private:
  void take() {
    outbox_.drain([this](const mavlink::FrameBuffer& frame) {
      const auto view = mavlink::parse_frame(frame.bytes());
      PONTE_ASSERT(view && view->whole.size() == frame.size);
      const auto* info = messages::dialect.find(view->message);
      PONTE_ASSERT(info != nullptr && mavlink::checksum_matches(*view, info->crc_extra));
      PONTE_ASSERT(view->version == config_.version && view->system == config_.system);
      frames_.push_back(frame);
    });
  }

  VehicleConfig config_;
  Vehicle vehicle_;
  Outbox<mavlink::FrameBuffer> outbox_{Vehicle::frames_per_step};
  std::vector<mavlink::FrameBuffer> frames_;
  Timestamp now_{};
  mavlink::SystemId system_{255};
  mavlink::ComponentId component_{190};
  std::uint8_t sequence_{};
};

}  // namespace ponte::sim
