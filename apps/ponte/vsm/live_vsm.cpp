#include "vsm/live_vsm.hpp"

#include "vsm/dli_side.hpp"
#include "vsm/recording_side.hpp"
#include "vsm/vehicle_side.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace ponte::app {
namespace {

std::string_view words_for(autopilot::FleetFact::Kind kind) {
  using enum autopilot::FleetFact::Kind;
  switch (kind) {
    case appeared: return "vehicle appeared";
    case lost: return "vehicle lost";
    case returned: return "vehicle returned";
    case rebooted: return "vehicle rebooted";
    case duplicate_id: return "two vehicles use one id, the second is left out";
  }
  return "";
}

}  // namespace

LiveVsm::LiveVsm(transport::Loop& loop, const vsm::BridgeConfig& config, Log log, mavlink::Signer* signer)
    : loop_{loop},
      config_{config},
      signer_{signer},
      bridge_{config, this, signer},
      log_{std::move(log)},
      timer_{loop, [this](Timestamp now) {
               bridge_.on_tick(now, transport::Loop::wall());
               pump();
             }} {}
LiveVsm::~LiveVsm() = default;

vsm::VehicleLinkId LiveVsm::add_vehicle(const transport::Endpoint& endpoint) {
  const vsm::VehicleLinkId id{last_vehicle_link_ + 1};
  if (const auto* file = std::get_if<transport::FileEndpoint>(&endpoint))
    recordings_.push_back(std::make_unique<RecordingSide>(*this, id, *file));
  else
    vehicle_sides_.push_back(std::make_unique<VehicleSide>(*this, id, endpoint));
  last_vehicle_link_ = id.value;
  pump();
  return id;
}

bool LiveVsm::remove_vehicle(vsm::VehicleLinkId id) {
  const auto has_id = [&](const auto& side) { return side->id() == id; };
  if (const auto found = std::ranges::find_if(vehicle_sides_, has_id); found != vehicle_sides_.end()) {
    log_->info("{} is closed", (*found)->name());
    auto status = (*found)->status();
    (*found)->end_all(loop_.now());
    pump();
    if (std::exchange(status.is_up, false)) tell(&VsmWatcher::on_link, status);
    vehicle_sides_.erase(found);
    return true;
  }
  return std::erase_if(recordings_, has_id) > 0;
}

vsm::view::Situation LiveVsm::situation() const {
  vsm::view::Situation situation{.converts = converts()};
  for (const auto& side : vehicle_sides_) situation.vehicle_links.push_back(side->status());
  for (const auto& side : recordings_) situation.vehicle_links.push_back(side->status());
  std::ranges::sort(situation.vehicle_links, {}, &vsm::view::VehicleLink::id);
  for (const auto& side : dli_sides_) situation.dli_links.push_back(side->name());
  for (const auto& vehicle : bridge_.fleet().vehicles())
    if (const auto* side = side_of(vehicle.link)) situation.vehicles.push_back(describe(vehicle, side->id()));
  for (const auto& side : recordings_)
    for (const auto& vehicle : side->vehicles()) situation.vehicles.push_back(describe(vehicle, side->id()));
  return situation;
}

vsm::view::VehicleOnLink LiveVsm::describe(const autopilot::FleetSession::Vehicle& vehicle,
                                           vsm::VehicleLinkId link) const {
  return {.id = dli::EntityId{config_.telemetry.vsm.owning_code(), dli::EntityType::vehicle, vehicle.system.value},
          .link = link,
          .system = vehicle.system,
          .autopilot = vehicle.autopilot,
          .type = vehicle.type,
          .is_present = !vehicle.lost};
}

void LiveVsm::add_dli(const transport::Endpoint& endpoint) {
  dli_sides_.push_back(std::make_unique<DliSide>(*this, endpoint));
}

void LiveVsm::convert(bool on) {
  bridge_.convert(on);
  pump();
  tell(&VsmWatcher::on_conversion, on);
}

void LiveVsm::begin(vsm::VehicleLinkId id, std::string_view link, WallTime time, Timestamp received) {
  link_id_ = id;
  link_ = link;
  time_ = time;
  received_ = received;
}

void LiveVsm::on_decoded(const mavlink::FrameView&, const mavlink::MessageInfo*) {
  send_due();
  decoded_ = loop_.now();
}

/// Sends at once, rather than when all the bytes that came together are read.
void LiveVsm::on_translated(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  const auto translated = loop_.now();
  sent_.clear();
  bridge_.messages.drain([&](const vsm::OutgoingMessage& outgoing) {
    send(outgoing);
    sent_.push_back(outgoing);
  });
  const Crossing crossing{.link_id = link_id_,
                          .link = link_,
                          .time = time_,
                          .frame = frame,
                          .message = message,
                          .messages = sent_,
                          .received = received_,
                          .decoded = decoded_,
                          .translated = translated,
                          .sent = loop_.now()};
  if (crossing_observer_) crossing_observer_(crossing);
  tell(&VsmWatcher::on_crossing, crossing);
}

void LiveVsm::on_skipped(autopilot::LinkId, Bytes run, mavlink::SkipReason reason) {
  tell(&VsmWatcher::on_skipped, link_id_, run, reason);
}

void LiveVsm::send(const vsm::OutgoingMessage& message) {
  for (const auto& side : dli_sides_) side->send(message.bytes());
  if (observer_) observer_(message);
}

void LiveVsm::on_refused(autopilot::LinkId link, mavlink::Refusal refusal, std::uint64_t count) {
  if (count > 1) return;
  const auto* side = side_of(link);
  log_->warn("{}: frames are refused: {}", side != nullptr ? side->name_of(link) : std::string{"a link"},
             name_of(refusal));
}

/// MAVLink 1, which a peer may speak until its first signature, cannot be signed.
void LiveVsm::send(autopilot::OutgoingFrame frame) {
  if (signer_ != nullptr && frame.buffer[0] == mavlink::start_v2)
    frame.size =
        signer_->sign(transport::Loop::wall(), static_cast<std::uint8_t>(frame.link.value), frame.buffer, frame.size);
  for (const auto& side : vehicle_sides_)
    if (side->send(frame)) return;
}

/// Sends what the clock, and no frame, has called for.
void LiveVsm::send_due() {
  if (bridge_.messages.empty()) return;
  sent_.clear();
  bridge_.messages.drain([&](const vsm::OutgoingMessage& message) {
    send(message);
    sent_.push_back(message);
  });
  tell(&VsmWatcher::on_clock, loop_.now(), std::span<const vsm::OutgoingMessage>{sent_});
}

/// Carries out what the bridge wants done.
void LiveVsm::pump() {
  send_due();
  bridge_.frames.drain([&](const autopilot::OutgoingFrame& frame) { send(frame); });
  bridge_.facts.drain([&](const autopilot::FleetFact& fact) {
    if (const auto* side = side_of(fact.link))
      tell_fact(side->id(), side->name_of(fact.link), fact);
    else
      tell_fact(vsm::VehicleLinkId{}, "a link that has ended", fact);
  });
  if (!vehicle_sides_.empty()) timer_.set(bridge_.next_deadline());  // recordings bring their own time
}

void LiveVsm::finish_if_all_have() {
  const bool all = vehicle_sides_.empty() && std::ranges::all_of(recordings_, &RecordingSide::is_finished);
  if (all && finished_) finished_();
}

/// A number that no link has; 0 is never one.
autopilot::LinkId LiveVsm::new_link_number() {
  const auto is_taken = [&](autopilot::LinkId number) {
    return std::ranges::any_of(bridge_.links(), [&](const auto& link) { return link->id == number; });
  };
  do {
    ++last_link_;
  } while (last_link_ == 0 || is_taken(autopilot::LinkId{last_link_}));
  return autopilot::LinkId{last_link_};
}

const VehicleSide* LiveVsm::side_of(autopilot::LinkId link) const {
  const auto found = std::ranges::find_if(vehicle_sides_, [&](const auto& side) { return side->has(link); });
  return found == vehicle_sides_.end() ? nullptr : found->get();
}

void LiveVsm::tell_fact(vsm::VehicleLinkId link, std::string_view place, const autopilot::FleetFact& fact) const {
  using Kind = autopilot::FleetFact::Kind;
  const bool is_bad = fact.kind == Kind::lost || fact.kind == Kind::duplicate_id;
  log_->log(is_bad ? spdlog::level::warn : spdlog::level::info, "{}: system {} component {} on {}",
            words_for(fact.kind), fact.system.value, fact.component.value, place);
  tell(&VsmWatcher::on_fact, link, fact);
}

void LiveVsm::log_counters() const {
  for (const auto& side : vehicle_sides_) side->log_counters();
  for (const auto& recording : recordings_) recording->log_counters();
  for (const auto& side : dli_sides_) side->log_counters();
}

}  // namespace ponte::app
