#include "sim/live_vehicle.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/codec.hpp"

namespace ponte::app {

/// Hands what a parser finds to the vehicle.
class LiveVehicle::Receiver final : public mavlink::FrameSink {
 public:
  Receiver(sim::Vehicle& vehicle, Timestamp now, Outbox<sim::Frame>& out) : vehicle_{vehicle}, now_{now}, out_{out} {}

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
    if (message != nullptr) vehicle_.on_frame(now_, frame, *message, out_);
  }

 private:
  sim::Vehicle& vehicle_;
  Timestamp now_;
  Outbox<sim::Frame>& out_;
};

LiveVehicle::LiveVehicle(transport::Loop& loop, const sim::VehicleConfig& config, double speedup)
    : loop_{loop},
      vehicle_{config},
      speedup_{speedup},
      power_on_{loop.now()},
      timer_{loop,
             [this](Timestamp now) {
               vehicle_.on_tick(simulated(now), out_);
               send();
             }},
      arm_timer_{loop, [this, target = config.system](Timestamp now) { arm(now, target); }} {
  timer_.set(power_on_);
}

void LiveVehicle::arm_after(Duration wait) { arm_timer_.set(power_on_ + wait); }

void LiveVehicle::arm(Timestamp now, mavlink::SystemId target) {
  namespace messages = mavlink::autopilots;
  constexpr mavlink::FrameHeader pilot{
      .version = mavlink::Version::v2, .system = mavlink::SystemId{255}, .component = mavlink::ComponentId{190}};
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const auto size = mavlink::encode(messages::CommandLong{.target_system = target.value,
                                                          .target_component = 1,
                                                          .command = messages::MAV_CMD_COMPONENT_ARM_DISARM,
                                                          .param1 = 1},
                                    pilot, buffer);
  PONTE_ASSERT(size.has_value());
  Receiver receiver{vehicle_, simulated(now), out_};
  mavlink::Parser parser{autopilot::dialect};
  parser.on_datagram(Bytes{buffer}.first(*size), receiver);
  send();
}

Timestamp LiveVehicle::simulated(Timestamp now) const {
  return Timestamp{std::chrono::duration_cast<Duration>((now - power_on_) * speedup_)};
}

mavlink::Parser& LiveVehicle::parser_of(transport::PeerId peer) {
  auto& parser = parsers_[peer];
  if (!parser) parser = std::make_unique<mavlink::Parser>(autopilot::dialect);
  return *parser;
}

void LiveVehicle::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) {
  Receiver receiver{vehicle_, simulated(now), out_};
  parser_of(peer).on_bytes(now, bytes, receiver);
  send();
}

void LiveVehicle::on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) {
  Receiver receiver{vehicle_, simulated(now), out_};
  parser_of(peer).on_datagram(bytes, receiver);
  send();
}

void LiveVehicle::on_state(Timestamp, transport::LinkState state, std::string_view) {
  if (state == transport::LinkState::down) parsers_.clear();
}

void LiveVehicle::on_peer(Timestamp, transport::PeerId peer, transport::PeerChange change, std::string_view) {
  if (change == transport::PeerChange::left) parsers_.erase(peer);
}

void LiveVehicle::send() {
  out_.drain([&](const sim::Frame& frame) {
    if (link_) link_->send(frame.bytes());
  });
  const auto ahead = vehicle_.next_deadline() - simulated(loop_.now());
  timer_.set(loop_.now() + std::chrono::duration_cast<Duration>(ahead / speedup_));
}

}  // namespace ponte::app
