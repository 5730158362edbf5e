#include "sim/live_vehicle.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/setup_signing.hpp"
#include "ponte/mavlink/v09/action.hpp"
#include "ponte/mavlink/v09/enums.hpp"

namespace ponte::app {
namespace {

constexpr std::uint8_t link_id = 0;  ///< in signatures; a vehicle has one link

}  // namespace

/// Hands what a parser finds to the vehicle, as far as the link's guard, if there is one, permits.
class LiveVehicle::Receiver final : public mavlink::FrameSink {
 public:
  Receiver(LiveVehicle& owner, Timestamp now, mavlink::LinkGuard* guard)
      : owner_{owner}, now_{owner.simulated(now)}, guard_{guard} {}

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
    if (message == nullptr) return;
    if (frame.message == mavlink::setup_signing_id) {
      if (owner_.security_.is_local) owner_.set_up_signing(frame);
      return;
    }
    if (guard_ != nullptr) {
      const auto refusal = guard_->examine(transport::Loop::wall(), frame, owner_.security_.signer);
      if (refusal) {
        ++owner_.refused_[static_cast<std::size_t>(*refusal)];
        return;
      }
    }
    owner_.catch_up(now_);
    owner_.vehicle_.on_frame(now_, frame, *message, owner_.out_);
    owner_.flush();
  }

 private:
  LiveVehicle& owner_;
  Timestamp now_;
  mavlink::LinkGuard* guard_;
};

LiveVehicle::LiveVehicle(transport::Loop& loop, const sim::VehicleConfig& config, double speedup,
                         const VehicleSecurity& security)
    : loop_{loop},
      system_{config.system},
      version_{config.version},
      vehicle_{config},
      speedup_{speedup},
      power_on_{loop.now()},
      security_{security},
      timer_{loop,
             [this](Timestamp now) {
               catch_up(simulated(now));
               send();
             }},
      arm_timer_{loop, [this](Timestamp now) { arm(now); }} {
  timer_.set(power_on_);
}

/// Step by step, however many are due, so that the outbox never holds more than what one of them says.
void LiveVehicle::catch_up(Timestamp simulated_now) {
  while (vehicle_.next_deadline() <= simulated_now) {
    vehicle_.on_tick(vehicle_.next_deadline(), out_);
    flush();
  }
}

void LiveVehicle::arm_after(Duration wait) { arm_timer_.set(power_on_ + wait); }

void LiveVehicle::arm(Timestamp now) {
  namespace messages = mavlink::autopilots;
  const mavlink::FrameHeader pilot{
      .version = version_, .system = mavlink::SystemId{255}, .component = mavlink::ComponentId{190}};
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const messages::CommandLong command{.target_system = system_.value,
                                      .target_component = 1,
                                      .command = messages::MAV_CMD_COMPONENT_ARM_DISARM,
                                      .param1 = 1};
  const mavlink::v09::Action action{
      .target = system_.value, .target_component = 1, .action = mavlink::v09::MAV_ACTION_MOTORS_START};
  const auto size = version_ == mavlink::Version::v0_9 ? mavlink::encode(action, pilot, buffer)
                                                       : mavlink::encode(command, pilot, buffer);
  PONTE_ASSERT(size.has_value());
  Receiver receiver{*this, now, nullptr};
  mavlink::Parser parser{autopilot::dialect};
  parser.on_datagram(Bytes{buffer}.first(*size), receiver);
  send();
}

Result<sim::Fault, std::string> LiveVehicle::inject(std::string_view fault) {
  const auto parsed = sim::parse_fault(fault, simulated(loop_.now()) - Timestamp{});
  if (parsed) vehicle_.inject(*parsed);
  return parsed;
}

Timestamp LiveVehicle::simulated(Timestamp now) const {
  return Timestamp{std::chrono::duration_cast<Duration>((now - power_on_) * speedup_)};
}

LiveVehicle::Peer::Peer(const mavlink::LinkPolicy& policy) : parser{autopilot::dialect}, guard{policy} {}

LiveVehicle::Peer& LiveVehicle::find(transport::PeerId id) {
  auto& peer = peers_[id];
  if (!peer) peer = std::make_unique<Peer>(security_.policy);
  return *peer;
}

/// Signatures are demanded from now on, or no longer. The time, too, is that of the message, or later.
void LiveVehicle::set_up_signing(const mavlink::FrameView& frame) {
  const auto setup = mavlink::read_setup_signing(frame);
  if (!setup || setup->system != system_) return;
  set_up_.reset();
  security_.signer = setup->key ? &set_up_.emplace(*setup->key, setup->time) : nullptr;
  security_.policy.unsigned_frames = mavlink::UnsignedPolicy::listed;
  for (auto& [id, peer] : peers_) peer->guard = mavlink::LinkGuard{security_.policy};
}

void LiveVehicle::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) {
  auto& source = find(peer);
  Receiver receiver{*this, now, &source.guard};
  source.parser.on_bytes(now, bytes, receiver);
  send();
}

void LiveVehicle::on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) {
  auto& source = find(peer);
  Receiver receiver{*this, now, &source.guard};
  source.parser.on_datagram(bytes, receiver);
  send();
}

void LiveVehicle::on_state(Timestamp, transport::LinkState state, std::string_view) {
  if (state == transport::LinkState::down) peers_.clear();
}

void LiveVehicle::on_peer(Timestamp, transport::PeerId peer, transport::PeerChange change, std::string_view) {
  if (change == transport::PeerChange::left) peers_.erase(peer);
}

void LiveVehicle::flush() {
  out_.drain([&](mavlink::FrameBuffer frame) {
    if (security_.signer != nullptr && frame.buffer[0] == mavlink::start_v2)
      frame.size = security_.signer->sign(transport::Loop::wall(), link_id, frame.buffer, frame.size);
    if (link_) link_->send(frame.bytes());
  });
}

void LiveVehicle::send() {
  flush();
  const auto ahead = vehicle_.next_deadline() - simulated(loop_.now());
  timer_.set(loop_.now() + std::chrono::duration_cast<Duration>(ahead / speedup_));
}

}  // namespace ponte::app
