#include "ponte/autopilot/plan_transfer.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/autopilots/mission_request_list.hpp"

#include <algorithm>
#include <utility>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

namespace {

/// Of silence, after which PX4 ends a download; ArduPilot remembers none.
constexpr Duration vehicle_forgets = std::chrono::seconds{5};
/// A plan that changes more often while it is fetched is given up.
constexpr int most_starts = 10;

}  // namespace

void PlanDownload::begin(Timestamp now, const PlanRoute& route, Voice& voice) {
  route_ = route;
  state_ = TransferState::running;
  is_occupied_ = is_repeated_ = false;
  received_ = 0;
  starts_ = 0;
  heard_ = now;
  end_ = now + times_.silence_limit;
  list(now, voice);
}

void PlanDownload::list(Timestamp now, Voice& voice) {
  is_listing_ = true;
  voice.send(messages::MissionRequestList{.target_system = route_.peer.system.value,
                                          .target_component = route_.peer.component.value,
                                          .mission_type = static_cast<std::uint8_t>(route_.type)});
  sent_ = now;
  next_try_ = now + patience_.current();
}

void PlanDownload::list_later(Timestamp now) {
  is_listing_ = true;
  is_repeated_ = true;
  received_ = 0;
  next_try_ = now + times_.pause;
}

/// While items are fetched, a number that differs means that the plan is another one now; the same number is a copy, or
/// the answer to a question that was asked after a long silence.
void PlanDownload::on_count(Timestamp now, std::uint16_t count, std::uint32_t opaque_id, Voice& voice) {
  if (state_ != TransferState::running) return;
  heard_ = now;
  const bool was_listing = std::exchange(is_listing_, false);
  if (was_listing && !is_repeated_) patience_.measured(now - sent_);
  const bool is_known = starts_ > 0 && count == items_.size() && opaque_id == opaque_id_;
  if (is_known && (!was_listing || (received_ > 0 && !asks_in_order()))) return;
  start(now, count, opaque_id, voice);
}

void PlanDownload::start(Timestamp now, std::uint16_t count, std::uint32_t opaque_id, Voice& voice) {
  if (count > item_limit) return end(TransferState::too_many);
  if (++starts_ > most_starts) return end(TransferState::silent);
  end_ = std::max(end_, now + static_cast<std::int64_t>(count) * times_.per_item);
  opaque_id_ = opaque_id;
  items_.assign(count, WireItem{});
  wanted_.clear();
  wanted_.reserve(window);
  received_ = next_ = 0;
  if (count == 0) return finish(voice);
  fill(now, voice);
}

void PlanDownload::fill(Timestamp now, Voice& voice) {
  const std::size_t most = asks_in_order() ? 1 : window;
  while (wanted_.size() < most && next_ < items_.size()) {
    wanted_.push_back({.item = static_cast<std::uint16_t>(next_++)});
    ask(now, wanted_.back(), voice);
  }
}

void PlanDownload::ask(Timestamp now, Wanted& wanted, Voice& voice) const {
  wanted.asked = now;
  voice.send(messages::MissionRequestInt{.target_system = route_.peer.system.value,
                                         .target_component = route_.peer.component.value,
                                         .seq = wanted.item,
                                         .mission_type = static_cast<std::uint8_t>(route_.type)});
}

void PlanDownload::on_item(Timestamp now, const WireItem& item, Voice& voice) {
  if (state_ != TransferState::running || is_listing_) return;
  const auto wanted = std::ranges::find(wanted_, item.seq, &Wanted::item);
  if (wanted == wanted_.end()) return;  // a copy
  if (!wanted->is_repeated) patience_.measured(now - wanted->asked);
  wanted_.erase(wanted);
  heard_ = now;
  items_[item.seq] = item;
  items_[item.seq].current = 0;
  if (++received_ == items_.size()) return finish(voice);
  fill(now, voice);
}

void PlanDownload::finish(Voice& voice) {
  voice.send(messages::MissionAck{.target_system = route_.peer.system.value,
                                  .target_component = route_.peer.component.value,
                                  .type = messages::MAV_MISSION_ACCEPTED,
                                  .mission_type = static_cast<std::uint8_t>(route_.type)});
  end(TransferState::done);
}

/// What is not told apart here is late news of another transfer, or comes of a plan that has changed, which the next
/// count will say.
void PlanDownload::on_ack(Timestamp now, std::uint8_t result) {
  if (state_ != TransferState::running) return;
  if (result == messages::MAV_MISSION_DENIED) {  // somebody uploads
    is_occupied_ = true;
    list_later(now);
  } else if (result == messages::MAV_MISSION_UNSUPPORTED && is_listing_) {
    result_ = result;
    end(TransferState::refused);
  }
}

void PlanDownload::on_tick(Timestamp now, Voice& voice) {
  if (state_ != TransferState::running || now < next_deadline()) return;
  if (now >= end_ || now - heard_ >= times_.silence_limit)
    return end(is_occupied_ ? TransferState::occupied : TransferState::silent);
  if (is_listing_) {
    patience_.ran_out();
    is_repeated_ = true;
    return list(now, voice);
  }
  if (now - heard_ >= vehicle_forgets) {  // it may have started anew, or has another plan now
    is_repeated_ = true;
    return list(now, voice);
  }
  for (auto& wanted : wanted_) {
    if (now - wanted.asked < patience_.current()) continue;
    wanted.is_repeated = true;
    ask(now, wanted, voice);
  }
  patience_.ran_out();
}

Timestamp PlanDownload::next_deadline() const {
  auto next = std::min(end_, heard_ + times_.silence_limit);
  if (is_listing_) return std::min(next, next_try_);
  for (const auto& wanted : wanted_) next = std::min(next, wanted.asked + patience_.current());
  return next;
}

}  // namespace ponte::autopilot
