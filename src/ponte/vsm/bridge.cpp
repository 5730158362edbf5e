#include "ponte/vsm/bridge.hpp"

#include <algorithm>
#include <utility>

namespace ponte::vsm {

using autopilot::FleetFact;
using autopilot::LinkId;

Bridge::Link::Link(LinkId number, const mavlink::Dialect& dialect, mavlink::LinkPolicy policy)
    : id{number}, parser{dialect}, guard{std::move(policy)} {}

Bridge::Bridge(BridgeConfig config, BridgeListener* listener, mavlink::Signer* signer)
    : dialect_{config.dialect},
      link_policy_{std::move(config.link_policy)},
      fleet_{config.fleet},
      telemetry_{std::move(config.telemetry), config.rates},
      listener_{listener},
      signer_{signer} {
  links_.reserve(autopilot::FleetSession::link_limit);
}

void Bridge::on_link_up(Timestamp now, LinkId link) {
  std::erase_if(links_, [&](const auto& entry) { return entry->id == link; });
  if (links_.size() == autopilot::FleetSession::link_limit) return;
  links_.push_back(std::make_unique<Link>(link, *dialect_, link_policy_));
  fleet_.on_link_up(now, link);
}

void Bridge::on_link_down(Timestamp now, WallTime wall, LinkId link) {
  if (auto* ended = enter(now, wall, link)) ended->parser.finish(*this);
  current_ = nullptr;
  std::erase_if(links_, [&](const auto& entry) { return entry->id == link; });
  fleet_.on_link_down(link, new_facts_);
  tell_facts(wall);
}

Bridge::Link* Bridge::enter(Timestamp now, WallTime wall, LinkId link) {
  const auto found = std::ranges::find_if(links_, [&](const auto& entry) { return entry->id == link; });
  current_ = found == links_.end() ? nullptr : found->get();
  now_ = now;
  wall_ = wall;
  return current_;
}

void Bridge::on_bytes(Timestamp now, WallTime wall, LinkId link, Bytes bytes) {
  if (auto* source = enter(now, wall, link)) source->parser.on_bytes(now, bytes, *this);
}

void Bridge::on_datagram(Timestamp now, WallTime wall, LinkId link, Bytes datagram) {
  if (auto* source = enter(now, wall, link)) source->parser.on_datagram(datagram, *this);
}

void Bridge::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  if (const auto refusal = current_->guard.examine(wall_, frame, signer_)) {
    const auto count = current_->guard.refused()[static_cast<std::size_t>(*refusal)];
    if (listener_ != nullptr) listener_->on_refused(current_->id, *refusal, count);
    return;
  }
  current_->losses.on_frame(frame.system, frame.component, frame.sequence);
  tick_telemetry(now_, wall_);  // what was due before does not come of this frame
  if (listener_ != nullptr) listener_->on_decoded(frame, message);
  if (const auto* ours = message != nullptr ? autopilot::ours(frame, *message) : nullptr) translate(frame, *ours);
  if (listener_ != nullptr) listener_->on_translated(frame, message);
}

void Bridge::on_skipped(Bytes run, mavlink::SkipReason reason) {
  if (listener_ != nullptr) listener_->on_skipped(current_->id, run, reason);
}

void Bridge::translate(const mavlink::FrameView& frame, const mavlink::MessageInfo& message) {
  const bool followed = fleet_.on_frame(now_, current_->id, frame, frames, new_facts_);
  tell_facts(wall_);
  if (!converts_) return;
  if (followed)
    telemetry_.on_frame(now_, wall_, frame, message, messages);
  else if (!fleet_.follows(frame.system))
    telemetry_.on_station_frame(frame, message);
}

void Bridge::tell_facts(WallTime wall) {
  new_facts_.drain([&](const FleetFact& fact) {
    facts.push(fact);
    if (fact.kind == FleetFact::Kind::duplicate_id && converts_)
      telemetry_.raise(
          fact.system,
          {vehicle::Condition::warning, vehicle::Subsystem::comms, Text<79>{"two vehicles use one MAVLink id"}}, wall,
          messages);
  });
}

void Bridge::on_tick(Timestamp now, WallTime wall) {
  for (const auto& link : links_) {
    const auto deadline = link->parser.next_deadline();
    if (!deadline || *deadline > now) continue;
    enter(now, wall, link->id);
    link->parser.on_tick(now, *this);
  }
  fleet_.on_tick(now, frames, new_facts_);
  tell_facts(wall);
  tick_telemetry(now, wall);
}

void Bridge::tick_telemetry(Timestamp now, WallTime wall) {
  if (converts_ && telemetry_.next_deadline() <= now) telemetry_.on_tick(now, wall, messages);
}

Timestamp Bridge::next_deadline() const {
  auto deadline = converts_ ? telemetry_.next_deadline() : Timestamp::max();
  if (const auto fleet = fleet_.next_deadline()) deadline = std::min(deadline, *fleet);
  for (const auto& link : links_)
    if (const auto silence = link->parser.next_deadline()) deadline = std::min(deadline, *silence);
  return deadline;
}

}  // namespace ponte::vsm
