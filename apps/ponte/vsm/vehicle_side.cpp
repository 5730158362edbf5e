#include "vsm/vehicle_side.hpp"

#include "common/capture.hpp"
#include "common/failure.hpp"
#include "common/mavlink_options.hpp"
#include "vsm/link_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace ponte::app {
namespace {

const vsm::Bridge::Link* find(const vsm::Bridge& bridge, autopilot::LinkId number) {
  const auto found = std::ranges::find_if(bridge.links(), [&](const auto& link) { return link->id == number; });
  return found == bridge.links().end() ? nullptr : found->get();
}

}  // namespace

VehicleSide::VehicleSide(LiveVsm& owner, vsm::VehicleLinkId id, const transport::Endpoint& endpoint)
    : owner_{owner}, id_{id}, endpoint_{endpoint}, name_{transport::to_text(endpoint)} {
  auto opened = transport::open_link(owner.loop_, endpoint, *this);
  if (!opened) throw Failure{transport::to_text(opened.error())};
  link_ = std::move(*opened);
}

void VehicleSide::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) {
  const auto wall = transport::Loop::wall();
  owner_.begin(id_, name_, wall, now);
  owner_.bridge_.on_bytes(now, wall, number_of(now, peer), bytes);
  owner_.pump();
}

void VehicleSide::on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) {
  const auto wall = transport::Loop::wall();
  owner_.begin(id_, name_, wall, now);
  owner_.bridge_.on_datagram(now, wall, number_of(now, peer), bytes);
  owner_.pump();
}

void VehicleSide::on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) {
  const auto was_up = status().is_up;
  if (change == transport::PeerChange::joined) {
    owner_.log_->info("{} joined {}", name, name_);
    (void)number_of(now, peer);
  } else if (const auto found = numbers_.find(peer); found != numbers_.end()) {
    owner_.log_->info("{} left {}", name, name_);
    end(now, found->second);
    owner_.pump();  // while it is known where the link was
    numbers_.erase(found);
  }
  owner_.pump();
  tell_change(was_up);
}

void VehicleSide::end(Timestamp now, autopilot::LinkId link) {
  const auto wall = transport::Loop::wall();
  owner_.begin(id_, name_, wall, now);
  if (const auto* ended = find(owner_.bridge_, link)) ended_.add(*ended);
  owner_.bridge_.on_link_down(now, wall, link);
}

void VehicleSide::end_all(Timestamp now) {
  for (const auto& [peer, number] : numbers_) end(now, number);
}

vsm::view::VehicleLink VehicleSide::status() const {
  const bool is_up = link_->state() == transport::LinkState::up && !numbers_.empty();
  return {.id = id_, .endpoint = name_, .is_up = is_up, .detail = is_up ? std::string{} : detail_};
}

void VehicleSide::tell_change(bool was_up) {
  const auto now_is = status();
  if (now_is.is_up != was_up) owner_.tell(&VsmWatcher::on_link, now_is);
}

void VehicleSide::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  log_state(*owner_.log_, endpoint_, state, reason);
  detail_ = state == transport::LinkState::down ? reason : std::string_view{};
}

bool VehicleSide::send(const autopilot::OutgoingFrame& frame) {
  for (const auto& [peer, number] : numbers_) {
    if (number != frame.link) continue;
    link_->send_to(peer, frame.bytes());
    return true;
  }
  return false;
}

bool VehicleSide::has(autopilot::LinkId link) const {
  return std::ranges::any_of(numbers_, [&](const auto& entry) { return entry.second == link; });
}

std::string VehicleSide::name_of(autopilot::LinkId link) const {
  for (const auto& [peer, number] : numbers_)
    if (number == link) return link_->peer_name(peer);
  return {};
}

void VehicleSide::Traffic::add(const vsm::Bridge::Link& link) {
  const auto& counters = link.parser.counters();
  frames += counters.frames;
  unknown += counters.unknown_frames;
  for (std::size_t i = 0; i < skipped.size(); ++i) skipped[i] += counters.skipped[i];
  for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += link.guard.refused()[i];
  for (const auto& sender : link.losses.senders()) lost += sender.lost();
}

void VehicleSide::log_counters() const {
  auto traffic = ended_;
  for (const auto& [peer, number] : numbers_)
    if (const auto* link = find(owner_.bridge_, number)) traffic.add(*link);
  std::vector<std::string> skipped;
  for (std::size_t i = 0; i < traffic.skipped.size(); ++i)
    if (traffic.skipped[i] > 0)
      skipped.push_back(fmt::format("{} {}", traffic.skipped[i], app::name_of(static_cast<mavlink::SkipReason>(i))));
  const auto& counters = link_->counters();
  owner_.log_->info(
      "{}: {} bytes in, {} frames, {} of unknown messages, {} lost, bytes skipped: {}; {} messages out{}{}", name_,
      counters.bytes_in, traffic.frames, traffic.unknown, traffic.lost,
      skipped.empty() ? "none" : fmt::format("{}", fmt::join(skipped, ", ")), counters.messages_out, drops_in(counters),
      refusals_in(traffic.refused));
}

autopilot::LinkId VehicleSide::number_of(Timestamp now, transport::PeerId peer) {
  const auto found = numbers_.find(peer);
  if (found != numbers_.end()) return found->second;
  const auto number = owner_.new_link_number();
  numbers_.emplace(peer, number);
  if (owner_.bridge_.links().size() == autopilot::FleetSession::link_limit)
    owner_.log_->warn("{}: left out, there are {} links already", link_->peer_name(peer),
                      autopilot::FleetSession::link_limit);
  owner_.bridge_.on_link_up(now, number);
  return number;
}

}  // namespace ponte::app
