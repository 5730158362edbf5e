#include "vsm/live_vsm.hpp"

#include "vsm/dli_side.hpp"
#include "vsm/recording_side.hpp"
#include "vsm/vehicle_side.hpp"

#include <algorithm>
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

LiveVsm::LiveVsm(transport::Loop& loop, const vsm::BridgeConfig& config, Log log)
    : loop_{loop},
      config_{config},
      bridge_{config, this},
      log_{std::move(log)},
      timer_{loop, [this](Timestamp now) {
               bridge_.on_tick(now, transport::Loop::wall());
               pump();
             }} {}
LiveVsm::~LiveVsm() = default;

void LiveVsm::add_vehicle(const transport::Endpoint& endpoint) {
  if (const auto* file = std::get_if<transport::FileEndpoint>(&endpoint))
    recordings_.push_back(std::make_unique<RecordingSide>(*this, *file));
  else
    vehicle_sides_.push_back(std::make_unique<VehicleSide>(*this, endpoint));
  pump();
}

void LiveVsm::add_dli(const transport::Endpoint& endpoint) {
  dli_sides_.push_back(std::make_unique<DliSide>(*this, endpoint));
}

void LiveVsm::convert(bool on) {
  bridge_.convert(on);
  pump();
}

void LiveVsm::begin(std::string_view link, WallTime time, Timestamp received) {
  link_ = link;
  time_ = time;
  received_ = received;
}

void LiveVsm::on_decoded(const mavlink::FrameView&, const mavlink::MessageInfo*) { decoded_ = loop_.now(); }

/// Sends at once, rather than when all the bytes that came together are read.
void LiveVsm::on_translated(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  const auto translated = loop_.now();
  sent_.clear();
  bridge_.messages.drain([&](const vsm::OutgoingMessage& outgoing) {
    send(outgoing);
    if (crossing_observer_) sent_.push_back(outgoing);
  });
  if (!crossing_observer_) return;
  crossing_observer_({.link = link_,
                      .time = time_,
                      .frame = frame,
                      .message = message,
                      .messages = sent_,
                      .received = received_,
                      .decoded = decoded_,
                      .translated = translated,
                      .sent = loop_.now()});
}

void LiveVsm::send(const vsm::OutgoingMessage& message) {
  for (const auto& side : dli_sides_) side->send(message.bytes());
  if (observer_) observer_(message);
}

/// Carries out what the bridge wants done.
void LiveVsm::pump() {
  bridge_.messages.drain([&](const vsm::OutgoingMessage& message) { send(message); });
  bridge_.frames.drain([&](const autopilot::OutgoingFrame& frame) {
    for (const auto& side : vehicle_sides_)
      if (side->send(frame)) break;
  });
  bridge_.facts.drain([&](const autopilot::FleetFact& fact) { log_fact(fact); });
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

std::string LiveVsm::name_of(autopilot::LinkId link) const {
  for (const auto& side : vehicle_sides_)
    if (auto name = side->name_of(link); !name.empty()) return name;
  return "a link that has ended";
}

void LiveVsm::log_fact(const autopilot::FleetFact& fact) const {
  using Kind = autopilot::FleetFact::Kind;
  const bool is_bad = fact.kind == Kind::lost || fact.kind == Kind::duplicate_id;
  log_->log(is_bad ? spdlog::level::warn : spdlog::level::info, "{}: system {} component {} on {}",
            words_for(fact.kind), fact.system.value, fact.component.value, name_of(fact.link));
}

void LiveVsm::log_counters() const {
  for (const auto& side : vehicle_sides_) side->log_counters();
  for (const auto& recording : recordings_) recording->log_counters();
  for (const auto& side : dli_sides_) side->log_counters();
}

}  // namespace ponte::app
