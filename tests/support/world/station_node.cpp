#include "support/world/station_node.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"

namespace ponte::world {

using autopilot::FleetFact;

StationNode::StationNode(const autopilot::FleetConfig& config) : session_{config}, parser_{autopilot::dialect} {
  session_.on_link_up(Timestamp{}, link);
}

void StationNode::on_piece(Timestamp now, Port port, Bytes piece, Sender& out) {
  PONTE_ASSERT(port == 0);
  now_ = now;
  parser_.on_bytes(now, piece, *this);
  speak(out);
}

void StationNode::on_tick(Timestamp now, Sender& out) {
  now_ = now;
  parser_.on_tick(now, *this);
  session_.on_tick(now, outbox_, fleet_facts_);
  on_fleet_facts();
  if (client_) {
    auto voice = this->voice();
    client_->on_tick(now, voice, vehicle_facts_);
  }
  speak(out);
}

std::optional<Timestamp> StationNode::next_deadline() const {
  if (!outbox_.empty()) return now_;
  auto next = session_.next_deadline();
  const auto consider = [&](std::optional<Timestamp> time) {
    if (time && (!next || *time < *next)) next = time;
  };
  consider(parser_.next_deadline());
  if (client_) consider(client_->next_deadline());
  return next;
}

void StationNode::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  if (message == nullptr) return;
  const bool is_followed = session_.on_frame(now_, link, frame, outbox_, fleet_facts_);
  on_fleet_facts();
  if (!client_) return;
  const auto& peer = client_->peer();
  const bool is_of_vehicle = frame.system == peer.system && frame.component == peer.component;
  if (is_of_vehicle && !is_followed) return;  // another one with the same name
  auto voice = this->voice();
  client_->on_message(now_, frame, voice, vehicle_facts_);
}

void StationNode::on_fleet_facts() {
  fleet_facts_.drain([this](const FleetFact& fact) {
    if (fact.kind == FleetFact::Kind::appeared && !client_) {
      const auto& vehicle = session_.vehicles().front();
      client_ =
          std::make_unique<autopilot::VehicleClient>(autopilot::Peer{vehicle.system, vehicle.component, vehicle.stack});
    }
    if (fact.kind != FleetFact::Kind::rebooted) return;
    ++reboots_;
    client_->on_reboot(now_, vehicle_facts_);
  });
  tell_of_streams();
}

void StationNode::tell_of_streams() {
  if (!client_) return;
  const auto asked = session_.vehicles().front().last_request;
  if (asked != streams_asked_) client_->on_streams_asked(asked);
  streams_asked_ = asked;
}

void StationNode::speak(Sender& out) {
  vehicle_facts_.drain([&](const autopilot::VehicleFact& fact) { facts_.push_back({now_, fact}); });
  outbox_.drain([&](const autopilot::OutgoingFrame& frame) { out.send(0, frame.bytes()); });
}

}  // namespace ponte::world
