#include "route/live_router.hpp"

#include "ponte/core/assert.hpp"
#include "route/route_side.hpp"

#include <openssl/rand.h>

#include <cstdio>
#include <utility>

namespace ponte::app {
namespace {

std::uint64_t secret_seed() {
  std::uint64_t seed{};
  const auto done = RAND_bytes(reinterpret_cast<unsigned char*>(&seed), sizeof seed);
  PONTE_ASSERT(done == 1);
  return seed;
}

}  // namespace

LiveRouter::LiveRouter(transport::Loop& loop, Log log) : loop_{loop}, log_{std::move(log)}, router_{secret_seed()} {}
LiveRouter::~LiveRouter() = default;

unsigned LiveRouter::add(const transport::Endpoint& endpoint, mavlink::RouteRules rules) {
  auto side = std::make_unique<RouteSide>(*this, endpoint, std::move(rules));
  sides_.emplace(++last_side_, std::move(side));
  return last_side_;
}

void LiveRouter::remove(unsigned number) {
  const auto found = sides_.find(number);
  PONTE_ASSERT(found != sides_.end());
  found->second->end_all(loop_.now());
  found->second->log_counters();
  log_->info("{} is closed", found->second->name());
  sides_.erase(found);
}

std::optional<mavlink::RouteLinkId> LiveRouter::open_link(Place place, const mavlink::RouteRules& rules) {
  do {
    ++last_number_;
  } while (places_.contains(mavlink::RouteLinkId{last_number_}));
  const mavlink::RouteLinkId number{last_number_};
  if (!router_.add_link(number, rules)) return {};
  places_.emplace(number, place);
  return number;
}

void LiveRouter::close_link(mavlink::RouteLinkId link) {
  router_.remove_link(link);
  places_.erase(link);
}

void LiveRouter::pass_on(Timestamp now, mavlink::RouteLinkId from, const mavlink::FrameView& frame,
                         const mavlink::MessageInfo* message) {
  for (const auto link : router_.on_frame(now, from, frame, message)) {
    const auto& place = places_.at(link);
    place.side->send(place.peer, frame.whole);
  }
}

LiveRouter::Totals LiveRouter::totals() const {
  Totals totals{.links = places_.size()};
  for (const auto& [link, place] : places_) {
    const auto& counters = *router_.counters(link);
    totals.received += counters.received;
    totals.sent += counters.sent;
    for (const auto count : counters.dropped) totals.dropped += count;
  }
  return totals;
}

void LiveRouter::print_json() const {
  for (const auto& [number, side] : sides_) side->print_json();
  std::fflush(stdout);
}

void LiveRouter::log_counters() const {
  for (const auto& [number, side] : sides_) side->log_counters();
}

}  // namespace ponte::app
