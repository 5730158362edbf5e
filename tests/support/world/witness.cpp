#include "support/world/witness.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/codec.hpp"

namespace ponte::world {

namespace messages = mavlink::autopilots;

Witness::Witness(const VehicleNode& vehicle) : vehicle_{vehicle}, parser_{autopilot::dialect}, looks_(1) {}

void Witness::on_piece(Timestamp now, Port /*port*/, Bytes piece, Sender& /*out*/) {
  parser_.on_bytes(now, piece, *this);
  look(now);
}

void Witness::on_tick(Timestamp /*now*/, Sender& /*out*/) {}

void Witness::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* /*message*/) {
  if (mavlink::carries<messages::Heartbeat>(frame))
    custom_mode_ = mavlink::decode<messages::Heartbeat>(frame).custom_mode;
}

void Witness::look(Timestamp now) {
  const auto& truth = vehicle_.vehicle().truth();
  Look seen{looks_.back().time, truth.armed, truth.airborne, custom_mode_};
  if (seen == looks_.back()) return;
  seen.time = now;
  looks_.push_back(seen);
}

int Witness::times_armed() const {
  int count = 0;
  for (std::size_t i = 1; i < looks_.size(); ++i) count += looks_[i].armed && !looks_[i - 1].armed ? 1 : 0;
  return count;
}

template <class Condition>
bool Witness::was(const Condition& condition, Timestamp from, Timestamp to) const {
  for (std::size_t i = 0; i < looks_.size() && looks_[i].time <= to; ++i) {
    const auto until = i + 1 < looks_.size() ? looks_[i + 1].time : Timestamp::max();
    if (until >= from && condition(looks_[i])) return true;
  }
  return false;
}

bool Witness::was_armed(bool armed, Timestamp from, Timestamp to) const {
  return was([&](const Look& look) { return look.armed == armed; }, from, to);
}

bool Witness::was_airborne(Timestamp from, Timestamp to) const {
  return was([](const Look& look) { return look.airborne; }, from, to);
}

bool Witness::was_in_mode(std::uint32_t custom_mode, Timestamp from, Timestamp to) const {
  return was([&](const Look& look) { return look.custom_mode == custom_mode; }, from, to);
}

void load_mission(sim::Vehicle& vehicle, Timestamp now, const std::vector<MissionItem>& items) {
  Outbox<mavlink::FrameBuffer> unheard{sim::Vehicle::frames_per_step};
  mavlink::FrameSender cable{mavlink::Version::v2, mavlink::SystemId{249}, mavlink::ComponentId{190}};
  const auto say = [&](const auto& message) {
    const auto frame = cable.frame(message);
    const auto view = mavlink::parse_frame(frame->bytes());
    PONTE_ASSERT(view.has_value());
    vehicle.on_frame(now, *view, std::remove_cvref_t<decltype(message)>::info, unheard);
  };
  say(messages::MissionCount{
      .target_system = 1, .target_component = 1, .count = static_cast<std::uint16_t>(items.size())});
  for (const auto& item : items) say(item);
}

}  // namespace ponte::world
