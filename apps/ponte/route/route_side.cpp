#include "route/route_side.hpp"

#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "vsm/link_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <utility>
#include <variant>

namespace ponte::app {

using mavlink::RouteDrop;
using transport::PeerId;

namespace {

std::string describe(const mavlink::RouteCounters& counters) {
  std::vector<std::string> drops;
  for (std::size_t i = 0; i < mavlink::route_drop_count; ++i)
    if (counters.dropped[i] > 0)
      drops.push_back(fmt::format("{} {}", counters.dropped[i], name_of(static_cast<RouteDrop>(i))));
  const auto repeats = counters.repeated > 0 ? fmt::format(" ({} repeated)", counters.repeated) : std::string{};
  return fmt::format("{} frames in{}, {} out{}", counters.received, repeats, counters.sent,
                     drops.empty() ? std::string{} : fmt::format("; dropped: {}", fmt::join(drops, ", ")));
}

}  // namespace

RouteSide::Peer::Peer(mavlink::RouteLinkId number) : id{number}, parser{mavlink::autopilots::dialect} {}

RouteSide::RouteSide(LiveRouter& owner, const transport::Endpoint& endpoint, mavlink::RouteRules rules)
    : owner_{owner},
      endpoint_{endpoint},
      name_{transport::to_text(endpoint)},
      rules_{std::move(rules)},
      silence_{owner.loop_, [this](Timestamp now) {
                 for (const auto& [id, peer] : peers_) {
                   if (!peer->parser.next_deadline() || *peer->parser.next_deadline() > now) continue;
                   if (enter(now, id)) current_->parser.on_tick(now, *this);
                 }
                 wait_for_silence();
               }} {
  auto opened = transport::open_link(owner.loop_, endpoint, *this);
  if (!opened) throw Failure{transport::to_text(opened.error())};
  link_ = std::move(*opened);
}

PeerId RouteSide::key_of(PeerId peer) const {
  return std::holds_alternative<transport::MulticastEndpoint>(endpoint_) ? PeerId{} : peer;
}

bool RouteSide::enter(Timestamp now, PeerId peer) {
  const auto found = peers_.find(key_of(peer));
  current_ = found == peers_.end() ? nullptr : found->second.get();
  now_ = now;
  return current_ != nullptr;
}

void RouteSide::on_bytes(Timestamp now, Bytes bytes, PeerId peer) {
  if (!enter(now, peer)) return;
  current_->parser.on_bytes(now, bytes, *this);
  wait_for_silence();
}

void RouteSide::on_datagram(Timestamp now, Bytes bytes, PeerId peer) {
  if (enter(now, peer)) current_->parser.on_datagram(bytes, *this);
}

void RouteSide::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  owner_.pass_on(now_, current_->id, frame, message);
}

void RouteSide::on_peer(Timestamp now, PeerId peer, transport::PeerChange change, std::string_view name) {
  const bool has_joined = change == transport::PeerChange::joined;
  owner_.log_->info("{} {} {}", name, has_joined ? "joined" : "left", name_);
  const auto key = key_of(peer);
  if (has_joined && !peers_.contains(key)) {
    if (const auto number = owner_.open_link({this, peer}, rules_)) {
      auto& added = peers_[key] = std::make_unique<Peer>(*number);
      added->name = key == peer ? std::string{name} : name_;
    } else {
      owner_.log_->warn("{}: left out, there are {} links already", name, mavlink::Router::link_limit);
    }
  } else if (!has_joined && key == peer) {
    end(now, peer);
  }
}

void RouteSide::end_all(Timestamp now) {
  while (!peers_.empty()) end(now, peers_.begin()->first);
}

void RouteSide::end(Timestamp now, PeerId peer) {
  if (!enter(now, peer)) return;
  current_->parser.finish(*this);
  const auto found = peers_.find(peer);
  owner_.log_->info("{}: {}", found->second->name, describe(*owner_.router_.counters(found->second->id)));
  owner_.close_link(found->second->id);
  peers_.erase(found);
  current_ = nullptr;
}

void RouteSide::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  log_state(*owner_.log_, endpoint_, state, reason);
}

void RouteSide::wait_for_silence() {
  std::optional<Timestamp> due;
  for (const auto& [id, peer] : peers_)
    if (const auto deadline = peer->parser.next_deadline(); deadline && (!due || *deadline < *due)) due = deadline;
  silence_.set(due);
}

void RouteSide::print_json() const {
  JsonText json;
  const auto drops = [&](const auto& counts, auto name) {
    json.key("dropped").begin_object();
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] > 0) json.member(name(i), counts[i]);
    json.end_object();
  };
  for (const auto& [id, peer] : peers_) {
    const auto& counters = *owner_.router_.counters(peer->id);
    json.begin_object().member("kind", "link").member("endpoint", std::string_view{name_});
    json.member("peer", std::string_view{peer->name}).key("systems").begin_array();
    for (const auto system : owner_.router_.systems_on(owner_.loop_.now(), peer->id))
      json.value(unsigned{system.value});
    json.end_array().member("received", counters.received).member("repeated", counters.repeated);
    json.member("sent", counters.sent);
    const auto& skipped = peer->parser.counters().skipped;
    json.member("skipped_bytes", std::accumulate(skipped.begin(), skipped.end(), std::uint64_t{0}));
    drops(counters.dropped, [](std::size_t i) { return name_of(static_cast<RouteDrop>(i)); });
    json.end_object();
    print_line(json);
  }
  const auto& counters = link_->counters();
  json.begin_object().member("kind", "endpoint").member("endpoint", std::string_view{name_});
  json.member("state", transport::name_of(link_->state()));
  json.member("bytes_in", counters.bytes_in).member("bytes_out", counters.bytes_out);
  drops(counters.dropped, [](std::size_t i) { return transport::name_of(static_cast<transport::DropReason>(i)); });
  json.end_object();
  print_line(json);
}

void RouteSide::log_counters() const {
  for (const auto& [id, peer] : peers_)
    owner_.log_->info("{}: {}", peer->name, describe(*owner_.router_.counters(peer->id)));
  const auto& counters = link_->counters();
  owner_.log_->info("{}: {} bytes in, {} out{}", name_, counters.bytes_in, counters.bytes_out, drops_in(counters));
}

}  // namespace ponte::app
