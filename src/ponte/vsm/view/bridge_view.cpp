#include "ponte/vsm/view/bridge_view.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <utility>

namespace ponte::vsm::view {
namespace {

std::string_view words_for(mavlink::SkipReason reason) {
  using enum mavlink::SkipReason;
  switch (reason) {
    case noise: return "noise";
    case checksum: return "bad checksum";
    case unknown_flag: return "unknown flag";
    case truncated: return "truncated";
    case unconfirmed: return "unknown message, unconfirmed";
  }
  return "";
}

Severity severity_of(vehicle::Condition condition) {
  using enum vehicle::Condition;
  if (condition == emergency || condition == failed) return Severity::error;
  return condition == warning || condition == caution ? Severity::warning : Severity::info;
}

}  // namespace

BridgeView::BridgeView(const dli::Catalogue& catalogue, ViewConfig config)
    : config_{std::move(config)}, dli_table_{catalogue, config_.profile} {
  set_study({});
}

void BridgeView::on_crossing(const Crossing& crossing) {
  skipping_.erase(crossing.link_id);
  ++last_crossing_;
  wall_ = crossing.time;
  mavlink_.rate.on_message(crossing.received);
  mavlink_.bytes += crossing.frame.whole.size();
  for (const auto& message : crossing.messages) {
    dli_.rate.on_message(crossing.sent);
    dli_.bytes += message.size;
    auto& row = dli_table_.add(crossing.sent, message);
    row.clock_number = 0;
    row.revision = ++revision_;
  }
  if (!crossing.messages.empty()) times_.add(crossing);
  if (auto* row = mavlink_table_.add(last_crossing_, crossing))
    row->revision = ++revision_;
  else
    reject({Side::mavlink, crossing.link_id, "the table is full"}, 1, crossing.frame.whole.size());
  if (const auto link = mavlink_table_.links().find(crossing.link_id); link != mavlink_table_.links().end())
    link->second.revision = revision_;
  if (mavlink::carries<mavlink::autopilots::Statustext>(crossing.frame) && crossing.message != nullptr &&
      autopilot::ours(crossing.frame, *crossing.message) != nullptr)
    read_status_text(crossing);
}

void BridgeView::on_clock(Timestamp now, std::span<const OutgoingMessage> messages) {
  for (const auto& message : messages) {
    dli_.rate.on_message(now);
    dli_.bytes += message.size;
    auto& row = dli_table_.add(now, message);
    row.clock_number = ++last_crossing_;
    row.revision = ++revision_;
  }
}

void BridgeView::on_skipped(VehicleLinkId link, Bytes run, mavlink::SkipReason reason) {
  const auto before = skipping_.find(link);
  const bool continues = reason == mavlink::SkipReason::noise && before != skipping_.end() && before->second == reason;
  skipping_[link] = reason;
  reject({Side::mavlink, link, words_for(reason)}, continues ? 0 : 1, run.size());
  if (!continues) ++mavlink_.rejected;
}

void BridgeView::on_refused(std::string_view reason, std::size_t bytes) {
  reject({Side::dli, VehicleLinkId{}, reason}, 1, bytes);
  ++dli_.rejected;
}

void BridgeView::reject(RejectKey key, std::size_t pieces, std::size_t bytes) {
  auto& entry = rejects_[key];
  entry.count += pieces;
  entry.bytes += bytes;
  entry.revision = ++revision_;
}

void BridgeView::set_situation(Situation situation) {
  if (situation == situation_) return;
  for (const auto& link : situation_.vehicle_links) {
    if (std::ranges::find(situation.vehicle_links, link.id, &VehicleLink::id) != situation.vehicle_links.end())
      continue;
    mavlink_table_.remove(link.id);
    std::erase_if(rejects_, [&](const auto& entry) { return std::get<VehicleLinkId>(entry.first) == link.id; });
    skipping_.erase(link.id);
  }
  situation_ = std::move(situation);
  ++situation_revision_;
  status_text_.reset();
}

void BridgeView::on_tick(Timestamp now) {
  status_text_.reset();
  timing_text_.reset();
  crossing_news_.clear();
  traffic_news_.clear();
  const auto tell_silence = [&](auto& row) {
    if (row.is_silent || !row.rate.is_silent(now)) return;
    row.is_silent = true;
    row.revision = ++revision_;
  };
  for (auto& [key, row] : mavlink_table_.rows()) tell_silence(row);
  for (auto& [key, row] : dli_table_.rows()) tell_silence(row);
  for (auto& [system, texts] : status_texts_)
    texts.on_tick(now, [&](const vehicle::Alert& alert) { add_alert(system, wall_, alert); });
}

const VehicleOnLink* BridgeView::vehicle_on(VehicleLinkId link, mavlink::SystemId system) const {
  const auto found = std::ranges::find_if(situation_.vehicles, [&](const VehicleOnLink& vehicle) {
    return vehicle.link == link && vehicle.system == system;
  });
  return found == situation_.vehicles.end() ? nullptr : &*found;
}

void BridgeView::read_status_text(const Crossing& crossing) {
  const auto system = crossing.frame.system;
  if (vehicle_on(crossing.link_id, system) == nullptr) return;
  const auto text = mavlink::decode<mavlink::autopilots::Statustext>(crossing.frame);
  status_texts_[system].on_chunk(crossing.received, text.severity, text.id, text.chunk_seq, text.text.view(),
                                 [&](const vehicle::Alert& alert) { add_alert(system, crossing.time, alert); });
}

void BridgeView::add_alert(mavlink::SystemId system, WallTime time, const vehicle::Alert& alert) {
  const auto vehicle = std::ranges::find(situation_.vehicles, system, &VehicleOnLink::system);
  if (vehicle == situation_.vehicles.end()) return;
  events_.add({.time = time,
               .code = EventCode::status_text,
               .severity = severity_of(alert.severity),
               .vehicle = vehicle->id,
               .text = std::string{alert.text.view()}});
}

}  // namespace ponte::vsm::view
