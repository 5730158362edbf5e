#include "vsm/dli_side.hpp"

#include "common/failure.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "vsm/link_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace ponte::app {
namespace {

std::string_view words_for(dli::WrapperError error) {
  using enum dli::WrapperError;
  switch (error) {
    case truncated: return "truncated";
    case bad_length: return "bad length";
    case beyond_end: return "ends behind the datagram";
    case unassigned_checksum: return "unassigned checksum";
    case bad_checksum: return "bad checksum";
    case stray_bytes: return "stray bytes";
  }
  return "";
}

}  // namespace

DliSide::DliSide(LiveVsm& owner, const transport::Endpoint& endpoint)
    : owner_{owner}, endpoint_{endpoint}, name_{transport::to_text(endpoint)} {
  auto opened = transport::open_link(owner.loop_, endpoint, *this);
  if (!opened) throw Failure{transport::to_text(opened.error())};
  link_ = std::move(*opened);
}

void DliSide::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) { on_datagram(now, bytes, peer); }

void DliSide::on_datagram(Timestamp, Bytes bytes, transport::PeerId) {
  dli::DatagramReader reader{bytes, owner_.config_.telemetry.profile, heard_};
  while (const auto message = reader.next())
    if (*message)
      refuse(**message);
    else
      owner_.tell(&VsmWatcher::on_refused, words_for(message->error().reason), bytes.size());
}

void DliSide::refuse(const dli::WrapperView& message) {
  const auto& vsm = owner_.config_.telemetry.vsm;
  const bool is_ours = message.source == vsm || (message.source.owning_code() == vsm.owning_code() &&
                                                 message.source.type() == dli::EntityType::vehicle);
  if (is_ours || refused_.size() == refusals_told || !refused_.insert(message.source).second) return;
  const auto* info = dli::messages::catalogue.find(message.number);
  owner_.log_->warn("{} sends #{} {}: not obeyed, every station is monitor only", to_text(message.source).view(),
                    message.number.value, info == nullptr ? "unknown" : info->name);
}

void DliSide::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  log_state(*owner_.log_, endpoint_, state, reason);
}

void DliSide::log_counters() const {
  const auto& counters = link_->counters();
  const auto bad = std::accumulate(heard_.errors.begin(), heard_.errors.end(), std::uint64_t{});
  owner_.log_->info("{}: {} messages out{}; {} messages in, {} bad", name_, counters.messages_out, drops_in(counters),
                    heard_.messages, bad);
}

}  // namespace ponte::app
