#include "ponte/mavlink/router.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/route_filter.hpp"
#include "ponte/mavlink/setup_signing.hpp"

#include <algorithm>
#include <utility>

namespace ponte::mavlink {

struct Router::Link {
  struct Limit {
    MessageId message{};
    RateLimit rate;
  };

  [[nodiscard]] bool has_heard(Timestamp now, SystemId system) const {
    const auto& time = heard[system.value];
    return time && now - *time < address_lifetime;
  }
  void count(RouteDrop reason) { ++counters.dropped[static_cast<std::size_t>(reason)]; }

  RouteLinkId id;
  bool untrusted{};
  std::vector<Limit> limits;
  std::array<std::optional<Timestamp>, 256> heard{};  ///< when each system was heard last
  RouteCounters counters{};
};

std::string_view name_of(RouteDrop reason) {
  switch (reason) {
    case RouteDrop::no_other_link: return "no other link";
    case RouteDrop::unknown_target: return "unknown target";
    case RouteDrop::setup_signing: return "setup signing";
    case RouteDrop::untrusted: return "untrusted";
    case RouteDrop::duplicate: return "duplicate";
    case RouteDrop::rate_limit: return "rate limit";
  }
  return {};
}

Router::Router(std::uint64_t seed) : recent_{seed} { links_.reserve(link_limit); }
Router::~Router() = default;

bool Router::add_link(RouteLinkId link, RouteRules rules) {
  PONTE_ASSERT(find(link) == nullptr);
  if (links_.size() == link_limit) return false;
  auto added = std::make_unique<Link>();
  added->id = link;
  added->untrusted = rules.untrusted;
  for (const auto& limit : rules.limits) added->limits.push_back({limit.message, RateLimit{limit.pause}});
  links_.push_back(std::move(added));
  return true;
}

void Router::remove_link(RouteLinkId link) {
  std::erase_if(links_, [&](const auto& other) { return other->id == link; });
}

Router::Link* Router::find(RouteLinkId link) const {
  const auto found = std::ranges::find_if(links_, [&](const auto& other) { return other->id == link; });
  return found == links_.end() ? nullptr : found->get();
}

std::span<const RouteLinkId> Router::on_frame(Timestamp now, RouteLinkId from, const FrameView& frame,
                                              const MessageInfo* message) {
  auto* const source = find(from);
  PONTE_ASSERT(source != nullptr);
  ++source->counters.received;
  if (const auto refusal = refusal_of(now, *source, frame)) {
    source->count(*refusal);
    return {};
  }
  source->heard[frame.system.value] = now;

  const auto target = target_system_of(frame, message);
  const bool is_for_all = target == SystemId{};
  bool has_place_to_go = false;
  std::size_t count = 0;
  for (const auto& link : links_) {
    if (link.get() == source || !(is_for_all || link->has_heard(now, target))) continue;
    has_place_to_go = true;
    if (!admits(now, *link, frame)) continue;
    ++link->counters.sent;
    targets_[count++] = link->id;
  }
  if (!has_place_to_go) source->count(is_for_all ? RouteDrop::no_other_link : RouteDrop::unknown_target);
  return std::span{targets_}.first(count);
}

/// Only what is passed on is remembered, so that an untrusted link cannot make the same frame of another one a
/// duplicate; and a duplicate teaches no address, as it comes by a detour.
std::optional<RouteDrop> Router::refusal_of(Timestamp now, Link& from, const FrameView& frame) {
  if (frame.message == setup_signing_id) return RouteDrop::setup_signing;
  if (from.untrusted && is_risky(frame)) return RouteDrop::untrusted;
  const auto arrival = recent_.arrive(now, from.id.value, frame.whole);
  if (arrival == RecentFrames::Arrival::elsewhere) return RouteDrop::duplicate;
  if (arrival == RecentFrames::Arrival::again) ++from.counters.repeated;
  return {};
}

bool Router::admits(Timestamp now, Link& to, const FrameView& frame) {
  if (to.untrusted && is_risky(frame)) {
    to.count(RouteDrop::untrusted);
    return false;
  }
  const auto limit = std::ranges::find(to.limits, frame.message, &Link::Limit::message);
  if (limit == to.limits.end() || limit->rate.admits(now, frame.system, frame.component)) return true;
  to.count(RouteDrop::rate_limit);
  return false;
}

const RouteCounters* Router::counters(RouteLinkId link) const {
  const auto* const found = find(link);
  return found == nullptr ? nullptr : &found->counters;
}

std::vector<SystemId> Router::systems_on(Timestamp now, RouteLinkId link) const {
  std::vector<SystemId> systems;
  const auto* const found = find(link);
  for (unsigned number = 0; found != nullptr && number < found->heard.size(); ++number) {
    const SystemId system{static_cast<std::uint8_t>(number)};
    if (found->has_heard(now, system)) systems.push_back(system);
  }
  return systems;
}

}  // namespace ponte::mavlink
