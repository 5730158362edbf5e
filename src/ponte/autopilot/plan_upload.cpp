#include "ponte/autopilot/plan_transfer.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"

#include <algorithm>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

/// Of silence, after which the vehicle ends an upload. Until then it asks again by itself.
constexpr Duration vehicle_gives_up(Stack stack) {
  return stack == Stack::px4 ? std::chrono::seconds{5} : std::chrono::seconds{8};
}

}  // namespace

void PlanUpload::begin(Timestamp now, const PlanRoute& route, std::span<const WireItem> items, Voice& voice) {
  route_ = route;
  items_ = items;
  state_ = TransferState::running;
  is_occupied_ = has_begun_ = false;
  item_ = 0;
  heard_ = now;
  end_ = now + times_.silence_limit + static_cast<std::int64_t>(items.size()) * times_.per_item;
  is_repeated_ = false;
  announce(now, voice);
}

void PlanUpload::announce(Timestamp now, Voice& voice) {
  is_sending_ = false;
  voice.send(messages::MissionCount{.target_system = route_.peer.system.value,
                                    .target_component = route_.peer.component.value,
                                    .count = static_cast<std::uint16_t>(items_.size()),
                                    .mission_type = static_cast<std::uint8_t>(route_.type)});
  sent_ = now;
  next_try_ = now + patience_.current();
}

/// The vehicle becomes idle meanwhile.
void PlanUpload::announce_later(Timestamp now) {
  is_sending_ = false;
  is_repeated_ = true;
  next_try_ = now + times_.pause;
}

void PlanUpload::send_item(Timestamp now, Voice& voice) {
  auto item = items_[item_];
  item.target_system = route_.peer.system.value;
  item.target_component = route_.peer.component.value;
  item.seq = item_;
  item.mission_type = static_cast<std::uint8_t>(route_.type);
  item.current = 0;
  voice.send(item);
  sent_ = now;
  next_try_ = now + patience_.current();
}

void PlanUpload::on_request(Timestamp now, std::uint16_t item, Voice& voice) {
  if (item >= items_.size() || now >= end_) return;
  const bool was_sent = is_sending_ && item <= item_;
  // It had not got our last answer when it said this.
  if (was_sent && now - sent_ < patience_.round_trip()) return;
  const bool is_answer = state_ == TransferState::running && !was_sent && !is_repeated_;
  if (is_answer) patience_.measured(now - sent_);
  state_ = TransferState::running;
  heard_ = now;
  has_begun_ = true;
  is_repeated_ = was_sent;
  is_sending_ = true;
  item_ = item;
  send_item(now, voice);
}

void PlanUpload::on_ack(Timestamp now, std::uint8_t result) {
  if (state_ != TransferState::running) return;
  switch (result) {
    case messages::MAV_MISSION_ACCEPTED:
      if (is_at_last_item() || items_.empty()) end(TransferState::done);
      return;
    case messages::MAV_MISSION_INVALID_SEQUENCE: return;  // of a copy; the transfer goes on
    case messages::MAV_MISSION_DENIED:                    // somebody else's transfer
      if (is_sending_) return;
      is_occupied_ = true;
      announce_later(now);
      return;
    case messages::MAV_MISSION_ERROR:  // PX4 says this for DENIED; or there is no transfer to which an item belongs
      if (is_at_last_item()) return end(TransferState::uncertain);
      is_occupied_ = is_occupied_ || !is_sending_;
      announce_later(now);
      return;
    case messages::MAV_MISSION_OPERATION_CANCELLED:
      if (is_sending_) announce_later(now);
      return;
    default:
      // Before the first item only this can be about the announcement; the rest is late news of another transfer.
      if (!is_sending_ && result != messages::MAV_MISSION_NO_SPACE && result != messages::MAV_MISSION_UNSUPPORTED)
        return;
      result_ = result;
      end(TransferState::refused);
  }
}

void PlanUpload::on_tick(Timestamp now, Voice& voice) {
  if (state_ != TransferState::running || now < next_deadline()) return;
  if (now >= end_ || now - heard_ >= times_.silence_limit)
    return end(is_occupied_ && !has_begun_ ? TransferState::occupied : TransferState::silent);
  const bool is_over = is_sending_ && now - heard_ >= vehicle_gives_up(route_.peer.stack);
  patience_.ran_out();
  is_repeated_ = true;
  if (is_sending_ && !is_over) return send_item(now, voice);
  announce(now, voice);
}

Timestamp PlanUpload::next_deadline() const { return std::min({next_try_, end_, heard_ + times_.silence_limit}); }

}  // namespace ponte::autopilot
